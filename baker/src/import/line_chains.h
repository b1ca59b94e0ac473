// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sherd {

/// Loose segments between points.
struct LineSegments {
    std::vector<glm::vec3> points;
    std::vector<std::array<uint32_t, 2>> ends;  ///< into points
};

struct LineChains {
    std::vector<std::vector<glm::vec3>> lines;  ///< at least 2 points each; loops repeat the first
    size_t withoutLength = 0;                   ///< segments dropped: both ends in one point
    size_t repeated = 0;                        ///< segments dropped: there before
};

/// The segments as few lines: bit-equal points are one; lines end where one segment or more than
/// two meet; what has no such end is a closed loop.
LineChains chainSegments(const LineSegments& segments);

}  // namespace sherd
