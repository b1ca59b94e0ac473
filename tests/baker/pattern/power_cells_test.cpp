// SPDX-License-Identifier: MIT
#include "pattern/power_cells.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "pattern/site_grid.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Rational = boost::multiprecision::cpp_rational;
using Weights = std::array<Rational, 3>;
using Corners = std::array<SitePoint, 3>;

struct Cells {
    std::vector<CornerValues> values;
    std::vector<PowerCell> cells;
};

Cells cellsOf(const Corners& corners, const std::vector<SitePoint>& sites) {
    Cells result;
    for (const SitePoint& s : sites) {
        result.values.push_back({squaredDistance(corners[0], s), squaredDistance(corners[1], s),
                                 squaredDistance(corners[2], s)});
    }
    for (uint32_t i = 0; i < sites.size(); ++i) {
        PowerCell cell(i);
        for (uint32_t j = 0; j < sites.size() && !cell.empty(); ++j)
            if (j != i) cell.clip(result.values, j);
        result.cells.push_back(cell);
    }
    return result;
}

/// The exact place of corner n of a cell.
Weights placeOf(const Cells& all, const PowerCell& cell, size_t n) {
    const CellSide a = cell.sides()[n];
    const CellSide b = cell.sides()[(n + 1) % cell.sides().size()];
    const auto row = [&](uint32_t other) {
        Weights r;
        for (size_t k = 0; k < 3; ++k)
            r[k] = Rational(all.values[cell.site()][k]) - Rational(all.values[other][k]);
        return r;
    };
    // Two linear equations and the sum of weights: by Cramer's rule.
    const auto side = [&](const CellSide& s) {
        if (!s.edge) return row(s.index);
        Weights r{0, 0, 0};
        r[(s.index + 2) % 3] = 1;
        return r;
    };
    const Weights x = side(a);
    const Weights y = side(b);
    Weights w{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
    const Rational sum = w[0] + w[1] + w[2];
    REQUIRE(sum != 0);
    for (Rational& c : w) c /= sum;
    return w;
}

Rational valueAt(const Cells& all, uint32_t site, const Weights& w) {
    Rational sum = 0;
    for (size_t k = 0; k < 3; ++k) sum += w[k] * Rational(all.values[site][k]);
    return sum;
}

/// Cells cover the triangle once, agree on their borders, and hold what is nearest to their site.
void checkPartition(const Corners& corners, const std::vector<SitePoint>& sites) {
    const Cells all = cellsOf(corners, sites);
    const std::array<bool, 3> forward{true, false, true};
    Rational total = 0;
    for (const PowerCell& cell : all.cells) {
        const size_t n = cell.sides().size();
        if (n == 0) continue;
        REQUIRE(n >= 3);
        std::vector<Weights> places;
        for (size_t k = 0; k < n; ++k) places.push_back(placeOf(all, cell, k));
        Weights middle{0, 0, 0};
        Rational area = 0;
        for (size_t k = 0; k < n; ++k) {
            const Weights& p = places[k];
            const Weights& q = places[(k + 1) % n];
            area += p[1] * q[2] - p[2] * q[1];
            for (size_t c = 0; c < 3; ++c) {
                REQUIRE(p[c] >= 0);
                middle[c] += p[c] / static_cast<int>(n);
            }
        }
        REQUIRE(area >= 0);
        total += area;
        const Rational own = valueAt(all, cell.site(), middle);
        for (uint32_t other = 0; other < sites.size(); ++other) {
            if (other == cell.site()) continue;
            const Rational there = valueAt(all, other, middle);
            REQUIRE(own <= there);
            if (area > 0 && own == there) REQUIRE(cell.site() < other);
        }
        for (size_t k = 0; k < n; ++k) {
            const CellSide side = cell.sides()[k];
            if (side.edge) continue;
            const PowerCell& neighbour = all.cells[side.index];
            const size_t m = neighbour.sides().size();
            size_t found = m;
            for (size_t j = 0; j < m; ++j) {
                const CellSide& s = neighbour.sides()[j];
                if (s.edge || s.index != cell.site()) continue;
                REQUIRE(found == m);
                found = j;
            }
            REQUIRE(found < m);
            // The neighbour runs along it the other way.
            const size_t before = (k + n - 1) % n;
            const size_t beforeThere = (found + m - 1) % m;
            REQUIRE(places[before] == placeOf(all, neighbour, found));
            REQUIRE(places[k] == placeOf(all, neighbour, beforeThere));
            REQUIRE(cell.corner(all.values, before, forward) ==
                    neighbour.corner(all.values, found, forward));
            REQUIRE(cell.corner(all.values, k, forward) ==
                    neighbour.corner(all.values, beforeThere, forward));
        }
    }
    REQUIRE(total == 1);
}

const Corners kTriangle{SitePoint{0, 0, 0}, SitePoint{16, 0, 0}, SitePoint{0, 16, 0}};

std::vector<uint32_t> nearestByBruteForce(const std::vector<SitePoint>& sites,
                                          const SitePoint& point, size_t count, uint32_t except) {
    std::vector<std::pair<int64_t, uint32_t>> all;
    for (uint32_t i = 0; i < sites.size(); ++i)
        if (i != except) all.emplace_back(squaredDistance(sites[i], point), i);
    std::sort(all.begin(), all.end());
    all.resize(std::min(all.size(), count));
    std::vector<uint32_t> result;
    for (const auto& item : all) result.push_back(item.second);
    return result;
}

}  // namespace

