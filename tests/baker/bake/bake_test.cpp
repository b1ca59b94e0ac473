// SPDX-License-Identifier: MIT
// The whole pipeline on small meshes, judged by the file check, which shares no decision with it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "sherd/baker/bake.h"
#include "sherd/formats/glb_read.h"
#include "sherd/formats/glb_write.h"
#include "sherd/formats/validate.h"
#include "support/baked_file.h"
#include "support/plans.h"
#include "support/property.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FractureMap linesOf(const std::vector<std::vector<glm::dvec2>>& polylines, uint32_t level = 1) {
    FractureMap map;
    for (const auto& points : polylines) map.lines.push_back({points, level, "test"});
    return map;
}

/// A ring around the charted cube at height z.
void addRing(FractureMap& map, double z, uint32_t level) {
    for (int face : {0, 1})
        map.lines.push_back({{cubeUv(face, -0.01, z), cubeUv(face, 1.01, z)}, level, "ring"});
    for (int face : {2, 3})
        map.lines.push_back({{cubeUv(face, z, -0.01), cubeUv(face, z, 1.01)}, level, "ring"});
}

FractureMap twoRings() {
    FractureMap map;
    addRing(map, 0.4, 1);
    addRing(map, 0.7, 2);
    return map;
}

/// Two full turns each way around a torus chart.
FractureMap torusGrid() {
    FractureMap map = linesOf({{{0.21, -0.01}, {0.21, 1.01}}, {{0.74, -0.01}, {0.74, 1.01}}});
    map.lines.push_back({{{-0.01, 0.33}, {1.01, 0.33}}, 2, "test"});
    map.lines.push_back({{{-0.01, 0.81}, {1.01, 0.81}}, 2, "test"});
    return map;
}

/// Two separate unit cubes; the second's charts lie two tiles to the right of the first's.
SurfaceMesh twoCubes() {
    SurfaceMesh mesh = chartedCube(1, 3);
    const SurfaceMesh other = chartedCube(1, 3);
    const auto offset = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : other.positions) mesh.positions.push_back(p + glm::vec3(3, 0, 0));
    const auto corners = static_cast<uint32_t>(mesh.attributes[0].values.size() / 3);
    for (auto t : other.triangles)
        mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    for (auto c : other.corners)
        mesh.corners.push_back({c[0] + corners, c[1] + corners, c[2] + corners});
    mesh.triangleMaterials.resize(mesh.triangles.size(), 0);
    for (size_t a = 0; a < mesh.attributes.size(); ++a) {
        std::vector<float> values = other.attributes[a].values;
        if (mesh.attributes[a].semantic == "TEXCOORD_0") {
            for (size_t i = 0; i < values.size(); i += 2) values[i] += 2;  // a tile of its own
        }
        mesh.attributes[a].values.insert(mesh.attributes[a].values.end(), values.begin(),
                                         values.end());
    }
    return mesh;
}

/// The page is not repeated: what lies beside it is cut by what is drawn there.
Recipe unwrapped() {
    Recipe recipe;
    recipe.wrap = PageWrap::none;
    return recipe;
}

ErrorCode bakeError(const SurfaceMesh& mesh, const FractureMap& map, const Recipe& recipe = {}) {
    const Result<BakedObject> baked = bakeObject(mesh, planOf(map), recipe, 0);
    REQUIRE_FALSE(baked.has_value());
    CHECK_FALSE(baked.error().message.empty());
    return baked.error().code;
}

CheckReport checkSet(const SurfaceMesh& mesh, const FractureMap& map, const Recipe& recipe = {}) {
    return checkBaked(mesh, planOf(map), recipe);
}

}  // namespace

TEST_CASE("a cube with a ring around it breaks into two closed halves of its volume") {
    FractureMap map;
    addRing(map, 0.4, 1);
    const Result<BakedObject> baked = bakeObject(chartedCube(1, 4), planOf(map), {}, 0);
    REQUIRE(baked.has_value());
    const FractureSet& set = baked->set;
    REQUIRE(set.fragments.size() == 3);
    CHECK(set.fragments[0].children.count == 2);
    CHECK(baked->report.levels[1].closed == 2);
    const double sum = set.fragments[1].volume + set.fragments[2].volume;
    CHECK(sum == doctest::Approx(1).epsilon(0.02));
    CHECK(set.fragments[0].volume == doctest::Approx(sum));
    REQUIRE(set.bonds.size() == 1);
    CHECK(std::abs(set.bonds[0].normal.z) > 0.9F);
    CHECK(checkSet(chartedCube(1, 4), map).passed());
}

