// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// The time grows with the cube of the number of corners: beyond this many there is no filling.
inline constexpr size_t kMostCornersOfLeastArea = 400;

/// Triangles (indices into `polygon`) of the least area in sum that fill a polygon in space,
/// turning as it does, whatever its shape. No edge between corners a and b that `forbidden(a, b)`;
/// none if there is no such filling without triangles of no area.
std::vector<std::array<uint32_t, 3>> fillWithLeastArea(
    std::span<const glm::vec3> polygon,
    const std::function<bool(uint32_t, uint32_t)>& forbidden = {});

}  // namespace sherd
