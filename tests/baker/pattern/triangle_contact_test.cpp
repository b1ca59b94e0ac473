// SPDX-License-Identifier: MIT
#include "geometry/triangle_contact.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>
#include <vector>

#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Triangle = std::array<glm::dvec3, 3>;
using Rational = boost::multiprecision::cpp_rational;

/// In every order of arguments and corners.
bool touch(Triangle a, Triangle b) {
    const bool said = trianglesTouch(a, b);
    for (int turn = 0; turn < 3; ++turn) {
        std::rotate(a.begin(), a.begin() + 1, a.end());
        CHECK(trianglesTouch(a, b) == said);
        CHECK(trianglesTouch(b, a) == said);
    }
    std::swap(b[0], b[1]);
    CHECK(trianglesTouch(a, b) == said);
    return said;
}

/// Solves columns * x = (0, 0, 0, 1, 1); nothing unless there is exactly one solution.
std::optional<std::vector<Rational>> solve(std::vector<std::array<Rational, 5>> columns) {
    std::array<Rational, 5> right{0, 0, 0, 1, 1};
    size_t row = 0;
    for (size_t c = 0; c < columns.size(); ++c, ++row) {
        size_t pivot = row;
        while (pivot < 5 && columns[c][pivot] == 0) ++pivot;
        if (pivot == 5) return std::nullopt;
        for (auto& column : columns) std::swap(column[row], column[pivot]);
        std::swap(right[row], right[pivot]);
        for (size_t r = 0; r < 5; ++r) {
            if (r == row || columns[c][r] == 0) continue;
            const Rational factor = columns[c][r] / columns[c][row];
            for (size_t d = c; d < columns.size(); ++d) columns[d][r] -= factor * columns[d][row];
            right[r] -= factor * right[row];
        }
    }
    std::vector<Rational> x;
    for (size_t r = row; r < 5; ++r)
        if (right[r] != 0) return std::nullopt;
    for (size_t c = 0; c < columns.size(); ++c) x.push_back(right[c] / columns[c][c]);
    return x;
}

/// Convex sums of the corners agree somewhere: by trying every basis of that linear programme.
bool touchByBruteForce(const Triangle& a, const Triangle& b) {
    for (uint32_t mask = 1; mask < 64; ++mask) {
        if ((mask & 7U) == 0 || mask >> 3 == 0) continue;
        std::vector<std::array<Rational, 5>> columns;
        for (uint32_t k = 0; k < 6; ++k) {
            if ((mask >> k & 1U) == 0) continue;
            const glm::dvec3& p = k < 3 ? a[k] : b[k - 3];
            const int sign = k < 3 ? 1 : -1;
            columns.push_back({Rational(sign * p.x), Rational(sign * p.y), Rational(sign * p.z),
                               Rational(k < 3 ? 1 : 0), Rational(k < 3 ? 0 : 1)});
        }
        if (columns.size() > 5) continue;
        const auto x = solve(std::move(columns));
        if (x && std::all_of(x->begin(), x->end(), [](const Rational& w) { return w >= 0; }))
            return true;
    }
    return false;
}

const Triangle kFloor{glm::dvec3(0, 0, 0), glm::dvec3(4, 0, 0), glm::dvec3(0, 4, 0)};
const double kBelow = -std::nextafter(0.0, 1.0) * 0x1p900;  // about -5e-53: still exact

Triangle moved(Triangle t, const glm::dvec3& by) {
    for (glm::dvec3& p : t) p += by;
    return t;
}

}  // namespace

TEST_CASE("triangles that are points touch what they lie on and nothing else") {
    const auto point = [](double x, double y, double z) {
        return Triangle{glm::dvec3(x, y, z), glm::dvec3(x, y, z), glm::dvec3(x, y, z)};
    };
    CHECK(touch(point(1, 1, 0), kFloor));
    CHECK(touch(point(0, 0, 0), kFloor));
    CHECK(touch(point(2, 2, 0), kFloor));
    CHECK_FALSE(touch(point(2, std::nextafter(2.0, 3.0), 0), kFloor));
    CHECK_FALSE(touch(point(1, 1, kBelow), kFloor));
    CHECK(touch(point(1, 2, 3), point(1, 2, 3)));
    CHECK_FALSE(touch(point(1, 2, 3), point(1, 2, std::nextafter(3.0, 4.0))));
    CHECK(touch(point(1, 2, 3), {glm::dvec3(0, 0, 0), glm::dvec3(2, 4, 6), glm::dvec3(1, 2, 3)}));
    CHECK_FALSE(
        touch(point(3, 6, 9), {glm::dvec3(0, 0, 0), glm::dvec3(2, 4, 6), glm::dvec3(1, 2, 3)}));
}

