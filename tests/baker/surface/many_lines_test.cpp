// SPDX-License-Identifier: MIT
// A whole map inside one triangle: ten times the lines take about ten times as long.
#include <doctest/doctest.h>

#include <cmath>
#include <ctime>

#include "cutting.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Steps 1 to 5 on a square of two triangles, in seconds of CPU time; checks the components.
double secondsFor(const FractureMap& map, uint32_t components) {
    const SurfaceMesh square = flatSquare(1);
    const MeshTopology before = buildTopology(square.positions, square.triangles);
    const FracturePlan plan = planOf(map);
    CutOptions options;
    options.wrap = PageWrap::none;
    const std::clock_t start = std::clock();
    const Result<CutSurface> cut = cutSurface(square, before, plan, options);
    REQUIRE(cut.has_value());
    const Components found = floodFill(cut->surface, cut->topology, cut->lines, 1);
    const auto ticks = static_cast<double>(std::clock() - start);
    CHECK(found.leafCount == components);
    return std::max(ticks / CLOCKS_PER_SEC, 1e-3);
}

/// The square of the growth would be 100.
constexpr double kGrowth = 35;

}  // namespace

TEST_CASE("ten thousand segments of nested outlines inside one triangle take near-linear time") {
    const auto seconds = [](uint32_t outlines) {
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
        return secondsFor(linesOf(lines), outlines + 1);
    };
    seconds(10);
    CHECK(seconds(1250) / seconds(125) < kGrowth);
}

TEST_CASE("ten thousand parallel lines through one triangle take near-linear time") {
    const auto seconds = [](uint32_t count) {
        std::vector<std::vector<glm::dvec2>> lines;
        for (uint32_t i = 1; i <= count; ++i) {
            const double at = 0.5 * i / (count + 1);
            lines.push_back({{at - 1, -1}, {at + 1, 2}});
        }
        return secondsFor(linesOf(lines), count + 1);
    };
    seconds(10);
    CHECK(seconds(10'000) / seconds(1000) < kGrowth);
}

TEST_CASE("ten thousand short parallel lines inside one triangle take near-linear time") {
    const auto seconds = [](uint32_t count) {
        std::vector<std::vector<glm::dvec2>> lines;
        for (uint32_t i = 1; i <= count; ++i) {
            const double at = 0.3 + 0.6 * i / (count + 1);
            lines.push_back({{at, 0.2}, {at + 0.01, 0.28}});
        }
        return secondsFor(linesOf(lines), 1);
    };
    seconds(10);
    CHECK(seconds(10'000) / seconds(1000) < kGrowth);
}
