// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace sherd {

/// The neighbours of each vertex of a triangulation; a neighbour is named once for each triangle
/// the two share and direction, so most are named twice, which does no harm to extremes and makes
/// means those of the triangles.
class VertexRings {
  public:
    /// cornersOf(t) gives the three vertices of triangle t.
    template <class CornersOf>
    VertexRings(size_t vertices, size_t triangles, const CornersOf& cornersOf)
        : start_(vertices + 1, 0), neighbours_(6 * triangles) {
        for (size_t t = 0; t < triangles; ++t)
            for (const uint32_t v : cornersOf(t)) start_[v + 1] += 2;
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        std::vector<uint32_t> next(start_.begin(), start_.end() - 1);
        for (size_t t = 0; t < triangles; ++t) {
            const auto& v = cornersOf(t);
            for (size_t k = 0; k < 3; ++k) {
                neighbours_[next[v[k]]++] = v[(k + 1) % 3];
                neighbours_[next[v[k]]++] = v[(k + 2) % 3];
            }
        }
    }
    std::span<const uint32_t> of(uint32_t v) const {
        return std::span(neighbours_).subspan(start_[v], start_[v + 1] - start_[v]);
    }
    size_t vertices() const { return start_.size() - 1; }

  private:
    std::vector<uint32_t> start_, neighbours_;
};

}  // namespace sherd
