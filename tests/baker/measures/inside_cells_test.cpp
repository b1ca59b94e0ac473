// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "geometry/inside_cells.h"
#include "interior/shapes.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Asks for points everywhere, on corners, edges and faces too.
void compare(const Shape& shape, Random& random) {
    const InsideTest test(shape.positions, shape.triangles);
    const InsideCells cells(test, shape.positions, shape.triangles);
    int inside = 0;
    for (int i = 0; i < 3000; ++i) {
        glm::dvec3 p(random.in(-3, 3), random.in(-3, 3), random.in(-3, 3));
        if (random.oneIn(3)) {
            const auto& t =
                shape.triangles[random.below(static_cast<uint32_t>(shape.triangles.size()))];
            const double x = random.oneIn(3) ? 0 : random.unit();
            const double y = random.oneIn(3) ? 0 : random.unit() * (1 - x);
            p = glm::dvec3(shape.positions[t[0]]) * (1 - x - y) +
                glm::dvec3(shape.positions[t[1]]) * x + glm::dvec3(shape.positions[t[2]]) * y;
        }
        const bool expected = test.inside(p);
        inside += expected ? 1 : 0;
        if (cells.inside(p) != expected) FAIL_CHECK("at " << p.x << " " << p.y << " " << p.z);
    }
    CHECK(inside > 0);
}

}  // namespace

TEST_CASE("cells give the inside test's answer for solids of every kind") {
    for (const uint32_t seed : propertySeeds(1, 5)) {
        CAPTURE(seed);
        Random random(seed);
        compare(box({-1, -1, -1}, {1, 2, 1}), random);
        compare(torusShape(2, 0.5F, 24, 12), random);
        compare(sphere({0, 0, 0}, {2, 1, 1}, 12), random);
        Shape overlapping = box({-2, -2, -2}, {1, 1, 1}, 3);
        overlapping.append(box({0, 0, 0}, {2, 2, 2}, 2));
        compare(overlapping, random);
        Shape hollow = sphere({0, 0, 0}, {2, 2, 2}, 8);
        Shape core = sphere({0, 0, 0}, {1, 1, 1}, 8);
        for (auto& t : core.triangles) std::swap(t[0], t[1]);
        hollow.append(core);
        compare(hollow, random);
    }
}

TEST_CASE("an open surface is asked point by point") {
    Random random(7);
    Shape open = box({-2, -2, -2}, {2, 2, 2}, 2);
    open.triangles.pop_back();
    compare(open, random);
}

TEST_CASE("one huge triangle among many small ones does not fill the grid") {
    Random random(3);
    Shape shape = sphere({0, 0, 0}, {1, 1, 1}, 20);
    shape.append(box({-1000, -1000, -1000}, {1000, 1000, -999}));
    const InsideTest test(shape.positions, shape.triangles);
    const InsideCells cells(test, shape.positions, shape.triangles);
    CHECK(cells.inside({0.1, 0.2, 0.3}));
    CHECK(cells.inside({500, 500, -999.5}));
    CHECK_FALSE(cells.inside({500, 500, 0}));
    CHECK_FALSE(cells.inside({5000, 0, 0}));
}

TEST_CASE("a flat or empty surface has no inside") {
    const Shape flat = box({0, 0, 0}, {1, 1, 0});
    const InsideTest test(flat.positions, flat.triangles);
    CHECK_FALSE(InsideCells(test, flat.positions, flat.triangles).inside({0.5, 0.5, 0.0}));
    const InsideTest none({}, {});
    CHECK_FALSE(InsideCells(none, {}, {}).inside({0, 0, 0}));
}
