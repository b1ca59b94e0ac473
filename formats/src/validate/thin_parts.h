// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sherd {

/// How thick a closed mesh is at its thin places, metres: from points spread evenly over the
/// surface straight inwards to where the mesh ends, the length that `share` of them do not exceed.
/// 0 for a mesh without area.
double thinnestPart(const std::vector<glm::vec3>& positions,
                    const std::vector<std::array<uint32_t, 3>>& triangles, uint32_t points,
                    double share, uint32_t seed);

}  // namespace sherd
