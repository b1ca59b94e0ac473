// SPDX-License-Identifier: MIT
// Vertices of the outer surface: those of the mesh as they were, and interpolated ones where lines
// cut.
#pragma once

#include <unordered_map>

#include "sherd/baker/surface_mesh.h"
#include "surface/split_surface.h"

namespace sherd {

class OuterVertices {
  public:
    OuterVertices(const SurfaceMesh& mesh, const SplitSurface& surface, FractureGeometry& out);

    /// The output vertex of corner k of a split triangle. Corners that agree in position and in all
    /// attributes' sources share one.
    uint32_t vertex(const SplitTriangle& triangle, uint32_t k);

  private:
    struct Key {
        uint32_t splitVertex, a, b;  ///< and the attribute vertices it lies between
        bool operator==(const Key&) const = default;
    };
    struct KeyHash {
        size_t operator()(const Key& key) const;
    };
    uint32_t meshVertex(uint32_t splitVertex, uint32_t attributeVertex);
    uint32_t newVertex(uint32_t splitVertex, const std::array<uint32_t, 3>& sources,
                       const glm::dvec3& weights);

    const SurfaceMesh& mesh_;
    const SplitSurface& surface_;
    FractureGeometry& out_;
    std::vector<uint32_t> unsplit_;  ///< attribute vertex -> output vertex, where its position fits
    std::unordered_map<Key, uint32_t, KeyHash> split_;  ///< looked up only: order does not matter
};

}  // namespace sherd
