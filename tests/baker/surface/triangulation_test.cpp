// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <set>

#include "geometry/constrained_triangulation.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

constexpr int64_t kSide = 1 << 20;

uint32_t add(TriangulationInput& input, int64_t x, int64_t y, int64_t w = 1) {
    ExactPoint p;
    p.x = x;
    p.y = y;
    p.w = w;
    p.setApproximation();
    input.points.push_back(p);
    input.shape.emplace_back(p.ax, p.ay);
    return static_cast<uint32_t>(input.points.size()) - 1;
}

TriangulationInput corners() {
    TriangulationInput input;
    add(input, 0, 0);
    add(input, kSide, 0);
    add(input, 0, kSide);
    return input;
}

/// Every triangle counter-clockwise, areas adding up, every point used, every constraint an edge.
void check(const TriangulationInput& input, const TriangulationResult& result) {
    REQUIRE(result.valid);
    double area = 0;
    std::set<uint32_t> used;
    std::set<std::pair<uint32_t, uint32_t>> marked;
    for (const auto& t : result.triangles) {
        const ExactPoint& a = input.points[t.v[0]];
        const ExactPoint& b = input.points[t.v[1]];
        const ExactPoint& c = input.points[t.v[2]];
        CHECK(orientation(a, b, c, kSide) > 0);
        area += 0.5 * ((b.ax - a.ax) * (c.ay - a.ay) - (b.ay - a.ay) * (c.ax - a.ax));
        used.insert(t.v.begin(), t.v.end());
        for (size_t k = 0; k < 3; ++k) {
            if (t.mark[k] != 0) marked.insert(std::minmax(t.v[k], t.v[(k + 1) % 3]));
        }
    }
    CHECK(area == doctest::Approx(0.5 * kSide * kSide).epsilon(1e-9));
    CHECK(used.size() == input.points.size());
    for (const auto& c : input.constraints) CHECK(marked.contains(std::minmax(c.a, c.b)));
}

}  // namespace

TEST_CASE("three corners alone are one triangle") {
    const TriangulationInput input = corners();
    CHECK(triangulate(input).triangles.size() == 1);
}

TEST_CASE("points on the border and inside, constraints between them") {
    TriangulationInput input = corners();
    const uint32_t bottom = add(input, kSide / 3, 0);
    const uint32_t left = add(input, 0, kSide / 2);
    const uint32_t inner = add(input, kSide / 4, kSide / 4);
    input.constraints = {{bottom, inner, 1}, {inner, left, 2}};
    check(input, triangulate(input));
}

TEST_CASE("a point at a fraction that no double holds is on its edge exactly") {
    TriangulationInput input = corners();
    const uint32_t third = add(input, kSide, 0, 3);  // (kSide / 3, 0)
    const uint32_t hypotenuse = add(input, kSide, 2 * kSide, 3);
    input.constraints = {{third, hypotenuse, 1}};
    check(input, triangulate(input));
}

TEST_CASE("constraints that cross are refused, not obeyed halfway") {
    TriangulationInput input = corners();
    const uint32_t a = add(input, kSide / 2, 0);
    const uint32_t b = add(input, 0, kSide / 2);
    const uint32_t c = add(input, kSide / 2, kSide / 2);
    input.constraints = {{a, b, 1}, {0, c, 1}};
    CHECK_FALSE(triangulate(input).valid);
}

TEST_CASE("a constraint across hundreds of edges clears its way, marked edges inside it kept") {
    // Two rows of points that Delaunay joins crosswise, between them a long constraint; beside it a
    // short one that ends in the middle of the hole it makes.
    TriangulationInput input = corners();
    const uint32_t from = add(input, 1, kSide / 4);
    const uint32_t to = add(input, 3 * kSide / 4 - 1, kSide / 4);
    for (int64_t i = 1; i < 600; ++i) {
        const int64_t x = i * (3 * kSide / 4) / 600;
        add(input, x, kSide / 4 + (i * 7919 % 97 + 1) * 8);
        add(input, x, kSide / 4 - (i * 104729 % 89 + 1) * 8);
    }
    const auto first = static_cast<uint32_t>(input.points.size());
    add(input, kSide / 3, kSide / 4 + 4);
    add(input, kSide / 3 + 16, kSide / 4 + 1);
    input.constraints = {{first, first + 1, 2}, {from, to, 1}};
    check(input, triangulate(input));
}

TEST_CASE("thousands of parallel constraints from border to border triangulate") {
    const auto chords = [](int64_t n) {
        TriangulationInput input = corners();
        for (int64_t i = 1; i <= n; ++i) {
            const int64_t at = i * kSide / (n + 1);
            const uint32_t a = add(input, at, 0);
            const uint32_t b = add(input, at / 2, kSide - at / 2);
            input.points[a].lines = 1;
            input.points[b].lines = 2;
            input.constraints.push_back({a, b, 1});
        }
        check(input, triangulate(input));
    };
    for (const int64_t n : {1, 100, 8000}) chords(n);
}

TEST_CASE("random points with a random planar fan of constraints triangulate") {
    for (const uint32_t seed : propertySeeds(0, 600)) {
        CAPTURE(seed);
        Random random(seed);
        TriangulationInput input = corners();
        std::set<std::pair<int64_t, int64_t>> taken{{0, 0}, {kSide, 0}, {0, kSide}};
        const int64_t step = int64_t{1} << random.below(20);  // coarse grids make collinear points
        const uint32_t count = 1 + random.below(random.oneIn(8) ? 1000 : 40);
        for (uint32_t p = 0; p < count; ++p) {
            const int64_t x = random.below(kSide / step + 1) * step;
            const int64_t y = random.below(kSide / step + 1) * step;
            if (x + y > kSide || !taken.insert({x, y}).second) continue;
            add(input, x, y);
        }
        const auto n = static_cast<uint32_t>(input.points.size());
        if (n > 4) {
            // A fan from one point: such segments meet only there, or overlap, which is allowed.
            const uint32_t hub = random.below(n);
            for (uint32_t p = 0; p < n; p += 3) {
                if (p != hub) input.constraints.push_back({hub, p, 1});
            }
        }
        const TriangulationResult result = triangulate(input);
        input.constraints.clear();  // an overlapping one is several edges
        check(input, result);
    }
}
