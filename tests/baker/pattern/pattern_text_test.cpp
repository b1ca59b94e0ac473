// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sherd/baker/pattern.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

Pattern parsed(const std::string& text) {
    const Result<Pattern> pattern = parsePattern(text);
    if (!pattern) FAIL(pattern.error().message);
    CHECK(pattern->text == text);
    return *pattern;
}

/// The refusal, which names the whole text and holds `says`.
void refused(const std::string& text, const std::string& says) {
    CAPTURE(text);
    const Result<Pattern> pattern = parsePattern(text);
    REQUIRE_FALSE(pattern.has_value());
    CHECK(pattern.error().code == ErrorCode::badArgument);
    CAPTURE(pattern.error().message);
    CHECK(pattern.error().message.find(says) != std::string::npos);
    CHECK(pattern.error().where == "pattern \"" + text + "\"");
}

}  // namespace

TEST_CASE("every documented form of a pattern is read") {
    Pattern p = parsed("voronoi:12");
    CHECK(p.kind == Pattern::Kind::voronoi);
    CHECK(p.count == 12);
    CHECK(p.seed == 1);
    CHECK(p.jitter < 0);
    p = parsed("voronoi:50:7:around=0,1,0:spread=0.1");
    CHECK(p.count == 50);
    CHECK(p.seed == 7);
    REQUIRE(p.around.size() == 1);
    CHECK(p.around[0] == glm::dvec3(0, 1, 0));
    CHECK(p.spread == 0.1);
    CHECK(parsed("voronoi:2:around=0,1,0;-1e3,2.5,.5").around.size() == 2);
    CHECK(parsed("voronoi:2:density=color").density == "color");
    CHECK(parsed("voronoi:2:density=a=b.png").density == "a=b.png");
    p = parsed("grid:4x3:brick:on=box");
    CHECK(p.columns == 4);
    CHECK(p.rows == 3);
    CHECK(p.brick);
    CHECK(p.projection.kind == Projection::Kind::box);
    p = parsed("grid:4x3:on=planar/-z:jitter=0.5");
    CHECK(p.projection.axis == glm::dvec3(0, 0, -1));
    CHECK(p.jitter == 0.5);
    p = parsed("radial:12x4:1:at=0,1,0:axis=z");
    CHECK(p.kind == Pattern::Kind::radial);
    REQUIRE(p.centre);
    CHECK(*p.centre == glm::dvec3(0, 1, 0));
    CHECK(p.axis == glm::dvec3(0, 0, 1));
    p = parsed("wood:20:3:axis=y:elongation=8");
    CHECK(p.kind == Pattern::Kind::wood);
    CHECK(p.seed == 3);
    CHECK(p.elongation == 8);
    CHECK(parsed("voronoi:100000:4294967295:jitter=0").seed == 4294967295U);
    CHECK(parsed("grid:1000x1").columns == 1000);
}

TEST_CASE("a bad pattern is refused with what is allowed") {
    for (const std::string text : {"", ":", "voronoy:3", "Voronoi:3", " voronoi:3", "\0"})
        refused(text, "known are voronoi:N, grid:NxM, radial:NxM and wood:N");
    for (const std::string text :
         {"voronoi", "voronoi:", "voronoi:0", "voronoi:-3", "voronoi:100001",
          "voronoi:99999999999999", "voronoi:2.5", "voronoi:nan", "voronoi: 3", "voronoi:3x3",
          "wood:", "voronoi:+3"})
        refused(text, "a number of pieces from 1 to 100000");
    for (const std::string text :
         {"grid", "grid:", "grid:4", "grid:4x", "grid:x4", "grid:4x0", "grid:0x4", "grid:1001x2",
          "grid:4x4x4", "radial:-1x3", "grid:4X3"})
        refused(text, "COLUMNSxROWS");
    for (const std::string text : {"voronoi:3:", "voronoi:3:-1", "voronoi:3:4294967296",
                                   "grid:4x3:box", "voronoi:3:1.5", "radial:4x4:seed"})
        refused(text, "is not a seed, a whole number from 0 to 4294967295");
    for (const std::string text :
         {"voronoi:3:jitter=", "voronoi:3:jitter=2", "voronoi:3:jitter=nan",
          "voronoi:3:jitter=-0.1", "voronoi:3:jitter=inf", "voronoi:3:1:jitter"})
        refused(text, "is not a number from 0 to 1");
    refused("grid:1000x101", "makes more than 100000 pieces");
    refused("radial:1000x1000", "makes more than 100000 pieces");
    refused("voronoi:3:1:", "known are jitter, around, spread, density");
    refused("voronoi:3:1:2", "known are jitter, around, spread, density");
    refused("voronoi:3:axis=x", "known are jitter, around, spread, density");
    refused("wood:3:around=0,0,0", "known are jitter, axis, elongation, density");
    refused("grid:2x2:at=0,0,0", "known are jitter, brick, on");
    refused("radial:2x2:brick", "known are jitter, at, axis");
    refused("radial:2x2:=1", "known are jitter, at, axis");
    refused("voronoi:3:around=", "X,Y,Z");
    refused("voronoi:3:around=1,2", "X,Y,Z");
    refused("voronoi:3:around=1,2,nan", "X,Y,Z");
    refused("voronoi:3:around=1,2,3;", "X,Y,Z");
    refused("voronoi:3:spread=0", "is not a number from 0.000001 to 10");
    refused("voronoi:3:density=", "density=");
    refused("wood:3:elongation=0.5", "is not a number from 1 to 1000");
    refused("wood:3:axis=w", "x, -x, y, -y, z, -z, or X,Y,Z");
    refused("wood:3:axis=0,0,0", "x, -x, y, -y, z, -z, or X,Y,Z");
    refused("radial:2x2:at=1,2,inf", "X,Y,Z");
    refused("grid:2x2:on=sphere", "known are uv, planar[:AXIS], cylindrical[:AXIS] and box");
    refused("grid:2x2:on=", "known are uv, planar[:AXIS], cylindrical[:AXIS] and box");
    refused("grid:2x2:brick=no", "brick");
}

