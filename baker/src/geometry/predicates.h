// SPDX-License-Identifier: MIT
// Exact signs of orientation determinants. Coordinates may be any finite doubles whose magnitude is
// 0 or between 1e-70 and 1e70 (every float is), so that no intermediate product under- or
// overflows.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sherd {

namespace detail {
int exactOrient2d(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);
int exactOrient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                  const glm::dvec3& d);

/// Below this a double determinant may have lost bits to underflow: decide exactly.
inline constexpr double kSmallestTrusted = 1e-250;
}  // namespace detail

/// +1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if collinear. Exact.
inline int orient2d(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    constexpr double kBound = 3.3306690738754716e-16;  // (3 + 16 u) u, u = 2^-53
    const double left = (a.x - c.x) * (b.y - c.y);
    const double right = (a.y - c.y) * (b.x - c.x);
    const double det = left - right;
    const double error = kBound * (std::abs(left) + std::abs(right)) + detail::kSmallestTrusted;
    if (det > error) return 1;
    if (-det > error) return -1;
    return detail::exactOrient2d(a, b, c);
}

/// +1 if d lies on the side to which (b - a) x (c - a) points, -1 on the other, 0 on the plane.
/// Exact.
inline int orient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    const glm::dvec3& d) {
    constexpr double kBound = 7.7715611723761027e-16;  // (7 + 56 u) u
    const double ax = a.x - d.x, ay = a.y - d.y, az = a.z - d.z;
    const double bx = b.x - d.x, by = b.y - d.y, bz = b.z - d.z;
    const double cx = c.x - d.x, cy = c.y - d.y, cz = c.z - d.z;
    const double bxcy = bx * cy, cxby = cx * by;
    const double cxay = cx * ay, axcy = ax * cy;
    const double axby = ax * by, bxay = bx * ay;
    const double det = az * (bxcy - cxby) + bz * (cxay - axcy) + cz * (axby - bxay);
    const double error = kBound * ((std::abs(bxcy) + std::abs(cxby)) * std::abs(az) +
                                   (std::abs(cxay) + std::abs(axcy)) * std::abs(bz) +
                                   (std::abs(axby) + std::abs(bxay)) * std::abs(cz)) +
                         detail::kSmallestTrusted;
    // The determinant of the rows a - d, b - d, c - d is positive when d lies behind the triangle.
    if (det > error) return -1;
    if (-det > error) return 1;
    return detail::exactOrient3d(a, b, c, d);
}

}  // namespace sherd
