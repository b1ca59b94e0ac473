// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace sherd {

/// How far a tetrahedron is from being turned over, as a length: the least of its heights, negative
/// if it is turned over. Corners a, b and c go counter-clockwise seen from beyond their face.
double leastHeight(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                   const glm::dvec3& apex);

/// A place that sees the inner side of all triangles of a closed surface, and the farther from
/// their planes the better; if there is none, one that sees most. Triangles that are lower than
/// `flat` are not asked: rounding turns them any way.
glm::dvec3 starCore(std::span<const glm::vec3> positions,
                    std::span<const std::array<uint32_t, 3>> triangles, double flat);

}  // namespace sherd
