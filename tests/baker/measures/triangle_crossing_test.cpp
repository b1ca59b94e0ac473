// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>

#include "geometry/triangle_crossing.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Triangle = CrossingTest::Triangle;

bool cross(const Triangle& a, const Triangle& b) {
    const bool result = CrossingTest(a).crosses(b);
    CHECK(CrossingTest(b).crosses(a) == result);
    return result;
}

// The judge: convex sets without their borders are disjoint if and only if some direction parts
// them, and for triangles that is a normal or a product of two edges. In whole numbers, so exact.
using Whole = std::array<int64_t, 3>;
using WholeTriangle = std::array<Whole, 3>;

Whole minus(const Whole& a, const Whole& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Whole times(const Whole& a, const Whole& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
int64_t dot(const Whole& a, const Whole& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// They lie on two sides of some plane across the axis, and not both in it.
bool parts(const Whole& axis, const WholeTriangle& a, const WholeTriangle& b) {
    int64_t lowA = INT64_MAX, highA = INT64_MIN, lowB = INT64_MAX, highB = INT64_MIN;
    for (size_t k = 0; k < 3; ++k) {
        lowA = std::min(lowA, dot(axis, a[k]));
        highA = std::max(highA, dot(axis, a[k]));
        lowB = std::min(lowB, dot(axis, b[k]));
        highB = std::max(highB, dot(axis, b[k]));
    }
    const bool flat = lowA == highA && lowB == highB && lowA == lowB;
    return !flat && (highA <= lowB || highB <= lowA);
}

bool crossByAxes(const WholeTriangle& a, const WholeTriangle& b) {
    const Whole normalA = times(minus(a[1], a[0]), minus(a[2], a[0]));
    const Whole normalB = times(minus(b[1], b[0]), minus(b[2], b[0]));
    if (normalA == Whole{} || normalB == Whole{}) return false;
    if (parts(normalA, a, b) || parts(normalB, a, b)) return false;
    for (size_t i = 0; i < 3; ++i) {
        const Whole ea = minus(a[(i + 1) % 3], a[i]), eb = minus(b[(i + 1) % 3], b[i]);
        if (parts(times(normalA, ea), a, b) || parts(times(normalB, eb), a, b)) return false;
        for (size_t j = 0; j < 3; ++j)
            if (parts(times(ea, minus(b[(j + 1) % 3], b[j])), a, b)) return false;
    }
    return true;
}

Triangle real(const WholeTriangle& t, double scale) {
    Triangle result;
    for (size_t k = 0; k < 3; ++k)
        result[k] = scale * glm::dvec3(static_cast<double>(t[k][0]), static_cast<double>(t[k][1]),
                                       static_cast<double>(t[k][2]));
    return result;
}

}  // namespace

TEST_CASE("triangles without area cross nothing") {
    const Triangle flat = {glm::dvec3(0, 0, 0), {1, 0, 0}, {2, 0, 0}};
    const Triangle dot = {glm::dvec3(1, 0, 0), {1, 0, 0}, {1, 0, 0}};
    const Triangle upright = {glm::dvec3(1, -1, -1), {1, 1, -1}, {1, 0, 2}};
    CHECK_FALSE(cross(flat, upright));
    CHECK_FALSE(cross(dot, upright));
    CHECK_FALSE(cross(flat, flat));
    CHECK_FALSE(cross(dot, dot));
}

TEST_CASE("touching in a corner, on an edge or with a corner on a face is no crossing") {
    const Triangle floor = {glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}};
    CHECK_FALSE(cross(floor, {glm::dvec3(1, 1, 0), {1, 1, 2}, {2, 1, 2}}));    // corner on face
    CHECK_FALSE(cross(floor, {glm::dvec3(1, 1, 0), {2, 1, 0}, {1, 1, 2}}));    // edge on face
    CHECK_FALSE(cross(floor, {glm::dvec3(2, -1, 0), {2, 0, 1}, {2, 0, -1}}));  // edge across edge
    CHECK_FALSE(cross(floor, {glm::dvec3(0, 0, 0), {-4, 0, 0}, {0, -4, 0}}));  // a common corner
    CHECK_FALSE(cross(floor, {glm::dvec3(4, 0, 0), {0, 0, 0}, {0, -4, 0}}));  // in the plane beside
    CHECK_FALSE(cross(floor, {glm::dvec3(0, 0, 1), {4, 0, 1}, {0, 4, 1}}));   // parallel
}

TEST_CASE("neighbours over an edge cross only when one is folded onto the other") {
    const Triangle t = {glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}};
    CHECK_FALSE(cross(t, {glm::dvec3(4, 0, 0), {0, 0, 0}, {1, 1, 1e-300}}));
    CHECK(cross(t, {glm::dvec3(4, 0, 0), {0, 0, 0}, {1, 1, 0}}));
    CHECK(cross(t, t));
    CHECK(cross(t, {t[1], t[0], t[2]}));
}

TEST_CASE("triangles of one corner cross when one runs through the other's inside") {
    const Triangle t = {glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}};
    CHECK(cross(t, {glm::dvec3(0, 0, 0), {2, 2, -1}, {2, 2, 1}}));
    CHECK_FALSE(cross(t, {glm::dvec3(0, 0, 0), {2, -2, -1}, {2, -2, 1}}));
}

TEST_CASE("the smallest step decides") {
    const Triangle t = {glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}};
    const double tiny = std::nextafter(0.0, 1.0) * 1e240;
    CHECK(cross(t, {glm::dvec3(1, 1, -tiny), {1, 1, 2}, {2, 1, 2}}));
    CHECK_FALSE(cross(t, {glm::dvec3(1, 1, tiny), {1, 1, 2}, {2, 1, 2}}));
    const double one = std::nextafter(1.0, 0.0);
    // Across the hypotenuse x + y = 4, touching it or a bit inside.
    CHECK_FALSE(cross(t, {glm::dvec3(3, 1, -1), {3, 1, 1}, {5, 3, 0}}));
    CHECK(cross(t, {glm::dvec3(3, one, -1), {3, one, 1}, {5, 3, 0}}));
}

TEST_CASE("random triangles on a small grid cross as separating directions say, at any scale") {
    int crossing = 0, all = 0;
    for (const uint32_t seed : propertySeeds(1, 200)) {
        CAPTURE(seed);
        Random random(seed);
        const double scale = std::ldexp(1.0, static_cast<int>(random.below(41)) - 20) / 3;
        for (int i = 0; i < 500; ++i) {
            const uint32_t side = 2 + random.below(4);
            WholeTriangle a{}, b{};
            for (WholeTriangle* t : {&a, &b})
                for (Whole& p : *t)
                    for (int64_t& x : p) x = random.below(side);
            const bool expected = crossByAxes(a, b);
            // A third is no double: but all coordinates are rounded alike only for scales of two.
            const double exactScale = std::exp2(std::round(std::log2(scale)));
            const bool said = CrossingTest(real(a, exactScale)).crosses(real(b, exactScale));
            if (said != expected) FAIL_CHECK("pair " << i);
            crossing += expected ? 1 : 0;
            ++all;
        }
    }
    CHECK(crossing > all / 20);
    CHECK(crossing < all / 2);
}
