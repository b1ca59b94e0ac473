// SPDX-License-Identifier: MIT
// Vertices of the outer surface: those of the mesh as they were, and interpolated ones where lines
// cut.
#pragma once

#include <map>
#include <tuple>

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
    using Key = std::tuple<uint32_t, uint32_t, uint32_t>;  ///< split vertex, attribute vertices
    uint32_t meshVertex(uint32_t splitVertex, uint32_t attributeVertex);
    uint32_t newVertex(uint32_t splitVertex, const std::array<uint32_t, 3>& sources,
                       const glm::dvec3& weights);

    const SurfaceMesh& mesh_;
    const SplitSurface& surface_;
    FractureGeometry& out_;
    std::vector<uint32_t> unsplit_;  ///< attribute vertex -> output vertex, where its position fits
    std::map<Key, uint32_t> split_;
};

}  // namespace sherd
