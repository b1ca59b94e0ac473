// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>

#include "levels/wall_overlay.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

constexpr int32_t kSide = WallOverlayInput::kSide;

/// The frame with inner points, each of which divides the triangle that holds it in three.
WallOverlayInput twoCuts(const std::array<std::vector<GridPoint>, 2>& inner) {
    WallOverlayInput input;
    input.points = {{0, 0}, {kSide, 0}, {0, kSide}};
    for (size_t side = 0; side < 2; ++side) {
        auto& cut = input.cuts[side];
        cut = {{0, 1, 2}};
        for (const GridPoint p : inner[side]) {
            const auto v = static_cast<uint32_t>(input.points.size());
            input.points.push_back(p);
            for (size_t t = 0; t < cut.size(); ++t) {
                const std::array<uint32_t, 3> whole = cut[t];
                bool holds = true;
                for (size_t k = 0; k < 3; ++k)
                    holds = holds && orientation(input.points[whole[k]],
                                                 input.points[whole[(k + 1) % 3]], p) > 0;
                if (!holds) continue;
                cut[t] = {whole[0], whole[1], v};
                cut.push_back({whole[1], whole[2], v});
                cut.push_back({whole[2], whole[0], v});
                break;
            }
        }
    }
    for (const GridPoint p : input.points) input.shape.emplace_back(p.u, p.v);
    return input;
}

/// Twice the areas of the parts, by the triangle of each cut that holds them, against those of the
/// triangles; over floating-point places, on its own.
void checkAreas(const WallOverlayInput& input, const WallOverlay& overlay) {
    std::vector<glm::dvec2> at = input.shape;
    for (const WallOverlay::OnEdge& p : overlay.crossings)
        at.push_back(at[p.a] + (at[p.b] - at[p.a]) * p.share);
    const auto area = [&](const std::array<uint32_t, 3>& v) {
        const glm::dvec2 s = at[v[1]] - at[v[0]], t = at[v[2]] - at[v[0]];
        return (s.x * t.y - s.y * t.x) / kSide / kSide;
    };
    for (size_t side = 0; side < 2; ++side) {
        std::vector<double> sums(input.cuts[side].size(), 0);
        for (const WallOverlay::Part& part : overlay.parts) {
            CHECK(area(part.v) > -1e-15);
            sums[part.of[side]] += area(part.v);
        }
        for (size_t t = 0; t < sums.size(); ++t)
            CHECK(sums[t] == doctest::Approx(area(input.cuts[side][t])).epsilon(1e-9));
    }
}

}  // namespace

TEST_CASE("an uncut wall takes the cut of its other side") {
    const WallOverlayInput input = twoCuts({{{{kSide / 4, kSide / 4}}, {}}});
    const auto overlay = overlayWall(input);
    REQUIRE(overlay.has_value());
    CHECK(overlay->crossings.empty());
    CHECK(overlay->parts.size() == 3);
    checkAreas(input, *overlay);
}

TEST_CASE("lines of both sides that cross meet in a point of both") {
    const WallOverlayInput input = twoCuts({{{{kSide / 8, kSide / 8}}, {{kSide / 2, kSide / 4}}}});
    const auto overlay = overlayWall(input);
    REQUIRE(overlay.has_value());
    CHECK(overlay->crossings.size() == 1);
    CHECK(overlay->onEdges.size() == 2);  // it is on an edge of either side
    checkAreas(input, *overlay);
}

TEST_CASE("random cuts of a wall overlay to parts that fill the triangles of both") {
    for (const uint32_t seed : propertySeeds(9'000'000, 300)) {
        CAPTURE(seed);
        Random random(seed);
        std::array<std::vector<GridPoint>, 2> inner;
        // Few places, so that lines meet in points and lie on each other.
        const int32_t cells = random.oneIn(2) ? 8 : 1 << 20;
        for (auto& points : inner) {
            for (uint32_t n = random.below(6); n > 0; --n) {
                const auto u =
                    static_cast<int32_t>(1 + random.below(static_cast<uint32_t>(cells - 2)));
                const auto v =
                    static_cast<int32_t>(1 + random.below(static_cast<uint32_t>(cells - 1 - u)));
                const GridPoint p{u * (kSide / cells), v * (kSide / cells)};
                const auto known = [&](const std::vector<GridPoint>& list) {
                    return std::find(list.begin(), list.end(), p) != list.end();
                };
                if (u + v < cells && !known(inner[0]) && !known(inner[1])) points.push_back(p);
            }
        }
        const WallOverlayInput input = twoCuts(inner);
        // A point on an edge of its cut divides nothing: then it is of no triangle.
        const auto overlay = overlayWall(input);
        REQUIRE(overlay.has_value());
        checkAreas(input, *overlay);
    }
}

TEST_CASE("a cut that does not fill the wall is refused") {
    WallOverlayInput input = twoCuts({{{{kSide / 4, kSide / 4}}, {}}});
    input.cuts[0].pop_back();
    CHECK_FALSE(overlayWall(input).has_value());
    input = twoCuts({{{{kSide / 4, kSide / 4}}, {}}});
    input.points[3] = {-5, kSide / 4};  // outside: triangles turn over
    CHECK_FALSE(overlayWall(input).has_value());
}