TEST_CASE("the file check passes what the baker makes of a torus on two levels") {
    const CheckReport report = checkSet(torus(24, 12), torusGrid());
    CHECK(report.passed());
    REQUIRE(report.objects[0].levels.size() == 3);
    CHECK(report.objects[0].levels[1].fragments == 2);
    CHECK(report.objects[0].levels[2].fragments == 4);
}

TEST_CASE("a piece that its level does not divide stands for itself at deeper levels") {
    FractureMap map;
    addRing(map, 0.4, 1);
    addRing(map, 0.7, 2);  // divides the upper piece only
    const Result<BakedObject> baked = bakeObject(chartedCube(1, 4), planOf(map), {}, 0);
    REQUIRE(baked.has_value());
    CHECK(baked->set.fragments.size() == 5);
    CHECK(fragmentsAtLevel(baked->set, 1).size() == 2);
    CHECK(fragmentsAtLevel(baked->set, 2).size() == 3);
}

TEST_CASE("children own the outer surface of their parent, one run in every primitive") {
    const Result<BakedObject> baked = bakeObject(torus(24, 12), planOf(torusGrid()), {}, 0);
    REQUIRE(baked.has_value());
    const FractureSet& set = baked->set;
    const size_t primitives = set.geometry.primitives.size();
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        const Range children = set.fragments[f].children;
        if (children.count == 0) continue;
        for (size_t p = 0; p < primitives; ++p) {
            uint32_t next = set.fragmentRanges[f * primitives + p].first;
            for (uint32_t c = children.first; c < children.first + children.count; ++c) {
                const Range range = set.fragmentRanges[c * primitives + p];
                CHECK(range.first == next);
                next += range.count;
            }
            CHECK(next == set.fragmentRanges[f * primitives + p].first +
                              set.fragmentRanges[f * primitives + p].count);
        }
    }
}

TEST_CASE("every attribute is interpolated and nothing is dropped") {
    SurfaceMesh mesh = torus(12, 8);
    const size_t count = mesh.attributes[0].values.size() / 3;
    mesh.attributes.push_back({"COLOR_0", 4, std::vector<float>(count * 4, 0.25F)});
    Attribute heat{"_HEAT", 1, {}};
    for (size_t i = 0; i < count; ++i)
        heat.values.push_back(mesh.attributes[1].values[2 * i]);  // = u
    mesh.attributes.push_back(heat);
    const Result<BakedObject> baked = bakeObject(mesh, planOf(torusGrid()), {}, 0);
    REQUIRE(baked.has_value());
    const FractureGeometry& geometry = baked->set.geometry;
    REQUIRE(geometry.attributes.size() == 4);
    const Attribute* uv = findAttribute(geometry.attributes, "TEXCOORD_0");
    const Attribute* warm = findAttribute(geometry.attributes, "_HEAT");
    const Attribute* color = findAttribute(geometry.attributes, "COLOR_0");
    REQUIRE((uv != nullptr && warm != nullptr && color != nullptr));
    for (const Primitive& primitive : geometry.primitives) {
        for (uint32_t i = 0; i < primitive.indices.count; ++i) {
            const uint32_t v = geometry.indices[primitive.indices.first + i];
            if (primitive.exposedFrom == 0) {
                CHECK(warm->values[v] == doctest::Approx(uv->values[2 * v]).epsilon(1e-5));
                CHECK(color->values[4 * v] == doctest::Approx(0.25F));
            } else {
                CHECK(color->values[4 * v] == 1.0F);
            }
        }
    }
}

TEST_CASE("the same input gives the same bytes, whatever the number of threads") {
    Recipe one;
    one.threads = 1;
    Recipe four;
    four.threads = 4;
    const Result<BakedObject> a = bakeObject(torus(24, 12), planOf(torusGrid()), one, 0);
    const Result<BakedObject> b = bakeObject(torus(24, 12), planOf(torusGrid()), four, 0);
    REQUIRE((a.has_value() && b.has_value()));
    CHECK(a->set.geometry.positions == b->set.geometry.positions);
    CHECK(a->set.geometry.indices == b->set.geometry.indices);
    CHECK(a->set.hullPoints == b->set.hullPoints);
    CHECK(a->set.bonds.size() == b->set.bonds.size());
}

TEST_CASE("scaling the input by a power of two scales the pieces and changes nothing else") {
    for (const float scale : {0.0009765625F, 1024.0F}) {
        CAPTURE(scale);
        const Result<BakedObject> plain = bakeObject(chartedCube(1, 4), planOf(twoRings()), {}, 0);
        const Result<BakedObject> scaled =
            bakeObject(chartedCube(scale, 4), planOf(twoRings()), {}, 0);
        REQUIRE((plain.has_value() && scaled.has_value()));
        CHECK(plain->set.geometry.indices == scaled->set.geometry.indices);
        REQUIRE(plain->set.geometry.positions.size() == scaled->set.geometry.positions.size());
        for (size_t i = 0; i < plain->set.geometry.positions.size(); ++i) {
            REQUIRE(plain->set.geometry.positions[i] * scale == scaled->set.geometry.positions[i]);
        }
    }
}

