// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "sherd/formats/hull_measures.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

std::vector<glm::dvec3> cubeAt(const glm::dvec3& low) {
    std::vector<glm::dvec3> out;
    out.reserve(8);
    for (int i = 0; i < 8; ++i) out.push_back(low + glm::dvec3(i & 1, i >> 1 & 1, i >> 2 & 1));
    return out;
}

/// By many directions: no less than the distance that parts them, and nearly it.
double depthByDirections(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    Random random(7);
    double least = 1e300;
    for (int i = 0; i < 20000; ++i) {
        glm::dvec3 d(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
        if (glm::length(d) < 0.1) continue;
        d = glm::normalize(d);
        double high = -1e300, low = 1e300;
        for (const glm::dvec3& p : a) high = std::max(high, glm::dot(p, d));
        for (const glm::dvec3& p : b) low = std::min(low, glm::dot(p, d));
        least = std::min(least, high - low);
    }
    return least;
}

}  // namespace

TEST_CASE("cubes apart, touching, inside each other and in one place have the distance they have") {
    const auto cube = cubeAt({0, 0, 0});
    CHECK(hullDistance(cube, cubeAt({1.5, 0.25, 0})) == doctest::Approx(0.5));
    CHECK(hullDistance(cube, cubeAt({2, 2, 1})) == doctest::Approx(std::sqrt(2.0)));
    CHECK(std::abs(hullDistance(cube, cubeAt({1, 0, 0}))) < 1e-9);
    CHECK(std::abs(hullDistance(cube, cubeAt({1, 1, 1}))) < 1e-9);
    CHECK(hullDistance(cube, cubeAt({0.75, 0, 0})) == doctest::Approx(-0.25));
    CHECK(hullDistance(cube, cubeAt({0.5, 0.875, 0.25})) == doctest::Approx(-0.125));
    CHECK(hullDistance(cube, cube) == doctest::Approx(-1));
    CHECK(hullGap(cube, cube) == 0);
    CHECK(hullGap(cube, cubeAt({1.5, 0.25, 0})) == doctest::Approx(0.5));
}

TEST_CASE("points and flat sets are measured, too") {
    const auto cube = cubeAt({0, 0, 0});
    const std::vector<glm::dvec3> inside = {{0.5, 0.5, 0.25}};
    const std::vector<glm::dvec3> outside = {{0.5, 0.5, 3}};
    const std::vector<glm::dvec3> square = {{0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 0.5}, {1, 1, 0.5}};
    CHECK(hullDistance(inside, cube) == doctest::Approx(-0.25));
    CHECK(hullDistance(outside, cube) == doctest::Approx(2));
    CHECK(hullDistance(inside, inside) == 0);
    CHECK(hullDistance(square, cube) == doctest::Approx(-0.5));
    CHECK(hullDistance(outside, square) == doctest::Approx(2.5));
}

TEST_CASE("distance and depth agree with what any direction says, aligned or not") {
    for (const uint32_t seed : propertySeeds(1, 60)) {
        CAPTURE(seed);
        Random random(seed);
        const bool aligned = random.oneIn(2);
        const auto cloud = [&](double away) {
            std::vector<glm::dvec3> out;
            for (uint32_t i = 4 + random.below(40); i > 0; --i) {
                glm::dvec3 p(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
                if (aligned) p = glm::floor(4.0 * p) / 4.0;
                out.push_back(p + glm::dvec3(away, 0, 0));
            }
            return out;
        };
        const auto a = cloud(0), b = cloud(random.in(0, 3));
        const double distance = hullDistance(a, b);
        const double depth = depthByDirections(a, b);
        CHECK(-distance <= depth + 1e-9);
        CHECK(-distance > depth - 0.05);
        CHECK(hullDistance(b, a) == doctest::Approx(distance).epsilon(1e-7));
        CHECK(hullGap(a, b) == doctest::Approx(std::max(distance, 0.0)).epsilon(1e-7));
    }
}