TEST_CASE("one site has the whole triangle") {
    checkPartition(kTriangle, {{3, 4, 5}});
    CHECK(cellsOf(kTriangle, {{3, 4, 5}}).cells[0].sides().size() == 3);
}

TEST_CASE("where all sites are equally near everywhere the first has all") {
    const Cells above = cellsOf(kTriangle, {{3, 4, 0}, {3, 4, 0}, {3, 4, 0}});
    CHECK(above.cells[0].sides().size() == 3);
    CHECK(above.cells[1].empty());
    CHECK(above.cells[2].empty());
    const Corners raised{SitePoint{0, 0, 8}, SitePoint{16, 0, 8}, SitePoint{0, 16, 8}};
    const Cells mirrored = cellsOf(raised, {{3, 4, 16}, {3, 4, 0}});  // mirrored in its plane
    CHECK(mirrored.cells[0].sides().size() == 3);
    CHECK(mirrored.cells[1].empty());
}

TEST_CASE("degenerate sites partition a triangle: on corners, edges, lines, circles") {
    checkPartition(kTriangle, {{0, 0, 0}, {16, 0, 0}, {0, 16, 0}});
    checkPartition(kTriangle, {{0, 16, 0}, {0, 0, 0}, {16, 0, 0}, {8, 8, 0}});
    // The bisector runs through a corner, along an edge, or meets a corner from outside.
    checkPartition(kTriangle, {{4, 8, 0}, {8, 4, 0}});
    checkPartition(kTriangle, {{4, 4, 0}, {4, -0, 8}, {4, 4, 8}});
    checkPartition(kTriangle, {{8, 4, 0}, {24, 4, 0}});
    checkPartition(kTriangle, {{24, 4, 0}, {8, 4, 0}});
    checkPartition(kTriangle, {{8, 8, 4}, {8, 8, 12}});
    // Collinear and evenly spaced; a grid, every four of which lie on a circle.
    std::vector<SitePoint> line, grid;
    for (int64_t i = 0; i < 9; ++i) line.push_back({2 * i, 2 * i, 0});
    for (int64_t i = 0; i < 25; ++i) grid.push_back({4 * (i % 5), 4 * (i / 5), 0});
    checkPartition(kTriangle, line);
    checkPartition(kTriangle, grid);
    std::reverse(grid.begin(), grid.end());
    checkPartition(kTriangle, grid);
    // Twelve points on one sphere around a corner and around an inner point.
    for (const SitePoint& c : {SitePoint{0, 0, 0}, SitePoint{4, 4, 0}}) {
        std::vector<SitePoint> round;
        for (const int64_t a : {-3, 3})
            for (const int64_t b : {-4, 4}) {
                round.push_back({c.x + a, c.y + b, c.z});
                round.push_back({c.x + b, c.y, c.z + a});
                round.push_back({c.x, c.y + a, c.z + b});
            }
        checkPartition(kTriangle, round);
    }
}

TEST_CASE("a triangle without area is partitioned along its length") {
    const Corners needle{SitePoint{0, 0, 0}, SitePoint{16, 0, 0}, SitePoint{8, 0, 0}};
    checkPartition(needle, {{0, 0, 0}, {16, 0, 0}, {8, 8, 0}});
    const Corners point{SitePoint{1, 1, 1}, SitePoint{1, 1, 1}, SitePoint{1, 1, 1}};
    checkPartition(point, {{0, 1, 1}, {2, 1, 1}, {1, 1, 1}});
}

