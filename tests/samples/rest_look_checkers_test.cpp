// SPDX-License-Identifier: MIT
// What compares pictures, without drawing any.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "rest_look.h"

using namespace sherd;
using namespace sherd::test;
using namespace sherd::samples;

namespace {

/// 20 x 10 pixels looking along -z at the square [-1, 1] x [-0.5, 0.5], without perspective.
PixelGrid flatGrid() {
    glm::mat4 camera(1.0F);
    camera[1][1] = 2;
    return {20, 10, camera};
}

size_t countFlags(const std::vector<bool>& flags) {
    return size_t(std::count(flags.begin(), flags.end(), true));
}

}  // namespace

TEST_CASE("a pixel is near a line when its centre is at most one pixel away") {
    const LineSegments line{{glm::vec3(-2, 0, 0), glm::vec3(2, 0, 0)}};
    const std::vector<bool> flags = nearLines(flatGrid(), line, {});
    // The line runs between rows 4 and 5, half a pixel from the centres of both.
    for (size_t i = 0; i < flags.size(); ++i) CHECK(flags[i] == (i / 20 == 4 || i / 20 == 5));
}

TEST_CASE("a line of no length flags the pixels around its place") {
    const LineSegments line{{glm::vec3(0), glm::vec3(0)}};
    // Where four pixels meet.
    CHECK(countFlags(nearLines(flatGrid(), line, {})) == 4);
}

TEST_CASE("only lines that can be seen past the triangles flag pixels") {
    const std::vector<std::array<glm::vec3, 3>> before{
        {glm::vec3(-9, -9, 0), glm::vec3(9, -9, 0), glm::vec3(0, 9, 0)}};
    PixelGrid grid = flatGrid();
    // Perspective along -z from (0, 0, 1): w, the depth, is 1 - z.
    grid.camera[2][3] = -1;
    const LineSegments hidden{{glm::vec3(-0.5F, 0, -0.5F), glm::vec3(0.5F, 0, -0.5F)}};
    const LineSegments upon{{glm::vec3(-0.5F, 0, 0), glm::vec3(0.5F, 0, 0)}};
    CHECK(countFlags(nearLines(grid, hidden, {})) > 0);
    CHECK(countFlags(nearLines(grid, hidden, before)) == 0);
    CHECK(countFlags(nearLines(grid, upon, before)) > 0);
}

TEST_CASE("lines outside the picture flag nothing") {
    const LineSegments line{{glm::vec3(-5, 3, 0), glm::vec3(5, 3, 0)}};
    CHECK(countFlags(nearLines(flatGrid(), line, {})) == 0);
}

TEST_CASE("two pictures differ by the worst channel of the compared pixels") {
    Picture whole{2, 1, {10, 20, 30, 40, 50, 60}};
    Picture pieces{2, 1, {10, 24, 30, 200, 50, 60}};
    const LookDifference both = comparePictures(whole, pieces, {false, false});
    CHECK(both.worst == 160);
    CHECK(both.at.x == 1);
    CHECK(both.pixels == 2);
    const LookDifference first = comparePictures(whole, pieces, {false, true});
    CHECK(first.worst == 4);
    CHECK(first.pixels == 1);
    CHECK(first.skipped == 1);
}
