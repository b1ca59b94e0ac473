// SPDX-License-Identifier: MIT
// Small questions about one triangle of an indexed mesh.
#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace sherd {

/// The corner after corner 3 * triangle + k of the same triangle; likewise for half edges.
constexpr uint32_t nextCorner(uint32_t corner) {
    return corner - corner % 3 + (corner + 1) % 3;
}

/// Looked at along an axis.
inline glm::dvec2 without(const glm::dvec3& p, int axis) {
    return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

/// In double, in the square of the positions' unit.
inline double triangleArea(std::span<const glm::vec3> positions, const std::array<uint32_t, 3>& v) {
    const glm::dvec3 a = positions[v[0]];
    return 0.5 * glm::length(
                     glm::cross(glm::dvec3(positions[v[1]]) - a, glm::dvec3(positions[v[2]]) - a));
}

/// The weights of a, b and c at p, brought into their plane; outside the triangle some are
/// negative. Nothing for triangles without area.
inline std::optional<glm::dvec3> weightsIn(const glm::dvec3& p, const glm::dvec3& a,
                                           const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = glm::dot(normal, normal);
    if (!(area > 0)) return std::nullopt;
    const double wb = glm::dot(glm::cross(p - a, c - a), normal) / area;
    const double wc = glm::dot(glm::cross(b - a, p - a), normal) / area;
    return glm::dvec3(1 - wb - wc, wb, wc);
}

/// The weights of the corners at p in a plane. Nothing for triangles without area.
inline std::optional<glm::dvec3> weightsIn(const glm::dvec2& p,
                                           const std::array<glm::dvec2, 3>& corner) {
    const auto area = [](const glm::dvec2& x, const glm::dvec2& y) {
        return x.x * y.y - x.y * y.x;
    };
    const glm::dvec2 ab = corner[1] - corner[0];
    const glm::dvec2 ac = corner[2] - corner[0];
    const double whole = area(ab, ac);
    if (whole == 0) return std::nullopt;
    const double wb = area(p - corner[0], ac) / whole;
    const double wc = area(ab, p - corner[0]) / whole;
    return glm::dvec3(1 - wb - wc, wb, wc);
}

}  // namespace sherd
