// SPDX-License-Identifier: MIT
// A whole map of ten thousand lines inside one triangle.
#include <doctest/doctest.h>

#include <cmath>

#include "cutting.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Steps 1 to 5 on a square of two triangles; checks the components. A step that takes the square
/// of the lines would run into the tests' time limit; `sherd_bench_surface` measures the growth.
void cutInto(const FractureMap& map, uint32_t components) {
    const SurfaceMesh square = flatSquare(1);
    const MeshTopology before = buildTopology(square.positions, square.triangles);
    const FracturePlan plan = planOf(map);
    CutOptions options;
    options.wrap = PageWrap::none;
    const Result<CutSurface> cut = cutSurface(square, before, plan, options);
    REQUIRE(cut.has_value());
    CHECK(floodFill(cut->surface, cut->topology, cut->lines, 1).leafCount == components);
    CHECK(isFaithfulSplit(square, before, *cut, 1e-6));
}

}  // namespace

TEST_CASE("ten thousand segments of nested outlines inside one triangle are cut like ten") {
    const auto cut = [](uint32_t outlines) {
        std::vector<std::vector<glm::dvec2>> lines;
        for (uint32_t i = 1; i <= outlines; ++i) {
            std::vector<glm::dvec2> octagon;
            for (int k = 0; k <= 8; ++k) {
                const double a = M_PI / 4 * (k % 8);
                octagon.push_back(glm::dvec2(0.7, 0.25) +
                                  0.2 * i / outlines * glm::dvec2(std::cos(a), std::sin(a)));
            }
            lines.push_back(octagon);
        }
        cutInto(linesOf(lines), outlines + 1);
    };
    for (const uint32_t outlines : {10U, 1250U}) cut(outlines);
}

TEST_CASE("ten thousand parallel lines through one triangle are cut like ten") {
    const auto cut = [](uint32_t count) {
        std::vector<std::vector<glm::dvec2>> lines;
        for (uint32_t i = 1; i <= count; ++i) {
            const double at = 0.5 * i / (count + 1);
            lines.push_back({{at - 1, -1}, {at + 1, 2}});
        }
        cutInto(linesOf(lines), count + 1);
    };
    for (const uint32_t count : {10U, 10'000U}) cut(count);
}

TEST_CASE("ten thousand short parallel lines inside one triangle are cut like ten") {
    const auto cut = [](uint32_t count) {
        std::vector<std::vector<glm::dvec2>> lines;
        for (uint32_t i = 1; i <= count; ++i) {
            const double at = 0.3 + 0.6 * i / (count + 1);
            lines.push_back({{at, 0.2}, {at + 0.01, 0.28}});
        }
        cutInto(linesOf(lines), 1);
    };
    for (const uint32_t count : {10U, 10'000U}) cut(count);
}
