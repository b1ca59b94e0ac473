// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// Points along a Morton curve of 1024 steps a side, so that near ones are near each other.
struct MortonOrder {
    std::vector<uint32_t> items;  ///< in order; of points in one step the lower index comes first
    std::vector<uint32_t> codes;  ///< 30 bits each, of `items`, ascending
};

/// In linear time.
MortonOrder mortonOrder(std::span<const glm::vec3> points);

}  // namespace sherd