TEST_CASE("axes are letters with a sign or three numbers, and come out as unit vectors") {
    CHECK(*parseAxis("x") == glm::dvec3(1, 0, 0));
    CHECK(*parseAxis("-y") == glm::dvec3(0, -1, 0));
    CHECK(glm::length(*parseAxis("3,4,0") - glm::dvec3(0.6, 0.8, 0)) < 1e-15);
    for (const char* tiny : {"1e-20,0,0", "0,1e20,0", "-1e-29,2e-29,0"})
        CHECK(std::abs(glm::length(*parseAxis(tiny)) - 1) < 1e-12);
    for (const std::string bad :
         {"", "-", "--x", "w", "xy", "X", "1", "1,2", "1,2,3,4", "0,0,0", ",,", "nan,0,0",
          "inf,0,0", "1e300,1e300,0", "1e999,0,0", "1e-200,0,0", "1,2,3 "}) {
        CAPTURE(bad);
        const Result<glm::dvec3> axis = parseAxis(bad);
        REQUIRE_FALSE(axis.has_value());
        CHECK(axis.error().code == ErrorCode::badArgument);
        CHECK(axis.error().message.find("X,Y,Z") != std::string::npos);
    }
}

TEST_CASE("projections are uv, box, planar and cylindrical, the latter two with an axis or not") {
    CHECK(parseProjection("uv")->kind == Projection::Kind::uv);
    CHECK(parseProjection("box")->kind == Projection::Kind::box);
    CHECK(*parseProjection("planar") == Projection{Projection::Kind::planar, glm::dvec3(0.0)});
    CHECK(*parseProjection("planar:y") == Projection{Projection::Kind::planar, {0, 1, 0}});
    CHECK(*parseProjection("cylindrical:0,0,-2") ==
          Projection{Projection::Kind::cylindrical, {0, 0, -1}});
    for (const std::string bad : {"", "sphere", "planar:", "planar:0,0,0", "uv:x", "uv:", "box:z",
                                  "planar:x:y", "planar/x", "cylindrical:q"}) {
        CAPTURE(bad);
        const Result<Projection> projection = parseProjection(bad);
        REQUIRE_FALSE(projection.has_value());
        CHECK(projection.error().code == ErrorCode::badArgument);
        CHECK_FALSE(projection.error().message.empty());
    }
}

TEST_CASE("random words are read within bounds or refused with a message") {
    const std::vector<std::string> words{"voronoi", "grid",        "radial",   "wood",  ":",
                                         ":",       ":",           "4",        "3x5",   "x",
                                         "=",       "jitter=",     "0.5",      "-1",    "nan",
                                         "1e999",   "axis=",       "around=",  "1,2,3", ";",
                                         ",",       "on=",         "planar/",  "box",   "brick",
                                         "at=",     "spread=",     "density=", "color", "\xff",
                                         " ",       "elongation=", "y"};
    const int cases = propertyCases(20000);
    int read = 0;
    for (int i = 0; i < cases; ++i) {
        Random random(static_cast<uint32_t>(i));
        std::string text = words[random.below(4)];
        for (uint32_t n = random.below(10); n > 0; --n)
            text += words[random.below(static_cast<uint32_t>(words.size()))];
        CAPTURE(text);
        const Result<Pattern> p = parsePattern(text);
        if (!p) {
            REQUIRE(p.error().code == ErrorCode::badArgument);
            REQUIRE_FALSE(p.error().message.empty());
            continue;
        }
        ++read;
        REQUIRE((p->count >= 1 && p->count <= 100'000));
        REQUIRE((p->columns >= 1 && p->columns <= 1'000));
        REQUIRE((p->rows >= 1 && p->rows <= 1'000));
        REQUIRE((std::isfinite(p->jitter) && p->jitter <= 1));
        REQUIRE((p->spread > 0 && p->elongation >= 1));
        for (const glm::dvec3& place : p->around) REQUIRE(std::isfinite(glm::length(place)));
    }
    CHECK(read > 0);
}
