// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <chrono>
#include <limits>
#include <numeric>

#include "arrangement_oracle.h"
#include "map/planar_map.h"
#include "support/property.h"

using namespace sherd;
using test::OracleSegment;
using test::Rational;
using test::RationalPoint;

namespace {

/// A map of separate segments given in grid units.
FractureMap mapOf(const std::vector<OracleSegment>& segments) {
    FractureMap map;
    for (const OracleSegment& s : segments) {
        const auto [a, b, c, d] = s.ends;
        const double one = kGridOne;
        map.lines.push_back({{{static_cast<double>(a) / one, static_cast<double>(b) / one},
                              {static_cast<double>(c) / one, static_cast<double>(d) / one}},
                             s.level,
                             "test"});
    }
    return map;
}

RationalPoint exactPosition(const PlanarMap& map, const MapNode& node) {
    if (node.first < 0) return {node.point.u, node.point.v};
    const auto [a, b] = map.supports[static_cast<size_t>(node.first)];
    const auto [c, d] = map.supports[static_cast<size_t>(node.second)];
    const LineParameter p = crossingParameter(a, b, c, d).value();
    const Rational t(p.num, p.den);
    return {Rational(a.u) + t * Rational(b.u - a.u), Rational(a.v) + t * Rational(b.v - a.v)};
}

PlanarMap planarised(const FractureMap& map) {
    Result<PlanarMap> result = planarise(map);
    REQUIRE(result);
    return *result;
}

/// Points, edges with levels, and components equal the oracle's.
void checkAgainstOracle(const std::vector<OracleSegment>& segments) {
    const PlanarMap map = planarised(mapOf(segments));
    const test::OracleArrangement expected = test::arrange(segments);

    std::vector<RationalPoint> position;
    for (const MapNode& node : map.nodes) position.push_back(exactPosition(map, node));
    std::vector<RationalPoint> sorted = position;
    std::sort(sorted.begin(), sorted.end());
    CHECK((sorted == expected.points));

    std::map<std::pair<RationalPoint, RationalPoint>, uint32_t> edges;
    std::vector<std::pair<size_t, size_t>> pairs;
    for (const MapEdge& edge : map.edges) {
        CHECK(position[edge.from] < position[edge.to]);
        edges[{position[edge.from], position[edge.to]}] = edge.level;
        pairs.emplace_back(edge.from, edge.to);
        CHECK(segments[edge.line].level == edge.level);
    }
    CHECK(edges.size() == map.edges.size());
    CHECK((edges == expected.edges));

    std::vector<std::pair<size_t, size_t>> expectedPairs;
    const auto indexOf = [&](const RationalPoint& p) {
        return static_cast<size_t>(
            std::lower_bound(expected.points.begin(), expected.points.end(), p) -
            expected.points.begin());
    };
    for (const auto& [ends, level] : expected.edges)
        expectedPairs.emplace_back(indexOf(ends.first), indexOf(ends.second));
    CHECK(test::componentsOf(map.nodes.size(), pairs) ==
          test::componentsOf(expected.points.size(), expectedPairs));
}

bool sameMap(const PlanarMap& x, const PlanarMap& y) {
    const auto node = [](const MapNode& a, const MapNode& b) {
        return a.point == b.point && a.first == b.first && a.second == b.second;
    };
    const auto edge = [](const MapEdge& a, const MapEdge& b) {
        return a.from == b.from && a.to == b.to && a.support == b.support && a.level == b.level;
    };
    return std::equal(x.nodes.begin(), x.nodes.end(), y.nodes.begin(), y.nodes.end(), node) &&
           std::equal(x.edges.begin(), x.edges.end(), y.edges.begin(), y.edges.end(), edge);
}

}  // namespace

TEST_CASE("a map without lines is an empty planar map") {
    const PlanarMap map = planarised({});
    CHECK(map.nodes.empty());
    CHECK(map.edges.empty());
}

TEST_CASE("a line without length is dropped with a warning") {
    const PlanarMap map = planarised(mapOf({{{5, 5, 5, 5}, 1}}));
    CHECK(map.edges.empty());
    CHECK(map.warnings.size() == 1);
}

