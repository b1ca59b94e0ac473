// SPDX-License-Identifier: MIT
#include "solid/polygon_filling.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

const auto kAll = [](uint32_t, uint32_t) { return true; };

std::vector<PolygonCorner> cornersOf(const std::vector<glm::dvec3>& positions) {
    std::vector<PolygonCorner> corners;
    corners.reserve(positions.size());
    for (const glm::dvec3& p : positions) corners.push_back({p, glm::dvec3(0.0), 0});
    return corners;
}

/// Twice the sum of the triangles' areas along z, and without signs.
std::pair<double, double> areasOf(const std::vector<PolygonCorner>& corners,
                                  const Triangles& fill) {
    double along = 0;
    double sum = 0;
    for (const auto& t : fill) {
        const glm::dvec3 a = corners[t[0]].position;
        const glm::dvec3 n = glm::cross(corners[t[1]].position - a, corners[t[2]].position - a);
        along += n.z;
        sum += glm::length(n);
    }
    return {along, sum};
}

}  // namespace

TEST_CASE("fewer than three corners need no triangle") {
    CHECK(fillPolygon({}, FillingStyle::even, kAll)->empty());
    CHECK(fillPolygon(cornersOf({{0, 0, 0}}), FillingStyle::even, kAll)->empty());
    CHECK(fillPolygon(cornersOf({{0, 0, 0}, {1, 0, 0}}), FillingStyle::even, kAll)->empty());
}

TEST_CASE("a flat quad gets the shorter of its diagonals, the longer if that is not allowed") {
    const auto corners = cornersOf({{0, 0, 0}, {2, -1, 0}, {4, 0, 0}, {2, 1, 0}});
    const auto uses = [](const Triangles& fill, uint32_t a, uint32_t b) {
        return std::all_of(fill.begin(), fill.end(), [&](const auto& t) {
            return std::count(t.begin(), t.end(), a) + std::count(t.begin(), t.end(), b) == 2;
        });
    };
    CHECK(uses(*fillPolygon(corners, FillingStyle::even, kAll), 1, 3));
    const auto longer = fillPolygon(corners, FillingStyle::even,
                                    [](uint32_t i, uint32_t j) { return i != 1 || j != 3; });
    CHECK(uses(*longer, 0, 2));
    CHECK_FALSE(fillPolygon(corners, FillingStyle::even, [](uint32_t, uint32_t) { return false; }));
}

TEST_CASE("a flat star is covered once, however jagged") {
    const uint64_t seed = 7;
    INFO("seed " << seed);
    Random random(seed);
    for (const int count : {5, 12, 60, 200}) {
        CAPTURE(count);
        std::vector<glm::dvec3> star;  // corners at growing angles: simple, hardly ever convex
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * M_PI * i / count;
            const double radius = 1 + 0.8 * random.unit();
            star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        }
        const auto corners = cornersOf(star);
        const auto fill = fillPolygon(corners, FillingStyle::even, kAll);
        REQUIRE(fill);
        CHECK(fill->size() == static_cast<size_t>(count) - 2);
        double wanted = 0;
        for (size_t i = 0; i < star.size(); ++i) {
            const glm::dvec3& a = star[i];
            const glm::dvec3& b = star[(i + 1) % star.size()];
            wanted += a.x * b.y - a.y * b.x;
        }
        const auto [along, sum] = areasOf(corners, *fill);
        CHECK(along == doctest::Approx(wanted));
        CHECK(sum == doctest::Approx(wanted));
    }
}

TEST_CASE("between two jagged lines every triangle leads from one to the other") {
    const uint64_t seed = 3;
    INFO("seed " << seed);
    Random random(seed);
    std::vector<PolygonCorner> corners;
    constexpr int kSteps = 150;
    for (const bool back : {false, true}) {
        for (int i = 0; i <= kSteps; ++i) {
            const double x = back ? kSteps - i : i;
            corners.push_back({{x, random.unit() * 3, back ? -20.0 : 0.0},
                               {0, 0, back ? 1.0 : -1.0},
                               back ? 1U : 0U});
        }
    }
    const auto fill = fillPolygon(corners, FillingStyle::ruled, kAll);
    REQUIRE(fill);
    for (const auto& t : *fill) {
        const auto onFront =
            std::count_if(t.begin(), t.end(), [&](uint32_t c) { return corners[c].side == 0; });
        CHECK((onFront == 1 || onFront == 2));
    }
}
