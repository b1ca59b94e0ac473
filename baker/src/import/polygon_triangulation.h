// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// n - 2 triangles (indices into `polygon`) covering a simple polygon, concave ones too. Always
/// n - 2, whatever the input: a polygon that crosses itself is covered as well as it goes.
std::vector<std::array<uint32_t, 3>> triangulatePolygon(std::span<const glm::vec3> polygon);

}  // namespace sherd
