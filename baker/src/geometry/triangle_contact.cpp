// SPDX-License-Identifier: MIT
#include "geometry/triangle_contact.h"

#include <algorithm>

#include "geometry/predicates.h"
#include "geometry/triangle.h"

namespace sherd {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

/// The three corners lie on one line.
bool isFlat(const Triangle& t) {
    for (int axis = 0; axis < 3; ++axis)
        if (orient2d(without(t[0], axis), without(t[1], axis), without(t[2], axis)) != 0)
            return false;
    return true;
}

bool between(double a, double x, double b) {
    return std::min(a, b) <= x && x <= std::max(a, b);
}

bool segmentsTouch2d(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                     const glm::dvec2& d) {
    const int ac = orient2d(a, b, c), ad = orient2d(a, b, d);
    const int ca = orient2d(c, d, a), cb = orient2d(c, d, b);
    if (ac * ad < 0 && ca * cb < 0) return true;
    const auto on = [](int side, const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& x) {
        return side == 0 && between(p.x, x.x, q.x) && between(p.y, x.y, q.y);
    };
    return on(ac, a, b, c) || on(ad, a, b, d) || on(ca, c, d, a) || on(cb, c, d, b);
}

/// In a plane: looked at along an axis in which the triangle is not flat.
bool meetInPlane(const glm::dvec3& p, const glm::dvec3& q, const Triangle& t) {
    int axis = 0;
    while (axis < 2 && orient2d(without(t[0], axis), without(t[1], axis), without(t[2], axis)) == 0)
        ++axis;
    const glm::dvec2 a = without(p, axis), b = without(q, axis);
    std::array<int, 3> side{};
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec2 c = without(t[k], axis), d = without(t[(k + 1) % 3], axis);
        if (segmentsTouch2d(a, b, c, d)) return true;
        side[k] = orient2d(c, d, a);
    }
    return (side[0] > 0 && side[1] > 0 && side[2] > 0) ||
           (side[0] < 0 && side[1] < 0 && side[2] < 0);
}

bool meets(const glm::dvec3& p, const glm::dvec3& q, const Triangle& t) {
    const int sp = orient3d(t[0], t[1], t[2], p);
    const int sq = orient3d(t[0], t[1], t[2], q);
    if (sp * sq > 0) return false;
    if (sp == 0 && sq == 0) return meetInPlane(p, q, t);
    bool left = true, right = true;
    for (size_t k = 0; k < 3; ++k) {
        const int side = orient3d(p, q, t[k], t[(k + 1) % 3]);
        left = left && side >= 0;
        right = right && side <= 0;
    }
    return left || right;
}

/// Segments in space: flat triangles have nothing else.
bool segmentsTouch(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                   const glm::dvec3& d) {
    if (orient3d(a, b, c, d) != 0) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (!segmentsTouch2d(without(a, axis), without(b, axis), without(c, axis),
                             without(d, axis)))
            return false;
    return true;
}

bool anyEdgeMeets(const Triangle& a, const Triangle& b, bool flat) {
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec3& p = a[k];
        const glm::dvec3& q = a[(k + 1) % 3];
        if (!flat && meets(p, q, b)) return true;
        for (size_t j = 0; flat && j < 3; ++j)
            if (segmentsTouch(p, q, b[j], b[(j + 1) % 3])) return true;
    }
    return false;
}

}  // namespace

bool trianglesTouch(const Triangle& a, const Triangle& b) {
    return anyEdgeMeets(a, b, isFlat(b)) || anyEdgeMeets(b, a, isFlat(a));
}

}  // namespace sherd
