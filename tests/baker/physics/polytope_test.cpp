// SPDX-License-Identifier: MIT
#include "physics/polytope.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "geometry/predicates.h"
#include "physics/collider_separation.h"
#include "physics/solid_chain.h"
#include "shapes.h"
#include "support/property.h"
#include "support/random_solids.h"

using namespace sherd;

namespace {

std::vector<glm::dvec3> inDouble(const std::vector<glm::vec3>& points) {
    return {points.begin(), points.end()};
}

/// Every edge once in either direction, and no corner above any face, exactly.
void checkConvexAndClosed(const Polytope& hull) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (const auto& f : hull.faces)
        for (size_t k = 0; k < 3; ++k) ++edges[{f[k], f[(k + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
        CHECK(count == 1);
        CHECK(edges.count({edge.second, edge.first}) == 1);
    }
    CHECK(hull.faces.size() == 2 * hull.points.size() - 4);
    int above = 0;
    for (const auto& f : hull.faces)
        for (const glm::dvec3& p : hull.points)
            above += orient3d(hull.points[f[0]], hull.points[f[1]], hull.points[f[2]], p) > 0;
    CHECK(above == 0);
}

double mostAbove(const Polytope& hull, const std::vector<glm::dvec3>& points) {
    double most = 0;
    for (const HalfSpace& h : halfSpacesOf(hull))
        most = std::max(most, reachOf(points, h.normal).high - h.offset);
    return most;
}

glm::dvec3 direction(test::Random& random) {
    for (;;) {
        const glm::dvec3 d(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
        if (glm::length(d) > 0.1) return glm::normalize(d);
    }
}

SolidChain chainOf(const test::Solid& solid) {
    return {inDouble(solid.positions), solid.triangles};
}

}  // namespace

TEST_CASE("no points, one, two, points on a line and in a plane have no hull") {
    CHECK(hullOf({}).empty());
    for (const int count : {1, 2, 3, 50}) {
        std::vector<glm::dvec3> line, plane;
        for (int i = 0; i < count; ++i) {
            line.emplace_back(0.25 * i, 0.5 * i, -i);
            const int row = i / 7;
            plane.emplace_back(i % 7, row, 2 * (i % 7) - 3.0 * row);
        }
        CHECK(hullOf(line).empty());
        CHECK(hullOf(plane).empty());
        CHECK(hullOf(std::vector<glm::dvec3>(static_cast<size_t>(count), glm::dvec3(1, 2, 3)))
                  .empty());
    }
}

TEST_CASE("four points are their own hull") {
    const Polytope hull = hullOf(inDouble(test::tetrahedron().positions));
    checkConvexAndClosed(hull);
    CHECK(volumeOf(hull) == doctest::Approx(1.0 / 6));
}

TEST_CASE("a lattice in a cube, each point twice, has the cube for a hull") {
    std::vector<glm::dvec3> lattice;
    lattice.reserve(250);
    for (int i = 0; i < 2 * 5 * 5 * 5; ++i) lattice.emplace_back(i % 5, i / 5 % 5, i / 25 % 5);
    const Polytope hull = hullOf(lattice);
    CHECK(hull.points.size() == 8);
    checkConvexAndClosed(hull);
    CHECK(volumeOf(hull) == 64);
    CHECK(halfSpacesOf(hull).size() == 6);
}

TEST_CASE("a hull is closed, convex to the bit, and holds all points but for its skin") {
    for (const uint32_t seed : test::propertySeeds(1, 60)) {
        CAPTURE(seed);
        test::Random random(seed);
        std::vector<glm::dvec3> points;
        const bool aligned = random.oneIn(2);
        const glm::dvec3 stretch(1, random.in(0.01, 1), random.in(1e-4, 1));
        for (uint32_t i = 4 + random.below(400); i > 0; --i) {
            glm::dvec3 p(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
            if (aligned) p = glm::floor(4.0 * p) / 4.0;
            points.push_back(stretch * p);
        }
        for (const double skin : {kRoundingSkin, 2e-3}) {
            const Polytope hull = hullOf(points, skin);
            if (hull.empty()) continue;
            checkConvexAndClosed(hull);
            // The diagonal is at most 4, and the skin a goal, not a bound.
            CHECK(mostAbove(hull, points) < 2 * 4 * skin);
        }
    }
}

TEST_CASE("a rounded box is the box, slabs on its faces, quarters of rods and a ball") {
    const double a = 2, b = 3, c = 5, r = 0.25;
    std::vector<glm::dvec3> corners;
    corners.reserve(8);
    for (int k = 0; k < 8; ++k) corners.emplace_back((k & 1) * a, (k >> 1 & 1) * b, (k >> 2) * c);
    const Polytope box = hullOf(corners);
    const double pi = std::numbers::pi;
    CHECK(roundedVolume(box, 0) == doctest::Approx(a * b * c));
    CHECK(roundedVolume(box, r) ==
          doctest::Approx(a * b * c + 2 * (a * b + b * c + c * a) * r + pi * (a + b + c) * r * r +
                          4 * pi / 3 * r * r * r));
}

TEST_CASE("what a wall cuts off and what it leaves make up the whole") {
    for (const uint32_t seed : test::propertySeeds(100, 60)) {
        CAPTURE(seed);
        test::Random random(seed);
        const Polytope hull = hullOf(inDouble(test::sphere(3 + random.below(6), {}, 1).positions));
        const HalfSpace wall{direction(random), random.in(-0.9, 0.9)};
        const Polytope left = clipped(hull, wall);
        if (left.empty()) continue;
        checkConvexAndClosed(left);
        CHECK(reachOf(left.points, wall.normal).high < wall.offset + 1e-12);
        CHECK(volumeOf(left) + volumeBeyond(hull, wall) == doctest::Approx(volumeOf(hull)));
    }
    const Polytope cube = hullOf(inDouble(test::box({0, 0, 0}, {1, 1, 1}).positions));
    CHECK(volumeBeyond(cube, {{1, 0, 0}, 0}) == 1);
    CHECK(volumeBeyond(cube, {{1, 0, 0}, 1}) == 0);
    CHECK(clipped(cube, {{1, 0, 0}, 0}).empty());
    CHECK(volumeOf(clipped(cube, {{1, 0, 0}, 1})) == 1);
}

TEST_CASE("the parts of a cut solid have its volume together, however planes meet its faces") {
    for (const uint32_t seed : test::propertySeeds(200, 60)) {
        CAPTURE(seed);
        test::Random random(seed);
        const SolidChain whole = chainOf(test::randomSolid(random));
        std::vector<SolidChain> parts = {whole};
        for (int cut = 0; cut < 4; ++cut) {
            HalfSpace wall{direction(random), random.in(-1, 1)};
            // Through faces and vertices of aligned solids.
            if (random.oneIn(2)) wall = {{0, 1, 0}, 0.25 * random.below(8)};
            std::vector<SolidChain> next;
            for (const SolidChain& part : parts) {
                const auto [below, beyond] = part.split(wall);
                const auto [pointsBelow, pointsBeyond] = part.splitPoints(wall);
                CHECK(reachOf(below.skinPoints(), wall.normal).high < wall.offset + 1e-9);
                CHECK(reachOf(beyond.skinPoints(), wall.normal).low > wall.offset - 1e-9);
                const Polytope a = hullOf(pointsBelow), b = hullOf(below.skinPoints());
                CHECK(volumeOf(a) == doctest::Approx(volumeOf(b)).epsilon(1e-6));
                next.push_back(below);
                next.push_back(beyond);
            }
            parts = std::move(next);
        }
        double sum = 0;
        for (const SolidChain& part : parts) sum += part.volume();
        CHECK(sum == doctest::Approx(whole.volume()).epsilon(1e-9));
    }
}

TEST_CASE("bodies that touch or are apart are disjoint, others are not") {
    const auto cubeAt = [](const glm::vec3& low) {
        return hullOf(inDouble(test::box(low, low + 1.0F).positions));
    };
    const Polytope cube = cubeAt({0, 0, 0});
    CHECK(areDisjoint(cube, cubeAt({1.5F, 0, 0})));
    CHECK(areDisjoint(cube, cubeAt({1.5F, 1.5F, 0.25F})));
    CHECK_FALSE(areDisjoint(cube, cubeAt({0.9F, 0.9F, 0.9F})));
    CHECK_FALSE(areDisjoint(cube, cube));
    CHECK_FALSE(areDisjoint(cube, cubeAt({0.5F, 0, 0})));
    CHECK_FALSE(overlap(cube, cubeAt({1, 0, 0}), 1e-9));
    CHECK_FALSE(overlap(cube, cubeAt({1, 1, 1}), 1e-9));
    // Apart along a direction that is no face's normal: edge against edge.
    std::vector<glm::dvec3> roof = {{0, 0.9, -1}, {0, 0.9, 2},   {1, 1.9, -1},
                                    {1, 1.9, 2},  {-1, 1.9, -1}, {-1, 1.9, 2}};
    std::vector<glm::dvec3> ridge = {{-2, 0.8, 0.5}, {2, 0.8, 0.5},    {-2, -0.2, 1.5},
                                     {2, -0.2, 1.5}, {-2, -0.2, -0.5}, {2, -0.2, -0.5}};
    CHECK(areDisjoint(hullOf(roof), hullOf(ridge)));
    for (glm::dvec3& p : ridge) p.y += 0.2;
    CHECK_FALSE(areDisjoint(hullOf(roof), hullOf(ridge)));
}

TEST_CASE("a wall spares the solid of both bodies, and the air before that") {
    // a is full; b is empty but for its far end: b gives way.
    const Polytope a = hullOf(inDouble(test::box({0, 0, 0}, {1, 1, 1}).positions));
    const Polytope b = hullOf(inDouble(test::box({0.5F, 0, 0}, {3, 1, 1}).positions));
    std::vector<glm::dvec3> full, far;
    for (int i = 0; i < 8; ++i) {
        full.emplace_back(i / 8.0 + 0.05, 0.5, 0.5);
        far.emplace_back(2.5, 0.5, i / 8.0);
    }
    const auto wall = wallBetween({a, full, 1, 0}, {b, far, 1, 0}, 1e-6);
    REQUIRE(wall.has_value());
    CHECK(wall->normal.x == doctest::Approx(1));
    CHECK(wall->offset == doctest::Approx(1));
    CHECK_FALSE(wallBetween({a, full, 1, 0.99}, {a, full, 1, 0.99}, 1e-6).has_value());
    const auto halves = wallBetween({a, full, 1, 0.1}, {a, full, 1, 0.1}, 1e-6);
    REQUIRE(halves.has_value());
    CHECK(volumeOf(clipped(a, *halves)) > 0.1);
}
