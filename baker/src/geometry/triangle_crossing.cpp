// SPDX-License-Identifier: MIT
// P. Guigue and O. Devillers, "Fast and Robust Triangle-Triangle Overlap Test Using Orientation
// Predicates" (2003). Each triangle meets the line in which the planes cross in an interval; two
// orientations compare the intervals' ends. Here the intervals are open, so that touching does not
// count: then a corner on the other's plane needs no case of its own, and neighbours in a mesh,
// whose common corners are the same bits, fall out by themselves.
#include "geometry/triangle_crossing.h"

#include <cmath>
#include <utility>

#include "geometry/predicates.h"
#include "geometry/triangle.h"

namespace sherd {
namespace {

using Triangle = std::array<glm::dvec3, 3>;
using Signs = std::array<int, 3>;

/// The open triangle reaches both sides of the plane.
bool pierces(const Signs& s) {
    const bool above = s[0] > 0 || s[1] > 0 || s[2] > 0;
    const bool below = s[0] < 0 || s[1] < 0 || s[2] < 0;
    return above && below;
}

/// The triangle turned so that its first corner lies alone on its side of the plane, not on it.
Triangle lonelyFirst(const Triangle& t, const Signs& s, int& side) {
    const int sum = s[0] + s[1] + s[2];
    for (size_t k = 0; k < 3; ++k) {
        const int next = s[(k + 1) % 3], last = s[(k + 2) % 3];
        // Of one corner above, one below and one on the plane either serves: take the upper one.
        const bool alone = sum == 0 ? s[k] > 0 : s[k] != 0 && next * s[k] <= 0 && last * s[k] <= 0;
        if (!alone) continue;
        side = s[k];
        return {t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
    }
    side = 0;
    return t;
}

bool intervalsOverlap(Triangle a, const Signs& sa, Triangle b, const Signs& sb) {
    int sideA = 0, sideB = 0;
    a = lonelyFirst(a, sa, sideA);
    b = lonelyFirst(b, sb, sideB);
    // Both first corners to the upper side of the other's plane: swapping the last two corners of
    // one turns its plane over.
    if (sideB < 0) std::swap(a[1], a[2]);
    if (sideA < 0) std::swap(b[1], b[2]);
    return orient3d(a[0], a[1], b[0], b[1]) < 0 && orient3d(a[0], a[2], b[2], b[0]) < 0;
}

/// All corners of t lie on the far side of the edge from p to q, or on it; `turn` is the near one.
bool allBeyond(const std::array<glm::dvec2, 3>& t, const glm::dvec2& p, const glm::dvec2& q,
               int turn) {
    for (const glm::dvec2& x : t)
        if (orient2d(p, q, x) * turn > 0) return false;
    return true;
}

/// Triangles of one plane: disjoint inside if and only if an edge of one has the other beyond it.
bool overlapInPlane(const Triangle& a, const Triangle& b) {
    const auto flat = [](const Triangle& t, int axis) {
        return orient2d(without(t[0], axis), without(t[1], axis), without(t[2], axis));
    };
    int axis = 0;
    while (axis < 2 && flat(a, axis) == 0) ++axis;
    const int turnA = flat(a, axis), turnB = flat(b, axis);
    if (turnA == 0 || turnB == 0) return false;
    std::array<glm::dvec2, 3> pa, pb;
    for (size_t k = 0; k < 3; ++k) {
        pa[k] = without(a[k], axis);
        pb[k] = without(b[k], axis);
    }
    for (size_t k = 0; k < 3; ++k) {
        if (allBeyond(pb, pa[k], pa[(k + 1) % 3], turnA)) return false;
        if (allBeyond(pa, pb[k], pb[(k + 1) % 3], turnB)) return false;
    }
    return true;
}

}  // namespace

CrossingTest::Plane::Plane(const Triangle& t) {
    constexpr double kBound = 7.8e-16;  // (7 + 56 u) u, and the rounding of the bound
    const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0];
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double left = u[i] * v[j], right = u[j] * v[i];
        normal[k] = left - right;
        bound[k] = kBound * (std::abs(left) + std::abs(right));
    }
}

int CrossingTest::Plane::side(const Triangle& t, const glm::dvec3& p) const {
    const double x = p.x - t[0].x, y = p.y - t[0].y, z = p.z - t[0].z;
    const double det = normal.x * x + normal.y * y + normal.z * z;
    const double error = bound.x * std::abs(x) + bound.y * std::abs(y) + bound.z * std::abs(z) +
                         detail::kSmallestTrusted;
    if (det > error) return 1;
    if (-det > error) return -1;
    // A corner that both have needs no exact arithmetic to find a 0.
    if (p == t[0] || p == t[1] || p == t[2]) return 0;
    return orient3d(t[0], t[1], t[2], p);
}

CrossingTest::Signs CrossingTest::Plane::sides(const Triangle& t, const Triangle& points) const {
    return {side(t, points[0]), side(t, points[1]), side(t, points[2])};
}

CrossingTest::CrossingTest(const Triangle& own) : own_(own), plane_(own) {}

bool CrossingTest::crosses(const Triangle& other) const {
    const Signs others = plane_.sides(own_, other);
    if (!pierces(others)) {
        // A triangle without area has everything on its plane.
        if (others != Signs{}) return false;
        return Plane(other).sides(other, own_) == Signs{} && overlapInPlane(own_, other);
    }
    const Signs owns = Plane(other).sides(other, own_);
    return pierces(owns) && intervalsOverlap(own_, owns, other, others);
}

}  // namespace sherd
