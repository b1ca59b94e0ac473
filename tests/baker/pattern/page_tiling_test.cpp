// SPDX-License-Identifier: MIT
// Drawings outside their page, and line ends led on to the next line.
#include "map/page_tiling.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "map/gap_closing.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Points = std::vector<glm::dvec2>;

std::vector<FractureMap::Line> lines(const std::vector<Points>& polylines) {
    std::vector<FractureMap::Line> result;
    for (const Points& points : polylines) result.push_back({points, 1, "test", {}});
    return result;
}

FractureMap mapOf(const std::vector<Points>& polylines) {
    FractureMap map;
    map.lines = lines(polylines);
    return map;
}

/// Whether some line of the tiling passes through the place, to 1e-6.
bool passes(const TiledLines& tiled, const glm::dvec2& p) {
    for (const FractureMap::Line& line : tiled.lines) {
        for (size_t i = 1; i < line.points.size(); ++i) {
            const glm::dvec2 a = line.points[i - 1];
            const glm::dvec2 ab = line.points[i] - a;
            const double length = glm::dot(ab, ab);
            const double t = length > 0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0, 1.0) : 0;
            if (glm::distance(a + ab * t, p) < 1e-6) return true;
        }
    }
    return false;
}

size_t dangling(const FractureMap& map) {
    const Result<PlanarMap> planar = planarise(map);
    REQUIRE(planar.has_value());
    std::vector<uint32_t> degree(planar->nodes.size(), 0);
    for (const MapEdge& e : planar->edges) {
        ++degree[e.from];
        ++degree[e.to];
    }
    return static_cast<size_t>(std::count(degree.begin(), degree.end(), 1U));
}

}  // namespace

TEST_CASE("the page alone is left as it is, no lines stay none") {
    const auto drawn = lines({{{0.1, 0.2}, {1.5, -0.3}}});
    const TiledLines same = tileLines(drawn, Wrap::repeat, Wrap::clamp, {});
    REQUIRE(same.lines.size() == 1);
    CHECK(same.lines[0].points == drawn[0].points);
    CHECK(tileLines({}, Wrap::mirror, Wrap::clamp, {-2, 2, -2, 2}).lines.empty());
}

TEST_CASE("repeated tiles are exact copies, negative ones too") {
    const auto drawn = lines({{{0.1, 1.0 / 3}, {0.7, 0.9}}, {{0.2, 0.2}, {0.3, 0.1}}});
    const TiledLines tiled = tileLines(drawn, Wrap::repeat, Wrap::repeat, {-2, 1, 0, 1});
    REQUIRE(tiled.lines.size() == 16);
    REQUIRE(tiled.lineOf.size() == 16);
    const Points& page = tiled.lines[4].points;  // tile (0, 0) is the third
    for (size_t i = 0; i < 16; ++i) {
        CHECK(tiled.lineOf[i] == i % 2);
        if (i % 2 != 0) continue;
        const glm::dvec2 shift = tiled.lines[i].points[0] - page[0];
        CHECK(shift == glm::dvec2(std::round(shift.x), std::round(shift.y)));
        CHECK(tiled.lines[i].points[1] - page[1] == shift);
        for (const glm::dvec2& p : tiled.lines[i].points)
            CHECK(p.x * 0x1p24 == std::round(p.x * 0x1p24));
    }
    CHECK(passes(tiled, {-1.9, 1.0 / 3}));
    CHECK(passes(tiled, {1.1, 1 + 1.0 / 3}));
}

TEST_CASE("mirrored tiles turn every other copy around and meet at the borders") {
    const auto drawn = lines({{{0.25, 0}, {1, 0.5}}});
    const TiledLines tiled = tileLines(drawn, Wrap::mirror, Wrap::mirror, {-1, 2, -1, 1});
    CHECK(tiled.lines.size() == 12);
    CHECK(passes(tiled, {-0.25, 0}));
    CHECK(passes(tiled, {-1, 0.5}));
    CHECK(passes(tiled, {1.75, 0}));
    CHECK(passes(tiled, {2.25, 0}));
    CHECK(passes(tiled, {0.25, 2}));
    CHECK(passes(tiled, {1, -0.5}));
}

