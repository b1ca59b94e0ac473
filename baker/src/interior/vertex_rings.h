// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "geometry/bisection.h"

namespace sherd {

/// The neighbours of each vertex of a triangulation, each named once for an edge the two share.
class VertexRings {
  public:
    VertexRings(size_t vertices, const BisectedTriangles& mesh)
        : VertexRings(
              vertices, mesh.triangles.size(),
              mesh.opposite, [&mesh](size_t t) -> const auto& { return mesh.triangles[t].v; }) {}

    /// opposite per half edge as in MeshTopology.
    VertexRings(size_t vertices, std::span<const std::array<uint32_t, 3>> triangles,
                std::span<const uint32_t> opposite)
        : VertexRings(
              vertices, triangles.size(),
              opposite, [&](size_t t) -> const auto& { return triangles[t]; }) {}

    std::span<const uint32_t> of(uint32_t v) const {
        return std::span(neighbours_).subspan(start_[v], start_[v + 1] - start_[v]);
    }
    size_t vertices() const { return start_.size() - 1; }

  private:
    template <class CornersOf>
    VertexRings(size_t vertices, size_t triangles, std::span<const uint32_t> opposite,
                const CornersOf& cornersOf)
        : start_(vertices + 1, 0) {
        const auto forEachStep = [&](const auto& visit) {
            for (size_t t = 0; t < triangles; ++t) {
                const auto& v = cornersOf(t);
                for (size_t k = 0; k < 3; ++k) {
                    const uint32_t a = v[k], b = v[(k + 1) % 3];
                    visit(a, b);
                    if (opposite[3 * t + k] == BisectedTriangles::kNone) visit(b, a);
                }
            }
        };
        forEachStep([this](uint32_t from, uint32_t) { ++start_[from + 1]; });
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        neighbours_.resize(start_.back());
        std::vector<uint32_t> next(start_.begin(), start_.end() - 1);
        forEachStep([&](uint32_t from, uint32_t to) { neighbours_[next[from]++] = to; });
    }
    std::vector<uint32_t> start_, neighbours_;
};

}  // namespace sherd
