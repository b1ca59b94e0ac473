// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/inside_test.h"
#include "geometry/predicates.h"
#include "geometry/triangle_bvh.h"
#include "interior/shapes.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

InsideTest insideOf(const Shape& shape) {
    return {shape.positions, shape.triangles};
}

/// The winding number as the sum of solid angles (van Oosterom and Strackee, 1983).
double solidAngleWinding(const Shape& shape, const glm::dvec3& q) {
    double sum = 0;
    for (const auto& t : shape.triangles) {
        const glm::dvec3 a = glm::dvec3(shape.positions[t[0]]) - q;
        const glm::dvec3 b = glm::dvec3(shape.positions[t[1]]) - q;
        const glm::dvec3 c = glm::dvec3(shape.positions[t[2]]) - q;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const double divisor =
            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), divisor);
    }
    return sum / (4 * std::numbers::pi);
}

}  // namespace

TEST_CASE("orient2d and orient3d see what a double determinant rounds away") {
    // Kettner et al.: points one unit in the last place apart around a line.
    const glm::dvec2 b(12, 12), c(24, 24);
    const double u = std::ldexp(1.0, -53);
    for (int i = 0; i < 32; ++i) {
        for (int j = 0; j < 32; ++j) {
            const int expected = i == j ? 0 : (i > j ? -1 : 1);
            CHECK(orient2d({0.5 + i * u, 0.5 + j * u}, b, c) ==
                  -orient2d(b, {0.5 + i * u, 0.5 + j * u}, c));
            CHECK(orient2d(b, c, {0.5 + i * u, 0.5 + j * u}) == expected);
        }
    }
    const glm::dvec3 p(0, 0, 0), q(12, 12, 1), r(24, 24, 3);
    CHECK(orient3d(p, q, r, {0.5, 0.5, 7}) == 0);
    CHECK(orient3d(p, q, r, {0.5 + u, 0.5, 7}) == -orient3d(p, q, r, {0.5, 0.5 + u, 7}));
    CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-60}) == 1);
    CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, -1e-60}) == -1);
    const double tiny = 1e-45F;  // the smallest float
    CHECK(orient3d({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}, {0, 0, tiny}) == 1);
}

TEST_CASE("an empty surface has no inside, and neither has one flat triangle") {
    CHECK_FALSE(insideOf({}).inside({0, 0, 0}));
    Shape flat;
    flat.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    flat.triangles = {{0, 1, 2}, {0, 0, 0}};
    CHECK_FALSE(insideOf(flat).inside({0.5, 0, 0}));
    CHECK_FALSE(insideOf(flat).inside({NAN, 0, 0}));
}

TEST_CASE("rays through the vertices, edges and diagonals of a gridded box count exactly") {
    const Shape shape = box({0, 0, 0}, {4, 4, 4}, 4);
    const InsideTest test = insideOf(shape);
    CHECK(test.closed());
    // Quarter steps put queries straight below vertices, edges, diagonals and faces.
    for (int x = -2; x <= 18; ++x) {
        for (int y = -2; y <= 18; ++y) {
            for (int z = -2; z <= 18; ++z) {
                const bool on = x == 0 || y == 0 || z == 0 || x == 16 || y == 16 || z == 16;
                const bool within = x > 0 && y > 0 && z > 0 && x < 16 && y < 16 && z < 16;
                const int winding = test.winding(glm::dvec3(x, y, z) / 4.0);
                if (within) CHECK(winding == 1);
                if (!within && !on) CHECK(winding == 0);
                CHECK((winding == 0 || winding == 1));
            }
        }
    }
}

TEST_CASE("a box is inside to the last bit on one side of its face and outside on the other") {
    const Shape shape = box({-1, -1, -1}, {1, 1, 1});
    const InsideTest test = insideOf(shape);
    const double in = std::nextafter(1.0, 0.0), out = std::nextafter(1.0, 2.0);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 q(0.0);
            q[axis] = side * in;
            CHECK(test.inside(q));
            q[axis] = side * out;
            CHECK_FALSE(test.inside(q));
        }
    }
}

TEST_CASE("overlapping boxes wind twice and are one solid; a turned inner box is a cavity") {
    Shape two = box({0, 0, 0}, {2, 2, 2});
    two.append(box({1, 1, 1}, {3, 3, 3}));
    CHECK(insideOf(two).winding({1.5, 1.5, 1.5}) == 2);
    CHECK(insideOf(two).inside({1.5, 1.5, 1.5}));
    CHECK(insideOf(two).winding({0.5, 0.5, 0.5}) == 1);
    CHECK_FALSE(insideOf(two).inside({2.5, 0.5, 0.5}));

    Shape nested = box({0, 0, 0}, {4, 4, 4});
    nested.append(box({1, 1, 1}, {3, 3, 3}));
    CHECK(insideOf(nested).winding({2, 2, 2}) == 2);

    Shape hollow = box({0, 0, 0}, {4, 4, 4});
    Shape inner = box({1, 1, 1}, {3, 3, 3});
    for (auto& t : inner.triangles) std::swap(t[1], t[2]);
    hollow.append(inner);
    CHECK(insideOf(hollow).winding({2, 2, 2}) == 0);
    CHECK(insideOf(hollow).winding({0.5, 2, 2}) == 1);
}