TEST_CASE("clamped lines go on straight outwards where they leave the page, and only there") {
    const TileRange range{-1, 1, -1, 1};
    const TiledLines tiled =
        tileLines(lines({{{0.5, 0.5}, {1.5, 0.75}}}), Wrap::clamp, Wrap::clamp, range);
    CHECK(passes(tiled, {0.75, 0.5625}));
    CHECK(passes(tiled, {1.5, 0.625}));
    CHECK_FALSE(passes(tiled, {1.5, 0.75}));
    CHECK_FALSE(passes(tiled, {-0.5, 0.625}));
    // Through the whole page, and through a corner region: only the page's part counts.
    const TiledLines through =
        tileLines(lines({{{-1, 0.25}, {2, 0.25}}}), Wrap::clamp, Wrap::clamp, range);
    CHECK(passes(through, {-0.9, 0.25}));
    CHECK(passes(through, {1.9, 0.25}));
    CHECK(tileLines(lines({{{1.2, 0.5}, {1.5, 0.6}}}), Wrap::clamp, Wrap::clamp, range)
              .lines.empty());
    // Where no triangle reaches out, nothing is drawn there.
    const TiledLines left =
        tileLines(lines({{{-1, 0.25}, {2, 0.25}}}), Wrap::clamp, Wrap::repeat, {-1, 0, 0, 0});
    CHECK_FALSE(passes(left, {1.5, 0.25}));
    CHECK(passes(left, {-0.5, 0.25}));
}

TEST_CASE("a clamped line that ends right on the page's edge goes on outwards as well") {
    // The picture's last texel is dark there, and so is everything beyond.
    const TileRange range{-1, 1, -1, 1};
    const TiledLines tiled =
        tileLines(lines({{{0, 0.25}, {0.5, 0.5}, {1, 0.25}}}), Wrap::clamp, Wrap::clamp, range);
    CHECK(passes(tiled, {-0.5, 0.25}));
    CHECK(passes(tiled, {1.5, 0.25}));
    const TiledLines up = tileLines(lines({{{0.5, 1}, {0.5, 0}}}), Wrap::clamp, Wrap::clamp, range);
    CHECK(passes(up, {0.5, 1.5}));
    CHECK(passes(up, {0.5, -0.5}));
    // Touching the edge counts; running along it does not.
    const TiledLines touch =
        tileLines(lines({{{0.5, 0.25}, {1, 0.5}, {0.5, 0.75}}}), Wrap::clamp, Wrap::clamp, range);
    CHECK(passes(touch, {1.5, 0.5}));
    CHECK(passes(touch, {0.75, 0.625}));
}

TEST_CASE("clamped tiles show what the clamped place of the page shows") {
    const int cases = propertyCases(300);
    for (int i = 0; i < cases; ++i) {
        const auto seed = static_cast<uint32_t>(40 + i);
        CAPTURE(seed);
        Random random(seed);
        Points points;
        for (uint32_t n = 2 + random.below(4); n > 0; --n) {
            // Many on the page's edges, none twice in a row.
            const auto c = [&] {
                return random.below(3) == 0 ? 0.5 * random.below(3) : random.in(-0.4, 1.4);
            };
            points.emplace_back(c(), c());
        }
        const auto drawn = lines({points});
        const TiledLines page = tileLines(drawn, Wrap::clamp, Wrap::clamp, {});
        const TiledLines tiled = tileLines(drawn, Wrap::clamp, Wrap::clamp, {-1, 1, -1, 1});
        // Places of the drawing on the page are there; what is drawn outside shows a place inside.
        for (const FractureMap::Line& line : tiled.lines) {
            for (size_t k = 1; k < line.points.size(); ++k) {
                for (const double t : {0.1, 0.5, 0.9}) {
                    const glm::dvec2 p = glm::mix(line.points[k - 1], line.points[k], t);
                    REQUIRE(passes(page, glm::clamp(p, 0.0, 1.0)));
                }
            }
        }
        for (size_t k = 1; k < points.size(); ++k) {
            for (const double t : {0.1, 0.5, 0.9}) {
                const glm::dvec2 p = glm::mix(points[k - 1], points[k], t);
                if (p != glm::clamp(p, 0.0, 1.0) || points[k] == points[k - 1]) continue;
                REQUIRE(passes(tiled, p));
            }
        }
    }
}