TEST_CASE("scaling by a thousand keeps counts and volumes") {
    for (const float scale : {0.001F, 1000.0F}) {
        const Result<BakedObject> plain = bakeObject(torus(24, 12), planOf(torusGrid()), {}, 0);
        const Result<BakedObject> scaled =
            bakeObject(torus(24, 12, scale, 0.4 * scale), planOf(torusGrid()), {}, 0);
        REQUIRE((plain.has_value() && scaled.has_value()));
        REQUIRE(plain->set.fragments.size() == scaled->set.fragments.size());
        const double cube = std::pow(static_cast<double>(scale), 3);
        // A torus is all ties: which of the points around its medial circle stand, rounding says.
        CHECK(scaled->set.fragments[0].volume / cube ==
              doctest::Approx(plain->set.fragments[0].volume).epsilon(5e-4));
    }
}

TEST_CASE("what cannot be baked is refused with its own code") {
    const FractureMap ring = twoRings();
    SUBCASE("no texture coordinates") {
        SurfaceMesh mesh = chartedCube();
        mesh.uvSemantic.clear();
        CHECK(bakeError(mesh, ring) == ErrorCode::noTextureCoordinates);
    }
    SUBCASE("no line") {
        CHECK(bakeError(chartedCube(), {}) == ErrorCode::emptyMap);
    }
    SUBCASE("lines that separate nothing") {
        CHECK(bakeError(chartedCube(), linesOf({{cubeUv(0, 0.2, 0.2), cubeUv(0, 0.8, 0.7)}})) ==
              ErrorCode::separatesNothing);
    }
    SUBCASE("a second level that separates nothing more") {
        FractureMap map;
        addRing(map, 0.4, 1);
        map.lines.push_back({{cubeUv(0, 0.2, 0.2), cubeUv(0, 0.8, 0.3)}, 2, "test"});
        CHECK(bakeError(chartedCube(), map) == ErrorCode::separatesNothing);
    }
    SUBCASE("an open surface") {
        CHECK(bakeError(flatSquare(4), linesOf({{{-0.1, 0.4}, {1.1, 0.4}}})) ==
              ErrorCode::openMesh);
    }
    SUBCASE("a non-manifold edge") {
        SurfaceMesh mesh = chartedCube();
        mesh.triangles.push_back(mesh.triangles[0]);
        mesh.corners.push_back(mesh.corners[0]);
        mesh.triangleMaterials.push_back(0);
        CHECK(bakeError(mesh, ring) == ErrorCode::nonManifoldMesh);
    }
    SUBCASE("inside out") {
        SurfaceMesh mesh = chartedCube();
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
        for (auto& c : mesh.corners) std::swap(c[1], c[2]);
        CHECK(bakeError(mesh, ring) == ErrorCode::invalidData);
    }
    SUBCASE("only degenerate triangles") {
        SurfaceMesh mesh = chartedCube();
        for (auto& t : mesh.triangles) t[1] = t[0];
        CHECK(bakeError(mesh, ring) == ErrorCode::noTriangles);
    }
}

TEST_CASE(
    "an open box bakes when allowed: its pieces are closed by a rim, and the report says so") {
    SurfaceMesh mesh = chartedCube(1, 4);
    const size_t lid = mesh.triangles.size() / 6;  // the last face, -z, is left off
    mesh.triangles.resize(mesh.triangles.size() - lid);
    mesh.corners.resize(mesh.triangles.size());
    mesh.triangleMaterials.resize(mesh.triangles.size());
    Recipe recipe;
    recipe.allowOpen = true;
    FractureMap map;
    addRing(map, 0.6, 1);
    const Result<BakedObject> baked = bakeObject(mesh, planOf(map), recipe, 0);
    if (!baked) FAIL(baked.error().message);
    CHECK(baked->report.levels[1].fragments == 2);
    CHECK(baked->report.levels[1].closed == 2);
    CHECK(baked->report.levels[0].closed == 0);
    const auto& findings = baked->report.findings;
    CHECK(std::any_of(findings.begin(), findings.end(),
                      [](const BakeFinding& f) { return f.code == "open-mesh" && f.count == 16; }));
}

