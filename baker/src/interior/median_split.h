// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// A triangle by its middle.
struct SplitMember {
    glm::vec3 middle;
    uint32_t triangle;
};

/// Brings `left` of the members to the front: those that lie lowest along the longest side of the
/// box around the middles; of equal ones those of lower triangles. Middles must be finite. In
/// linear time where they are spread about evenly. `scratch` may be shared by calls of one thread.
void medianSplit(std::span<SplitMember> members, size_t left, std::vector<SplitMember>& scratch);

}  // namespace sherd