TEST_CASE("copies of what sticks out of the grid keep their slope") {
    // In tile 7 the line's end would lie beyond the grid, at 8.5.
    const TiledLines tiled =
        tileLines(lines({{{0.5, 0.25}, {1.5, 0.75}}}), Wrap::repeat, Wrap::repeat, {0, 7, 0, 0});
    CHECK(passes(tiled, {7.75, 0.375}));
    const TiledLines left =
        tileLines(lines({{{0.5, 0.25}, {-0.5, 0.75}}}), Wrap::repeat, Wrap::repeat, {-8, 0, 0, 0});
    CHECK(passes(left, {-7.75, 0.375}));
    for (const TiledLines* t : {&tiled, &left})
        for (const FractureMap::Line& line : t->lines)
            for (const glm::dvec2& p : line.points) REQUIRE(std::abs(p.x) <= 8);
}

TEST_CASE("a line that ends short of another is led to it, within reach only") {
    const std::vector<Points> drawn{{{0.2, -0.1}, {0.2, 1.1}}, {{0.25, 0.5}, {0.9, 0.5}}};
    std::vector<uint32_t> lineOf;
    FractureMap far = mapOf(drawn);
    CHECK(closeGaps(far, 0.04, lineOf)->empty());
    CHECK(far.lines.size() == 2);
    CHECK(lineOf.empty());
    FractureMap near = mapOf(drawn);
    const auto closed = closeGaps(near, 0.06, lineOf);
    REQUIRE(closed->size() == 1);
    CHECK(glm::distance((*closed)[0].to, glm::dvec2(0.2, 0.5)) < 1e-6);
    CHECK(lineOf == std::vector<uint32_t>{1});
    CHECK(dangling(near) == dangling(mapOf(drawn)) - 1);
}

TEST_CASE("a nearly closed loop is closed, a lone line and a spike are not") {
    std::vector<uint32_t> lineOf;
    FractureMap loop = mapOf({{{0.5, 0.5}, {0.8, 0.5}, {0.8, 0.8}, {0.5, 0.8}, {0.5, 0.52}}});
    REQUIRE(closeGaps(loop, 0.05, lineOf).has_value());
    CHECK(dangling(loop) == 0);
    FractureMap lone = mapOf({{{0.2, 0.2}, {0.6, 0.7}}});
    CHECK(closeGaps(lone, 5, lineOf)->empty());
    FractureMap bent = mapOf({{{0.2, 0.2}, {0.5, 0.2}, {0.2, 0.21}}});
    CHECK(closeGaps(bent, 0.5, lineOf)->empty());
    FractureMap none;
    CHECK(closeGaps(none, 1, lineOf)->empty());
}

TEST_CASE("an end that lies within a rounding of a slanted line meets it") {
    FractureMap map = mapOf({{{0.1, 0.1}, {0.83, 0.457}}, {{0.4, 0.9}, {0.4, 0.0}}});
    // Where the first line is at 0.4, on the grid: most likely not exactly on it.
    const double v = 0.1 + 0.3 * 0.357 / 0.73;
    map.lines[1].points[1].y = v;
    std::vector<uint32_t> lineOf;
    REQUIRE(closeGaps(map, 1e-5, lineOf).has_value());
    CHECK(dangling(map) == 3);
}

TEST_CASE("any reach is safe, endless and not a number too") {
    for (const double reach :
         {0.0, -1.0, 1e300, std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::denorm_min()}) {
        FractureMap map = mapOf({{{0.2, 0.2}, {0.6, 0.7}}, {{0.7, 0.7}, {0.9, 0.9}}});
        std::vector<uint32_t> lineOf;
        CHECK(closeGaps(map, reach, lineOf).has_value());
        CHECK(lineOf.size() + 2 == map.lines.size());
    }
}

TEST_CASE(
    "closing gaps of random drawings leaves no more dangling ends, and bridges within reach") {
    const int cases = propertyCases(300);
    for (int i = 0; i < cases; ++i) {
        const auto seed = static_cast<uint32_t>(900 + i);
        CAPTURE(seed);
        Random random(seed);
        FractureMap map;
        for (uint32_t l = 2 + random.below(8); l > 0; --l) {
            FractureMap::Line line;
            for (uint32_t n = 2 + random.below(3); n > 0; --n)
                line.points.emplace_back(random.below(17) / 16.0, random.unit());
            map.lines.push_back(line);
        }
        const size_t before = dangling(map);
        const double reach = random.in(0, 0.3);
        std::vector<uint32_t> lineOf;
        const auto closed = closeGaps(map, reach, lineOf);
        REQUIRE(closed.has_value());
        for (const ClosedGap& gap : *closed)
            REQUIRE(glm::distance(gap.from, gap.to) <= reach + 1e-6);
        REQUIRE(dangling(map) <= before);
        REQUIRE(lineOf.size() == closed->size());
    }
}
