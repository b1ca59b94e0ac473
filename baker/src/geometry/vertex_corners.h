// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace sherd {

/// The corners of triangles at each vertex; corner 3 * triangle + k.
class VertexCorners {
  public:
    VertexCorners(size_t vertices, std::span<const std::array<uint32_t, 3>> triangles)
        : start_(vertices + 1, 0), corners_(3 * triangles.size()) {
        for (const auto& t : triangles)
            for (const uint32_t v : t) ++start_[v + 1];
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        std::vector<uint32_t> next(start_.begin(), start_.end() - 1);
        for (uint32_t t = 0; t < triangles.size(); ++t)
            for (uint32_t k = 0; k < 3; ++k) corners_[next[triangles[t][k]]++] = 3 * t + k;
    }
    std::span<const uint32_t> of(uint32_t v) const {
        return std::span(corners_).subspan(start_[v], start_[v + 1] - start_[v]);
    }

  private:
    std::vector<uint32_t> start_, corners_;
};

}  // namespace sherd