TEST_CASE("the same line drawn twice and backwards is one edge") {
    const PlanarMap map =
        planarised(mapOf({{{0, 0, 7, 3}, 2}, {{0, 0, 7, 3}, 1}, {{7, 3, 0, 0}, 3}}));
    REQUIRE(map.edges.size() == 1);
    CHECK(map.nodes.size() == 2);
    CHECK(map.edges[0].level == 1);
    CHECK(map.edges[0].line == 1);
}

TEST_CASE("overlapping collinear lines split at each other's ends and keep the coarsest level") {
    const PlanarMap map =
        planarised(mapOf({{{0, 0, 6, 6}, 2}, {{2, 2, 8, 8}, 1}, {{3, 3, 4, 4}, 1}}));
    CHECK(map.supports.size() == 1);
    CHECK(map.nodes.size() == 6);
    REQUIRE(map.edges.size() == 5);
    CHECK(map.edges[0].level == 2);
    for (size_t i = 1; i < 5; ++i) CHECK(map.edges[i].level == 1);
}

TEST_CASE("collinear lines with a gap between them stay apart") {
    const PlanarMap map = planarised(mapOf({{{0, 0, 2, 2}, 1}, {{3, 3, 5, 5}, 1}}));
    CHECK(map.supports.size() == 2);
    CHECK(map.nodes.size() == 4);
    CHECK(map.edges.size() == 2);
}

TEST_CASE("two crossing lines meet in one implicit node") {
    const PlanarMap map = planarised(mapOf({{{0, 0, 3, 1}, 1}, {{0, 1, 3, 0}, 1}}));
    CHECK(map.nodes.size() == 5);
    CHECK(map.edges.size() == 4);
    CHECK(map.nodes[4].first == 0);
    CHECK(map.nodes[4].second == 1);
    CHECK(nodeUv(map, 4).x * kGridOne == doctest::Approx(1.5));
    CHECK(nodeUv(map, 4).y * kGridOne == doctest::Approx(0.5));
}

TEST_CASE("a crossing on a grid point is that grid node") {
    const PlanarMap map = planarised(mapOf({{{0, 0, 4, 4}, 1}, {{0, 4, 4, 0}, 1}}));
    CHECK(map.nodes.size() == 5);
    for (const MapNode& node : map.nodes) CHECK(node.first < 0);
}

TEST_CASE("five lines through one point off the grid give one node of degree ten") {
    const std::vector<OracleSegment> segments = {{{0, 0, 3, 3}, 1},
                                                 {{0, 3, 3, 0}, 1},
                                                 {{1, -3, 2, 6}, 1},
                                                 {{-3, 1, 6, 2}, 1},
                                                 {{0, 2, 3, 1}, 1}};
    const PlanarMap map = planarised(mapOf(segments));
    CHECK(map.nodes.size() == 11);
    CHECK(map.edges.size() == 10);
    checkAgainstOracle(segments);
}

TEST_CASE("a line that ends on another splits it there") {
    const PlanarMap map = planarised(mapOf({{{0, 0, 4, 0}, 1}, {{2, 0, 2, 5}, 1}}));
    CHECK(map.nodes.size() == 4);
    CHECK(map.edges.size() == 3);
}

TEST_CASE("a line through the joint of two collinear ones meets them in their common end") {
    checkAgainstOracle(
        {{{0, 0, 2, 2}, 2}, {{2, 2, 4, 4}, 1}, {{0, 4, 4, 0}, 3}, {{2, 0, 2, 2}, 1}});
}

TEST_CASE("coordinates beyond eight are refused with their place") {
    FractureMap map;
    map.lines.push_back({{{0, 0}, {8.5, 0}}, 1, "a.svg: path #crack"});
    const Result<PlanarMap> result = planarise(map);
    REQUIRE_FALSE(result);
    CHECK(result.error().code == ErrorCode::limitExceeded);
    CHECK(result.error().where.find("a.svg: path #crack point 1") != std::string::npos);
}

