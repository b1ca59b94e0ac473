// SPDX-License-Identifier: MIT
// Signed crossings of a ray along +z with a triangle, decided exactly. Rays through vertices and
// edges are decided by symbolic perturbation (Edelsbrunner and Muecke, "Simulation of Simplicity",
// 1990) of the query alone: q' = q + (e, e^2, e^3) with e > 0 as small as one likes. In projection
// q' lies on no edge, so the signs of its three sides say without doubt whether it is in the
// triangle, and two triangles sharing an edge never both claim or both deny it.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "geometry/predicates.h"

namespace sherd {

namespace detail {

inline int signOf(double x) {
    return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

/// The side of q' on a -> b: orient2d(a, b, q), and where that is 0 the first of its derivatives
/// that is not. 0 only if a and b coincide.
inline int sideOfMoved(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& q) {
    if (const int side = orient2d(a, b, q)) return side;
    if (const int side = signOf(a.y - b.y)) return side;
    return signOf(b.x - a.x);
}

/// Whether q' is above the plane of a triangle whose projection turns as `turn`.
inline bool movedIsAbove(const std::array<glm::vec3, 3>& corner, const glm::dvec3& q, int turn) {
    const glm::dvec3 a(corner[0]), b(corner[1]), c(corner[2]);
    int side = orient3d(a, b, c, q);
    if (side == 0) side = orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z});  // x of the normal
    if (side == 0) side = orient2d({a.z, a.x}, {b.z, b.x}, {c.z, c.x});  // y of the normal
    if (side == 0) side = turn;
    return side == turn;
}

}  // namespace detail

/// How the triangle turns where the line through q along z meets it: 1 if upwards lies outside, -1
/// if inside, 0 if it does not meet it.
inline int lineCrossing(const std::array<glm::vec3, 3>& corner, const glm::dvec3& q) {
    const glm::dvec2 a(corner[0]), b(corner[1]), c(corner[2]), p(q);
    const int turn = detail::sideOfMoved(a, b, p);
    if (turn == 0 || detail::sideOfMoved(b, c, p) != turn || detail::sideOfMoved(c, a, p) != turn)
        return 0;
    return turn;
}

/// Whether the triangle, which the line through q meets with this turn, lies ahead of q.
inline bool liesAbove(const std::array<glm::vec3, 3>& corner, const glm::dvec3& q, int turn) {
    if (corner[0].z > q.z && corner[1].z > q.z && corner[2].z > q.z) return true;
    return !detail::movedIsAbove(corner, q, turn);
}

}  // namespace sherd
