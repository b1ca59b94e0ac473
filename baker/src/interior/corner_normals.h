// SPDX-License-Identifier: MIT
// Normals of a surface that is smooth between its creases.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// Of each triangle's corners, unit: the mean, by angle, of those triangles around the vertex that
/// turn from this one by less than creaseAngle (radians). 0 for triangles without area.
std::vector<std::array<glm::vec3, 3>> cornerNormals(
    std::span<const glm::vec3> positions, std::span<const std::array<uint32_t, 3>> triangles,
    double creaseAngle);

}  // namespace sherd
