// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sherd {

/// A triangulated surface with a unit normal for each point.
struct WallSurface {
    std::span<const glm::dvec3> points;
    std::span<const std::array<uint32_t, 3>> triangles;
    std::span<const glm::dvec3> normals;
};

/// For each pole, the centre of its point's ball: none where that ball crosses no triangle and the
/// pole may stay, else the centre of the ball shrunk until it only touches.
std::vector<std::optional<glm::dvec3>> ballsBetweenWalls(
    const WallSurface& surface, std::span<const std::optional<glm::dvec3>> poles, unsigned threads);

}  // namespace sherd