TEST_CASE("coordinates that are no numbers are refused") {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        FractureMap map;
        map.lines.push_back({{{0, 0}, {0.5, bad}}, 1, "x"});
        const Result<PlanarMap> result = planarise(map);
        REQUIRE_FALSE(result);
        CHECK(result.error().code == ErrorCode::invalidData);
    }
}

TEST_CASE("lines from corner to corner of the whole range are decided exactly") {
    const int64_t far = kGridLimit;
    checkAgainstOracle({{{-far, -far, far, far}, 1},
                        {{-far, far, far, -far + 1}, 1},
                        {{-far, -far + 1, far, far - 1}, 2},
                        {{-far + 1, -far, far - 1, far}, 1}});
}

TEST_CASE("random lines with many coincidences match brute force over rationals") {
    for (int i = 0; i < test::propertyCases(2000); ++i) {
        const auto seed = static_cast<uint32_t>(9000 + i);
        CAPTURE(seed);
        test::Random random(seed);
        std::vector<OracleSegment> segments(1 + random.below(40));
        for (OracleSegment& s : segments) {
            for (int64_t& x : s.ends) x = int64_t{random.below(9)} << 20;
            s.level = 1 + random.below(3);
        }
        checkAgainstOracle(segments);
    }
}

TEST_CASE("random lines over the whole range and near misses match brute force") {
    for (int i = 0; i < test::propertyCases(300); ++i) {
        const auto seed = static_cast<uint32_t>(77000 + i);
        CAPTURE(seed);
        test::Random random(seed);
        std::vector<OracleSegment> segments(2 + random.below(14));
        for (OracleSegment& s : segments) {
            // Even cases: anywhere. Odd ones: nearly through the origin, a grid unit apart.
            for (int64_t& x : s.ends)
                x = static_cast<int64_t>(random.below(2U << 27U)) - (int64_t{1} << 27);
            if (i % 2 == 1) {
                s.ends[2] = -s.ends[0] + random.below(2);
                s.ends[3] = -s.ends[1] + random.below(2);
                for (int64_t& x : s.ends) x = std::clamp<int64_t>(x, -kGridLimit, kGridLimit);
            }
        }
        checkAgainstOracle(segments);
    }
}

TEST_CASE("the order in which lines are drawn does not change the planar map") {
    const uint32_t seed = 4711;
    CAPTURE(seed);
    test::Random random(seed);
    std::vector<OracleSegment> segments(200);
    for (OracleSegment& s : segments)
        for (int64_t& x : s.ends) x = int64_t{random.below(1U << 12U)} << 12;
    const PlanarMap once = planarised(mapOf(segments));
    for (size_t i = segments.size(); i > 1; --i)
        std::swap(segments[i - 1], segments[random.below(static_cast<uint32_t>(i))]);
    CHECK(sameMap(once, planarised(mapOf(segments))));
}

TEST_CASE("a hundred thousand short and long lines are planarised in near-linear time") {
    const int count = test::propertyCases(100000);
    test::Random random(3);
    FractureMap map;
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 at(random.unit(), random.unit());
        // One in two hundred runs right across; the rest are a few thousandths long.
        const double reach = i % 200 == 0 ? 1.0 : 0.003;
        map.lines.push_back(
            {{at, at + glm::dvec2(random.in(-reach, reach), random.in(-reach, reach))}, 1, ""});
    }
    const PlanarMap planar = planarised(map);
    CHECK(planar.edges.size() > static_cast<size_t>(count));
}

TEST_CASE("a hatching of long slanted parallels does not cost every pair") {
    const int count = test::propertyCases(100000);
    FractureMap map;
    for (int i = 0; i < count; ++i) {
        const double offset = i * (1.0 / 131072);
        map.lines.push_back({{{-4.0 + offset, -4.0}, {4.0 + offset, 3.0}}, 1, ""});
    }
    const PlanarMap planar = planarised(map);
    CHECK(planar.edges.size() == static_cast<size_t>(count));
}
