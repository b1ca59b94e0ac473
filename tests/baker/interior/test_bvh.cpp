// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <chrono>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "geometry/triangle_bvh.h"
#include "interior/shapes.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("no triangles, or none within reach, give no closest point") {
    CHECK(TriangleBvh({}, {}).closest({0, 0, 0}).triangle == ClosestPoint::kNone);
    const Shape shape = box({0, 0, 0}, {1, 1, 1});
    const TriangleBvh bvh(shape.positions, shape.triangles);
    CHECK(bvh.closest({3, 0.5, 0.5}, 1.9).triangle == ClosestPoint::kNone);
    CHECK(bvh.closest({3, 0.5, 0.5}, 2.0).distance2 == 4);
}

TEST_CASE("degenerate triangles are segments and points") {
    const glm::dvec3 a(0, 0, 0), b(2, 0, 0), c(1, 0, 0);
    CHECK(closestOnTriangle({1.5, 1, 0}, a, b, c) == glm::dvec3(1.5, 0, 0));
    CHECK(closestOnTriangle({5, 1, 0}, a, c, b) == glm::dvec3(2, 0, 0));
    CHECK(closestOnTriangle({5, 1, 0}, a, a, a) == a);
    CHECK(closestOnTriangle({1, 1, 1}, a, b, b) == glm::dvec3(1, 0, 0));
}

TEST_CASE("a needle as thin as rounding is near to what lies on it") {
    const glm::vec3 a(0.8F, 0.4F, 0.2F), b(0.4F, 0.8F, 1.0F),
        c(0.6F, 0.6F, 0.6F);  // all but in line
    for (int k = 1; k < 20; ++k) {
        const glm::dvec3 p = glm::mix(glm::dvec3(b), glm::dvec3(c), k / 20.0);
        CHECK(glm::distance(closestOnTriangle(p, a, b, c), p) < 1e-9);
        CHECK(glm::distance(closestOnTriangle(p, c, a, b), p) < 1e-9);
        CHECK(glm::distance(closestOnTriangle(p, b, c, a), p) < 1e-9);
    }
}

TEST_CASE("the closest point equals the best of all triangles") {
    Random random(77);
    for (int round = 0; round < propertyCases(20); ++round) {
        Shape shape = torusShape(1, 0.4F, 17, 11);
        shape.transform([&](glm::vec3 p) {
            return p + 0.2F * glm::vec3(random.unit(), random.unit(), random.unit());
        });
        const TriangleBvh bvh(shape.positions, shape.triangles);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 q(random.in(-2, 2), random.in(-2, 2), random.in(-1, 1));
            const uint32_t skipped = random.below(static_cast<uint32_t>(shape.triangles.size()));
            double best = 1e9;
            for (uint32_t t = 0; t < shape.triangles.size(); ++t) {
                if (t == skipped) continue;
                const auto& v = shape.triangles[t];
                const glm::dvec3 p = closestOnTriangle(
                    q, shape.positions[v[0]], shape.positions[v[1]], shape.positions[v[2]]);
                best = std::min(best, glm::dot(p - q, p - q));
            }
            const ClosestPoint found = bvh.closest(q, 10, [&](uint32_t t) { return t != skipped; });
            CHECK(found.distance2 == best);
            CHECK(found.triangle != skipped);
        }
    }
}

TEST_CASE("100,000 closest points on 100,000 triangles are quick") {
    const Shape shape = torusShape(1, 0.4F, 320, 157);
    const auto start = std::chrono::steady_clock::now();
    const TriangleBvh bvh(shape.positions, shape.triangles);
    const auto built = std::chrono::steady_clock::now();
    Random random(6);
    double sum = 0;
    for (int i = 0; i < 100000; ++i) {
        glm::dvec3 q(shape.positions[i % shape.positions.size()]);
        q *= random.in(0.97, 1.03);
        sum += bvh.closest(q, 0.1).distance2;
    }
    const auto after = std::chrono::steady_clock::now();
    CHECK(sum > 0);
    const auto ms = [](auto d) { return std::chrono::duration<double, std::milli>(d).count(); };
    MESSAGE("build " << ms(built - start) << " ms, queries " << ms(after - built) << " ms");
}
