// SPDX-License-Identifier: MIT
#include "solid/crossing.h"
#include "solid/wall_crossings.h"

#include <doctest/doctest.h>

using namespace sherd;

namespace {

using Triangle = std::array<glm::dvec3, 3>;
const Triangle kFlat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

bool cross(const Triangle& other, double depth = 1e-9) {
    const bool result = trianglesCross(kFlat, other, depth);
    CHECK(trianglesCross(other, kFlat, depth) == result);
    return result;
}

}  // namespace

TEST_CASE("a triangle without area crosses nothing") {
    CHECK_FALSE(cross({{{1, 1, -1}, {1, 1, -1}, {1, 1, -1}}}));
}

TEST_CASE("triangles that only touch do not cross") {
    CHECK_FALSE(cross({{{0, 0, 0}, {4, 0, 0}, {0, 0, 4}}}));     // a common edge
    CHECK_FALSE(cross({{{0, 0, 0}, {-1, 0, 1}, {-1, 0, -1}}}));  // a common corner
    CHECK_FALSE(cross({{{1, 1, 0}, {2, 1, 1}, {1, 2, 1}}}));     // a corner on the face
    CHECK_FALSE(cross({{{1, 1, 0}, {5, 1, 0}, {1, 5, 0}}}));     // in one plane
}

TEST_CASE("triangles that go through each other cross, whichever of them has the edge") {
    CHECK(cross({{{1, 1, -1}, {1, 1, 1}, {9, 9, 1}}}));
    CHECK(cross({{{-1, 1, -9}, {-1, 1, 9}, {9, 1, 0}}}));
}

TEST_CASE("neighbours with one common corner cross where their other edges do") {
    CHECK(cross({{{0, 0, 0}, {2, 1, 1}, {2, 1, -1}}}));
}

TEST_CASE("how deep they cross counts") {
    CHECK(cross({{{1, 1, -1e-4}, {1, 1, 1}, {2, 1, 1}}}));
    CHECK_FALSE(cross({{{1, 1, -1e-4}, {1, 1, 1}, {2, 1, 1}}}, 1e-3));
}

TEST_CASE("a wall over a hollow of the surface leaves the solid, though it crosses nothing") {
    // An extruded L; the wall spans the notch between its legs, from edge to edge.
    const std::vector<glm::vec2> outline = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
    SplitSurface surface;
    for (const float z : {0.0F, 1.0F})
        for (const glm::vec2& p : outline) surface.positions.emplace_back(p.x, p.y, z);
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
        surface.triangles.push_back({{a, b, c}, 0, {}});
    };
    for (uint32_t k = 1; k < 5; ++k) {
        add(k + 1, k, 0);
        add(6, k + 6, k + 7);
    }
    for (uint32_t k = 0; k < 6; ++k) {
        const uint32_t next = (k + 1) % 6;
        add(k, next, next + 6);
        add(k, next + 6, k + 6);
    }
    const auto wallOver = [](std::array<uint32_t, 4> corners) {
        std::array<OutlineVertex, 4> v;
        for (size_t i = 0; i < 4; ++i) v[i].vertex = corners[i];
        return SolidWall{0, 1, {{v[0], v[1], v[2]}, {v[0], v[2], v[3]}}};
    };
    const WallCrossings crossings(surface);
    const SolidWall outside = wallOver({2, 4, 10, 8});
    CHECK_FALSE(crossings.crosses(outside, {}));
    CHECK(crossings.leaves(outside, {}));
    const SolidWall inside = wallOver({0, 3, 9, 6});
    CHECK_FALSE(crossings.crosses(inside, {}));
    CHECK_FALSE(crossings.leaves(inside, {}));
    const SolidWall along = wallOver({2, 3, 9, 8});
    CHECK_FALSE(crossings.leaves(along, {}));
}
