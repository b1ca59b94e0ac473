// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// Triangles (indices into `polygon`) that fill a polygon in space, turning as it does, if it is
/// simple when seen along the axis to which its plane lies most squarely; otherwise none. Decided
/// exactly; as evenly shaped as the corners allow.
std::vector<std::array<uint32_t, 3>> fillInPlane(std::span<const glm::vec3> polygon);

}  // namespace sherd
