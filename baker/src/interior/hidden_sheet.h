// SPDX-License-Identifier: MIT
// The hidden surface as a triangulation of its own. Only the border of a hidden patch must match
// the surface above it; inside it may be finer, where the outer triangles are too coarse for the
// medial surface below them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "surface/mesh_topology.h"
#include "surface/split_surface.h"

namespace sherd {

/// A refinement of the split surface. Vertices [0, split vertices) are the split surface's. Half
/// edge 3 * triangle + k runs from corner k to corner k + 1.
struct HiddenSheet {
    struct Triangle {
        std::array<uint32_t, 3> v;
        uint32_t parent;                ///< triangle of the split surface
        std::array<uint32_t, 3> along;  ///< the split surface's half edge that side k lies on;
                                        ///< kNone: side k lies inside the parent
    };
    std::vector<Triangle> triangles;    ///< sorted by parent
    std::vector<uint32_t> opposite;     ///< per half edge, as in MeshTopology
    std::vector<VertexOrigin> origins;  ///< per vertex: its foot on the mesh
    std::vector<glm::vec3> feet;        ///< per vertex: where it stands on the surface
    std::vector<glm::vec3> points;      ///< per vertex: the hidden point M below it
    uint32_t hubs = 0;  ///< the last vertices are no triangle's: points inside the solid where
                        ///< walls of solid pieces meet
};

/// The split surface itself as the sheet; `points` are one for each of its vertices.
HiddenSheet plainSheet(const SplitSurface& surface, const MeshTopology& topology,
                       std::vector<glm::vec3> points);

/// Puts hubs in the place of those the sheet had.
void setHubs(HiddenSheet& sheet, std::span<const glm::vec3> hubs);

/// An origin as weights of the three corners of the mesh triangle it lies in.
glm::dvec3 weightsOf(const VertexOrigin& origin, const std::array<uint32_t, 3>& meshTriangle);

}  // namespace sherd