TEST_CASE("random cells of small and of largest coordinates partition their triangle") {
    const int cases = propertyCases(500);
    for (int i = 0; i < cases; ++i) {
        const auto seed = static_cast<uint32_t>(300 + i);
        CAPTURE(seed);
        Random random(seed);
        // Few values make many ties; the largest need more than 128 bits.
        const bool large = random.below(3) == 0;
        const uint32_t width = large ? (1U << 26) + 1 : 2 + random.below(6);
        const auto coordinate = [&]() -> int64_t { return random.below(width); };
        const auto point = [&] { return SitePoint{coordinate(), coordinate(), coordinate()}; };
        const Corners corners{point(), point(), point()};
        std::vector<SitePoint> sites;
        for (uint32_t n = 1 + random.below(9); n > 0; --n) {
            const SitePoint s = random.below(5) == 0 ? corners[random.below(3)] : point();
            if (std::find(sites.begin(), sites.end(), s) == sites.end()) sites.push_back(s);
        }
        checkPartition(corners, sites);
    }
}

TEST_CASE("the tree finds the nearest sites as brute force does, ties to the lower index") {
    const int cases = propertyCases(300);
    for (int i = 0; i < cases; ++i) {
        const auto seed = static_cast<uint32_t>(500 + i);
        CAPTURE(seed);
        Random random(seed);
        const uint32_t width = random.below(2) == 0 ? 2 + random.below(5) : (1U << 26) + 1;
        const bool flat = random.below(3) == 0;
        const auto point = [&] {
            return SitePoint{random.below(width), random.below(width),
                             flat ? 1 : random.below(width)};
        };
        std::vector<SitePoint> sites;
        for (uint32_t n = 1 + random.below(120); n > 0; --n) sites.push_back(point());
        const SiteTree tree(sites);
        for (int k = 0; k < 20; ++k) {
            const SitePoint p = point();
            REQUIRE(tree.nearest(p) == nearestByBruteForce(sites, p, 1, ~0U)[0]);
            const uint32_t site = random.below(static_cast<uint32_t>(sites.size()));
            const size_t count = random.below(130);
            REQUIRE(tree.nearestTo(site, count) ==
                    nearestByBruteForce(sites, sites[site], count, site));
        }
    }
}

TEST_CASE("a tree of one site or none answers") {
    CHECK(SiteTree(std::vector<SitePoint>{{5, 5, 5}}).nearest({0, 0, 0}) == 0);
    CHECK(SiteTree(std::vector<SitePoint>{{5, 5, 5}}).nearestTo(0, 3).empty());
    CHECK(SiteTree(std::vector<SitePoint>{}).nearest({0, 0, 0}) == 0);
}

TEST_CASE("grids of sites are the same at twice the size, and never leave their range") {
    Random random(9);
    for (int i = 0; i < 50; ++i) {
        std::vector<glm::vec3> positions, twice;
        for (int k = 0; k < 20; ++k) {
            const glm::vec3 p(random.in(-1, 1), random.in(-9, 9), random.in(0, 1e-3));
            positions.push_back(p);
            twice.push_back(p * 1024.0F);
        }
        const glm::dvec3 axis = i % 2 == 0 ? glm::dvec3(0.0) : glm::dvec3(0.6, 0.8, 0);
        const SiteGrid one(positions, axis, 6);
        const SiteGrid two(twice, axis, 6);
        for (size_t k = 0; k < positions.size(); ++k) {
            const SitePoint p = one.snap(positions[k]);
            REQUIRE(p == two.snap(twice[k]));
            for (const int64_t x : {p.x, p.y, p.z}) REQUIRE((x >= 0 && x <= int64_t{1} << 26));
        }
        const SitePoint far = one.snap(glm::dvec3(1e30, -1e30, 0));
        CHECK((far.x >= 0 && far.x <= int64_t{1} << 26));
    }
    CHECK(SiteGrid(std::vector<glm::vec3>{}, glm::dvec3(0.0), 1).snap(glm::dvec3(0.0)).x == 0);
    const std::vector<glm::vec3> single{glm::vec3(3.0F)};
    CHECK(SiteGrid(single, glm::dvec3(0.0), 1).snap(glm::dvec3(3.0)).x == 0);
}
