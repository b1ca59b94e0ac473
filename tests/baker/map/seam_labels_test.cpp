// SPDX-License-Identifier: MIT
#include "layout/seam_labels.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "layout/free_place.h"
#include "sherd/baker/layout.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

std::vector<SeamLabel> labelsOf(const SurfaceMesh& mesh) {
    return seamLabels({&mesh, 1});
}

/// The place in space that a point in UV of `chartedCube` shows.
glm::dvec3 onCube(const glm::dvec2& uv) {
    const int column = static_cast<int>(uv.x / 0.25);
    const int row = static_cast<int>(uv.y / 0.5);
    const int face = 3 * row + column;
    glm::dvec3 p(0.0);
    p[face / 2] = face % 2 == 0 ? 1 : 0;
    p[(face / 2 + 1) % 3] = (uv.x - 0.25 * column) / 0.2;
    p[(face / 2 + 2) % 3] = (uv.y - 0.5 * row) / 0.2;
    return p;
}

}  // namespace

TEST_CASE("a surface in one chart, or without any, has no seams to number") {
    CHECK(labelsOf(flatSquare(3)).empty());
    SurfaceMesh bare = chartedCube();
    bare.uvSemantic.clear();
    CHECK(labelsOf(bare).empty());
    CHECK(seamLabels({}).empty());
    SurfaceMesh collapsed = chartedCube();
    for (auto& t : collapsed.triangles) t = {0, 0, 0};
    CHECK(labelsOf(collapsed).empty());
}

TEST_CASE("each edge of a cube has one number, in the middle of it on both charts") {
    for (const int cells : {1, 3, 5}) {
        const std::vector<SeamLabel> labels = labelsOf(chartedCube(1, cells));
        CHECK(labels.size() == 12);
        for (const SeamLabel& label : labels) {
            CHECK(label.length == doctest::Approx(0.2));
            CHECK(glm::distance(onCube(label.at[0]), onCube(label.at[1])) < 1e-5);
            for (size_t side = 0; side < 2; ++side) {
                // A tenth of a face inwards stays on the same face and off its border.
                const glm::dvec3 inside = onCube(label.at[side] + 0.02 * label.inward[side]);
                const glm::dvec3 off = inside - onCube(label.at[side]);
                CHECK(glm::length(off) == doctest::Approx(0.1).epsilon(1e-4));
                const glm::dvec3 middle = glm::abs(inside - glm::dvec3(0.5));
                CHECK(std::max({middle.x, middle.y, middle.z}) == doctest::Approx(0.5));
            }
        }
    }
}

TEST_CASE("long stretches have several numbers") {
    // Two loops over the whole page, which meet in one vertex.
    const std::vector<SeamLabel> labels = labelsOf(torus(20, 20));
    CHECK(labels.size() == 8);
    std::set<std::pair<double, double>> places;
    for (const SeamLabel& label : labels)
        for (const glm::dvec2& at : label.at) places.insert({at.x, at.y});
    CHECK(places.size() == 16);
}

TEST_CASE("numbers are part of the guide and may be left out") {
    const SurfaceMesh mesh = chartedCube();
    const Result<Layout> with = makeLayoutSvg({&mesh, 1}, {});
    REQUIRE(with);
    CHECK(with->seamLabels == 12);
    CHECK(with->svg.find(">12</text>") != std::string::npos);
    const Result<FractureMap> map = readSvgMap(with->svg, "l.svg", {});
    REQUIRE_FALSE(map);
    CHECK(map.error().code == ErrorCode::emptyMap);
    LayoutOptions options;
    options.seamLabels = false;
    const Result<Layout> out = makeLayoutSvg({&mesh, 1}, options);
    REQUIRE(out);
    CHECK(out->seamLabels == 0);
    CHECK(out->svg.find("<text") == std::string::npos);
}

TEST_CASE("a free place lies beside the charts where there is room, and on the page always") {
    CHECK(freePlace({}, {0.2, 0.2}) == glm::dvec2(0, 0));
    const SurfaceMesh all = flatSquare(2);
    CHECK(freePlace({&all, 1}, {0.2, 0.2}) == glm::dvec2(0, 0));
    CHECK(freePlace({&all, 1}, {5, 0.2}) == glm::dvec2(0, 0));
    // Charts end at u = 0.7, and between v = 0.2 and 0.5.
    const SurfaceMesh cube = chartedCube();
    const glm::dvec2 place = freePlace({&cube, 1}, {0.25, 0.9});
    CHECK(place.x >= 0.7);
    CHECK(place.x <= 0.75);
    CHECK(freePlace({&cube, 1}, {0.9, 0.28}).y > 0.69);
}