TEST_CASE("triangles that are segments touch what they cross, end on or overlap") {
    const auto segment = [](const glm::dvec3& a, const glm::dvec3& b) {
        return Triangle{a, b, (a + b) * 0.5};
    };
    CHECK(touch(segment({1, 1, -1}, {1, 1, 1}), kFloor));
    CHECK(touch(segment({1, 1, 0}, {1, 1, 1}), kFloor));
    CHECK_FALSE(touch(segment({1, 1, 0x1p-60}, {1, 1, 1}), kFloor));
    CHECK(touch(segment({1, 1, 0}, {2, 1, 0}), kFloor));   // within the face
    CHECK(touch(segment({-1, 1, 0}, {5, 1, 0}), kFloor));  // through the face
    CHECK(touch(segment({4, 0, 0}, {8, 0, 0}), kFloor));   // ahead of an edge
    CHECK_FALSE(touch(segment({5, 0, 0}, {8, 0, 0}), kFloor));
    CHECK(touch(segment({0, 0, 0}, {2, 2, 2}), segment({1, 1, 1}, {3, 3, 3})));
    CHECK_FALSE(touch(segment({0, 0, 0}, {1, 1, 1}), segment({2, 2, 2}, {3, 3, 3})));
    CHECK(touch(segment({0, 0, 0}, {2, 2, 2}), segment({0, 2, 1}, {2, 0, 1})));
    CHECK_FALSE(touch(segment({0, 0, 0}, {2, 2, 2}), segment({0, 2, 1}, {2, 0, 1.25})));
    CHECK_FALSE(touch(segment({0, 0, 1}, {2, 2, 1}), segment({0, 2, 2}, {2, 0, 2})));
}

TEST_CASE("triangles touch by vertex, edge, face, overlap and containment") {
    const Triangle up{glm::dvec3(1, 1, 0), glm::dvec3(1, 1, 4), glm::dvec3(2, 1, 4)};
    CHECK(touch(kFloor, kFloor));
    CHECK(touch(kFloor, up));                      // a vertex on the face
    CHECK(touch(kFloor, moved(up, {-1, -1, 0})));  // vertex on vertex
    CHECK(touch(kFloor, moved(up, {1, -1, 0})));   // vertex on edge
    CHECK(touch(kFloor, moved(up, {0, 0, -1})));   // an edge through the face
    CHECK_FALSE(touch(kFloor, moved(up, {0, 0, 0x1p-40})));
    CHECK(touch(kFloor, {glm::dvec3(1, -1, 1), glm::dvec3(1, 1, -1), glm::dvec3(1, 4, 9)}));
    CHECK(touch(kFloor, {glm::dvec3(4, 0, 0), glm::dvec3(0, 4, 0), glm::dvec3(4, 4, 0)}));
    CHECK(touch(kFloor, {glm::dvec3(0, 0, 0), glm::dvec3(4, 0, 0), glm::dvec3(0, -4, 1)}));
    CHECK(touch(kFloor, {glm::dvec3(1, 1, 0), glm::dvec3(1.5, 1, 0), glm::dvec3(1, 1.5, 0)}));
    CHECK(touch(kFloor, {glm::dvec3(-9, -9, 0), glm::dvec3(99, -9, 0), glm::dvec3(-9, 99, 0)}));
    CHECK(touch(kFloor, {glm::dvec3(3, 3, 0), glm::dvec3(-1, 1, 0), glm::dvec3(3, 4, 0)}));
    CHECK_FALSE(touch(kFloor, {glm::dvec3(3, 3, 0), glm::dvec3(4, 4, 0), glm::dvec3(3, 4, 0)}));
    CHECK_FALSE(touch(kFloor, moved(kFloor, {0, 0, 1})));
    CHECK_FALSE(touch(kFloor, moved(kFloor, {std::nextafter(4.0, 5.0), 0, 0})));
    CHECK(touch(kFloor, moved(kFloor, {4, 0, 0})));
    // A star of two triangles in one plane: no corner of one lies in the other.
    CHECK(touch({glm::dvec3(-3, -1, 0), glm::dvec3(3, -1, 0), glm::dvec3(0, 3, 0)},
                {glm::dvec3(-3, 1, 0), glm::dvec3(3, 1, 0), glm::dvec3(0, -3, 0)}));
}

TEST_CASE("a near miss by one ulp is a miss, whichever the side") {
    for (const double x : {1.0, 1e-6, 1e6}) {
        const Triangle wall{glm::dvec3(x, -x, -x), glm::dvec3(x, 3 * x, -x),
                            glm::dvec3(x, -x, 3 * x)};
        const auto tipAt = [x](double tip) {
            return Triangle{glm::dvec3(tip, 0, 0), glm::dvec3(0.5 * x, 0.25 * x, 0),
                            glm::dvec3(0.5 * x, 0, 0.25 * x)};
        };
        CHECK(touch(wall, tipAt(x)));
        CHECK_FALSE(touch(wall, tipAt(std::nextafter(x, 0.0))));
        CHECK(touch(wall, tipAt(std::nextafter(x, 2 * x))));
    }
}

TEST_CASE("contact agrees with a rational linear programme on random triangles") {
    const int cases = propertyCases(1200);
    int touching = 0;
    for (int i = 0; i < cases; ++i) {
        const auto seed = static_cast<uint32_t>(100 + i);
        CAPTURE(seed);
        Random random(seed);
        const uint32_t width = 2 + random.below(5);
        Triangle a, b;
        for (Triangle* t : {&a, &b}) {
            for (glm::dvec3& p : *t) {
                for (int k = 0; k < 3; ++k) {
                    p[k] = 1.0 + random.below(k == 2 ? 2 + random.below(2) : width);
                    if (random.below(12) == 0) p[k] = std::nextafter(p[k], random.in(-9, 9));
                }
            }
        }
        const bool expected = touchByBruteForce(a, b);
        touching += expected ? 1 : 0;
        REQUIRE(touch(a, b) == expected);
    }
    if (cases >= 100) {
        CHECK(touching * 5 > cases);
        CHECK(touching * 5 < cases * 4);
    }
}
