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

#include "geometry/bisection.h"
#include "surface/mesh_topology.h"
#include "surface/split_surface.h"

namespace sherd {

/// A refinement of the split surface, its parent. Vertices [0, split vertices) are the split
/// surface's.
struct HiddenSheet : BisectedTriangles {
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

/// Hidden points nearer to their feet than this (metres) come to lie on them: rounding must not
/// leave slivers of walls along creases, where there is no room below.
void snapToFeet(double distance, HiddenSheet& sheet);

}  // namespace sherd