TEST_CASE("a box given as loose triangles is closed by its positions") {
    const Shape welded = box({0, 0, 0}, {1, 1, 1}, 2);
    Shape loose;
    for (const auto& t : welded.triangles) {
        const auto base = static_cast<uint32_t>(loose.positions.size());
        for (const uint32_t v : t) loose.positions.push_back(welded.positions[v]);
        loose.triangles.push_back({base, base + 1, base + 2});
    }
    loose.positions[0] *= -0.0F;  // a negative zero is the same place
    CHECK(insideOf(loose).closed());
    CHECK(insideOf(loose).inside({0.5, 0.5, 0.5}));
}

TEST_CASE("a box without lid still has an inside by the vote of six rays") {
    Shape open = box({0, 0, 0}, {1, 1, 1}, 3);
    std::erase_if(open.triangles, [&](const auto& t) {
        return open.positions[t[0]].z == 1 && open.positions[t[1]].z == 1 &&
               open.positions[t[2]].z == 1;
    });
    const InsideTest test = insideOf(open);
    CHECK_FALSE(test.closed());
    CHECK(test.inside({0.5, 0.5, 0.5}));
    CHECK(test.inside({0.1, 0.9, 0.1}));
    CHECK_FALSE(test.inside({0.5, 0.5, 1.5}));
    CHECK_FALSE(test.inside({1.5, 0.5, 0.5}));
}

TEST_CASE("winding numbers equal the sum of solid angles on random closed surfaces") {
    Random random(20240607);
    for (int round = 0; round < propertyCases(60); ++round) {
        Shape shape;
        const uint32_t parts = 1 + random.below(3);
        for (uint32_t part = 0; part < parts; ++part) {
            const auto at = [&] { return static_cast<float>(random.in(-1, 1)); };
            Shape s =
                round % 2 == 0 ? torusShape(1, 0.4F, 9, 7) : sphere({0, 0, 0}, {1, 0.6F, 0.8F}, 4);
            const glm::vec3 shift(at(), at(), at());
            // Noise folds the surface over itself: windings beyond 0 and 1, and negative ones.
            s.transform(
                [&](glm::vec3 p) { return p + shift + 0.25F * glm::vec3(at(), at(), at()); });
            shape.append(s);
        }
        // Every other surface lies on a coarse grid: many exact coincidences.
        if (round % 4 < 2) {
            shape.transform([](glm::vec3 p) { return glm::round(p * 4.0F) / 4.0F; });
        }
        const InsideTest test = insideOf(shape);
        CHECK(test.closed());
        const TriangleBvh bvh(shape.positions, shape.triangles);
        for (int i = 0; i < 200; ++i) {
            glm::dvec3 q(random.in(-2, 2), random.in(-2, 2), random.in(-2, 2));
            if (i % 2 == 0) q = glm::round(q * 8.0) / 8.0;
            if (bvh.closest(q, 1e-6).triangle != ClosestPoint::kNone) continue;
            const double expected = solidAngleWinding(shape, q);
            INFO("round " << round << " query " << i);
            CHECK(test.winding(q) == static_cast<int>(std::lround(expected)));
        }
    }
}

TEST_CASE("a batch says the same whatever the number of threads, and is quick") {
    const Shape shape = torusShape(1, 0.4F, 205, 100);  // 41,000 triangles
    const auto start = std::chrono::steady_clock::now();
    const InsideTest test = insideOf(shape);
    const auto built = std::chrono::steady_clock::now();
    Random random(5);
    std::vector<glm::vec3> points(60000);
    for (glm::vec3& p : points) {
        p = {random.in(-1.4, 1.4), random.in(-1.4, 1.4), random.in(-0.4, 0.4)};
    }
    std::vector<uint8_t> one(points.size()), two(points.size());
    const auto before = std::chrono::steady_clock::now();
    test.inside(points, one, 1);
    const auto after = std::chrono::steady_clock::now();
    test.inside(points, two, 3);
    CHECK(one == two);
    const auto ms = [](auto d) { return std::chrono::duration<double, std::milli>(d).count(); };
    MESSAGE("build " << ms(built - start) << " ms, 60,000 queries " << ms(after - before) << " ms");
}
