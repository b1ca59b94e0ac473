// SPDX-License-Identifier: MIT
#include "solid/crossing.h"

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