TEST_CASE(
    "two closed parts: a line on one leaves the other a piece of its own, without hidden faces") {
    const SurfaceMesh mesh = twoCubes();
    FractureMap map;
    addRing(map, 0.4, 1);
    const Result<BakedObject> baked = bakeObject(mesh, planOf(map), unwrapped(), 0);
    if (!baked) FAIL(baked.error().message);
    CHECK(baked->report.parts == 2);
    CHECK(baked->report.levels[1].fragments == 3);
    CHECK(baked->report.levels[1].closed == 3);
    float largest = 0;
    for (uint32_t f = 1; f < 4; ++f) largest = std::max(largest, baked->set.fragments[f].volume);
    CHECK(largest == doctest::Approx(1));  // the whole second cube
}

TEST_CASE("the page is repeated beside itself, as textures are, unless it is told not to be") {
    FractureMap map;
    addRing(map, 0.4, 1);
    const Result<BakedObject> baked = bakeObject(twoCubes(), planOf(map), {}, 0);
    if (!baked) FAIL(baked.error().message);
    CHECK(baked->report.levels[1].fragments == 4);
}

TEST_CASE("two parts cut from different levels on: what only level 2 divides adds up as well") {
    // A part that was whole and solid at level 1 once had no sheet there, and a core at level 2.
    SurfaceMesh mesh = twoCubes();
    FractureMap map;
    addRing(map, 0.4, 1);
    for (FractureMap::Line line : std::vector<FractureMap::Line>(map.lines)) {
        for (glm::dvec2& p : line.points) p.x += 2;
        line.level = 2;
        map.lines.push_back(line);
    }
    const CheckReport report = checkSet(mesh, map, unwrapped());
    CHECK(report.passed());
    CHECK(report.objects[0].levels[1].fragments == 3);
    CHECK(report.objects[0].levels[2].fragments == 4);
}

TEST_CASE("an object far from its origin bakes into a file that passes the check") {
    SurfaceMesh mesh = chartedCube(1, 3);
    for (glm::vec3& p : mesh.positions) p.x += 65536;
    FractureMap map;
    addRing(map, 0.4, 1);
    CHECK(checkSet(mesh, map).passed());
}

TEST_CASE("a level whose pieces are all too small is refused with that reason") {
    FractureMap map;
    addRing(map, 0.4, 1);
    map.lines.push_back(
        {{cubeUv(0, 0.5, 0.5), cubeUv(0, 0.501, 0.5), cubeUv(0, 0.5, 0.501), cubeUv(0, 0.5, 0.5)},
         2,
         "dot"});
    Recipe recipe;
    recipe.minimumComponentShare = 1e-3;
    const Result<BakedObject> baked = bakeObject(chartedCube(1, 3), planOf(map), recipe, 0);
    REQUIRE_FALSE(baked.has_value());
    CHECK(baked.error().code == ErrorCode::separatesNothing);
    CHECK(baked.error().message.find("too small") != std::string::npos);
}

TEST_CASE("sizes whose masses do not fit a float are refused with the size") {
    for (const float size : {1e-9F, 1e12F}) {
        CHECK(bakeError(chartedCube(size), twoRings()) == ErrorCode::limitExceeded);
    }
}

TEST_CASE("a flat sheet is refused, or becomes a shell where open surfaces are allowed") {
    const FractureMap map = linesOf({{{-0.1, 0.4}, {1.1, 0.4}}});
    CHECK(bakeError(flatSquare(4), map) == ErrorCode::openMesh);
    Recipe recipe;
    recipe.allowOpen = true;
    const Result<BakedObject> baked = bakeObject(flatSquare(4), planOf(map), recipe, 0);
    REQUIRE(baked.has_value());
    CHECK(baked->report.levels.at(1).closed == 2);
}

TEST_CASE(
    "random maps on closed meshes bake into files that pass the check, or are refused with a "
    "reason") {
    const int cases = propertyCases(60);
    int bakedCount = 0;
    for (int i = 0; i < cases; ++i) {
        const auto seed = static_cast<uint32_t>(7000 + i);
        CAPTURE(seed);
        Random random(seed);
        FractureMap map;
        for (uint32_t l = 0; l < 6; ++l) {
            FractureMap::Line line;
            line.level = 1 + l % 2;
            for (uint32_t p = 0; p < 3; ++p)
                line.points.emplace_back(random.in(-0.2, 1.2), random.in(-0.2, 1.2));
            line.points.push_back(line.points[0]);
            map.lines.push_back(line);
        }
        const SurfaceMesh mesh = random.below(2) == 0 ? torus(12, 8) : chartedCube(1, 3);
        const Result<BakedObject> baked = bakeObject(mesh, planOf(map), {}, 0);
        if (!baked) {
            CHECK(baked.error().code == ErrorCode::separatesNothing);
            continue;
        }
        ++bakedCount;
        CHECK(checkSet(mesh, map).passed());
    }
    CHECK(bakedCount * 2 > cases);
}
