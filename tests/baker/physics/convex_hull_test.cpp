// SPDX-License-Identifier: MIT
#include "physics/convex_hull.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "physics/polytope.h"
#include "shapes.h"
#include "support/property.h"

using namespace sherd;

namespace {

double support(const std::vector<glm::vec3>& points, const glm::dvec3& direction) {
    double most = -1e300;
    for (const glm::vec3& p : points) most = std::max(most, glm::dot(glm::dvec3(p), direction));
    return most;
}

std::vector<glm::dvec3> directions(int count) {
    test::Random random(3);
    std::vector<glm::dvec3> out;
    while (static_cast<int>(out.size()) < count) {
        const glm::dvec3 d(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
        const double length = glm::length(d);
        if (length > 0.1 && length < 1) out.push_back(d / length);
    }
    return out;
}

double sizeOf(const std::vector<glm::vec3>& points) {
    glm::vec3 low = points[0];
    glm::vec3 high = points[0];
    for (const glm::vec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

/// How far collider and margin stick out of the convex hull of the input, at most, in sizes.
double protrusion(const std::vector<glm::vec3>& input, const ColliderHull& hull) {
    double most = -1e300;
    for (const glm::dvec3& d : directions(2000)) {
        most = std::max(most, support(hull.points, d) + hull.margin - support(input, d));
    }
    // Random directions miss the faces' own, where it matters most.
    std::vector<glm::dvec3> unit;
    if (input.size() <= 16) {
        for (const glm::vec3& p : input) unit.push_back(glm::dvec3(p) / sizeOf(input));
        for (const HalfSpace& h : halfSpacesOf(hullOf(unit))) {
            most = std::max(
                most, support(hull.points, h.normal) + hull.margin - support(input, h.normal));
        }
    }
    return most / sizeOf(input);
}

/// Smallest width over many directions.
double thickness(const ColliderHull& hull) {
    double least = 1e300;
    for (const glm::dvec3& d : directions(2000)) {
        least = std::min(least, support(hull.points, d) + support(hull.points, -d));
    }
    return least;
}

void checkUsable(const ColliderHull& hull) {
    CHECK(hull.points.size() >= 4);
    for (const glm::vec3& p : hull.points) {
        CHECK(std::isfinite(p.x));
        CHECK(std::isfinite(p.y));
        CHECK(std::isfinite(p.z));
    }
    CHECK(hull.margin >= 0);
    CHECK(thickness(hull) > 0);
}

std::vector<glm::vec3> turned(std::vector<glm::vec3> points, const glm::vec3& offset) {
    const glm::quat q = glm::normalize(glm::quat(0.9F, 0.3F, -0.2F, 0.4F));
    for (glm::vec3& p : points) p = q * p + offset;
    return points;
}

}  // namespace

TEST_CASE("no point, one point and points at one place give a crumb") {
    checkUsable(colliderHull(std::vector<glm::vec3>{}, {}));
    const std::vector<glm::vec3> one = {{5, -3, 2}};
    checkUsable(colliderHull(one, {}));
    const std::vector<glm::vec3> same(100, glm::vec3(5, -3, 2));
    checkUsable(colliderHull(same, {16, 0.01F}));
    const float nan = std::nanf("");
    checkUsable(colliderHull(std::vector<glm::vec3>{{nan, 0, 0}, {1, 1, 1}}, {}));
}

TEST_CASE("points on a line or in a plane get a thickness") {
    std::vector<glm::vec3> line;
    std::vector<glm::vec3> plane;
    for (int i = 0; i < 100; ++i) {
        line.emplace_back(0.01F * i, 0.02F * i, -0.01F * i);
        plane.emplace_back(std::cos(0.0628F * i), std::sin(0.0628F * i), 0);
    }
    for (const auto& points : {line, plane, turned(plane, {3, 4, 5})}) {
        const ColliderHull hull = colliderHull(points, {});
        checkUsable(hull);
        CHECK(hull.points.size() <= 16);
        CHECK(protrusion(points, hull) < 1e-3);
        CHECK(sizeOf(hull.points) > 0.9 * sizeOf(points));
    }
}

TEST_CASE("a cube shrinks to a smaller cube, and margin makes up for it exactly") {
    const std::vector<glm::vec3> cube = test::box({-1, -1, -1}, {1, 1, 1}).positions;
    const ColliderHull hull = colliderHull(cube, {16, 0.1F});
    REQUIRE(hull.points.size() == 8);
    CHECK(hull.margin == 0.1F);
    for (const glm::vec3& p : hull.points) {
        for (int k = 0; k < 3; ++k) CHECK(std::abs(p[k]) == doctest::Approx(0.9));
    }
    CHECK(colliderHull(cube, {}).margin == doctest::Approx(0.02));
}

TEST_CASE("the margin is at most a tenth of the thinnest extent") {
    const std::vector<glm::vec3> slab = turned(test::box({0, 0, 0}, {2, 1, 0.01F}).positions, {});
    const ColliderHull hull = colliderHull(slab, {16, 0.04F});
    CHECK(hull.margin == doctest::Approx(0.001).epsilon(1e-3));
    CHECK(protrusion(slab, hull) < 1e-6);
    CHECK(sizeOf(hull.points) > 0.99 * sizeOf(slab));
    CHECK(colliderHull(slab, {16, 0}).margin == 0);
}

TEST_CASE("a sphere is covered as well as its vertex limit allows") {
    const std::vector<glm::vec3> points = test::sphere(32, {1, 2, 3}, 0.5F).positions;
    for (const uint32_t limit : {8U, 12U, 16U, 32U}) {
        const ColliderHull hull = colliderHull(points, {limit, HullOptions::kAutomatic});
        CHECK(hull.points.size() == limit);
        CHECK(protrusion(points, hull) < 1e-5);
    }
    const ColliderHull hull = colliderHull(points, {16, 0});
    double least = 1;
    for (const glm::dvec3& d : directions(2000)) {
        least = std::min(least, support(hull.points, d) - glm::dot(d, glm::dvec3(1, 2, 3)));
    }
    CHECK(least > 0.3);
}

TEST_CASE("a concave piece gets the hull around it, points inside do not matter") {
    std::vector<glm::vec3> l = test::box({0, 0, 0}, {2, 1, 1}).positions;
    for (const glm::vec3& p : test::box({0, 0, 0}, {1, 2, 1}).positions) l.push_back(p);
    const size_t own = l.size();
    for (int i = 0; i < 500; ++i) l.emplace_back(0.5F + 1e-4F * i, 0.5F, 0.5F);
    const ColliderHull hull = colliderHull(l, {16, 0});
    l.resize(own);
    for (const glm::dvec3& d : directions(500)) {
        CHECK(support(hull.points, d) == doctest::Approx(support(l, d)).epsilon(1e-6));
    }
}

TEST_CASE("collider and margin never leave the hull, whatever the shape and margin") {
    test::Random random(11);
    for (int i = 0; i < test::propertyCases(60); ++i) {
        std::vector<glm::vec3> points;
        const uint32_t count = 4 + random.below(i % 2 == 0 ? 12 : 300);
        const glm::vec3 stretch(1, random.in(0.01, 1), random.in(0.001, 1));
        for (uint32_t k = 0; k < count; ++k) {
            points.push_back(stretch *
                             glm::vec3(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)));
        }
        points = turned(points, glm::vec3(0.5F));
        const auto margin = static_cast<float>(random.in(0, 0.1));
        const ColliderHull hull = colliderHull(points, {16, margin});
        CAPTURE(i);
        checkUsable(hull);
        CHECK(protrusion(points, hull) < 1e-5);
    }
}

TEST_CASE("points in planes but for rounding are chosen from as well as others") {
    // Visibility in doubles made faces multiply with every corner until memory ran out.
    std::vector<glm::dvec3> points;
    test::Random random(5);
    const glm::dquat turn = glm::normalize(glm::dquat(0.9, 0.3, -0.2, 0.4));
    for (int i = 0; i < 3000; ++i) {
        const double angle = random.in(0, 6.283185307);
        const double height = i % 3 == 0 ? 0 : (i % 3 == 1 ? 0.25 : random.in(0, 0.25));
        points.push_back(turn * glm::dvec3(std::cos(angle), std::sin(angle), height));
    }
    const ColliderHull hull = colliderHull(points, {255, 0});
    CHECK(hull.points.size() > 100);
    CHECK(hull.points.size() <= 255);
}

TEST_CASE("the same shape at any scale gives the same collider, scaled") {
    const std::vector<glm::vec3> points =
        turned(test::box({0, 0, 0}, {1, 0.5F, 0.25F}).positions, {});
    const ColliderHull unit = colliderHull(points, {});
    for (const float scale : {0x1p-20F, 0x1p-10F, 0x1p10F, 0x1p20F}) {
        std::vector<glm::vec3> scaled = points;
        for (glm::vec3& p : scaled) p *= scale;
        const ColliderHull hull = colliderHull(scaled, {});
        CHECK(hull.margin == unit.margin * scale);
        REQUIRE(hull.points.size() == unit.points.size());
        for (size_t i = 0; i < hull.points.size(); ++i) {
            CHECK(hull.points[i] == unit.points[i] * scale);
        }
    }
}
