// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sherd {

/// Whether two triangles share a point that lies on the border of neither. Exact. Triangles without
/// area share none.
bool insidesMeet(const std::array<glm::vec3, 3>& a, const std::array<glm::vec3, 3>& b);

struct CrossingCount {
    uint64_t pairs = 0;
    bool complete = true;  ///< false: so many triangles lie in one place that the count was ended
};

CrossingCount countCrossings(const std::vector<glm::vec3>& positions,
                             const std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace sherd
