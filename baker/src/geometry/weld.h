// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sherd {

/// Gives equal positions (bit by bit, -0 as +0) one index, in order of first appearance.
class PositionWelder {
  public:
    /// Distinct positions are appended to `positions`, which outlives the welder.
    explicit PositionWelder(std::vector<glm::vec3>& positions) : positions_(positions) {}

    /// The index in `positions` of each of `points`.
    std::vector<uint32_t> add(const std::vector<glm::vec3>& points);

  private:
    void grow(size_t expected);

    std::vector<glm::vec3>& positions_;
    std::vector<uint32_t> slots_;  ///< open addressing, size a power of two, at most half full
};

}  // namespace sherd
