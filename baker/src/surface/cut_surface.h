// SPDX-License-Identifier: MIT
// Thesis steps 1 to 5 in a row: a drawn map is cut into a mesh.
#pragma once

#include "sherd/baker/fracture_map.h"
#include "sherd/baker/surface_mesh.h"
#include "surface/mesh_topology.h"
#include "surface/seam_joining.h"
#include "surface/split_surface.h"

namespace sherd {

struct CutSurface {
    SplitSurface surface;
    MeshTopology topology;  ///< of the split surface
    SeamReport seams;
    std::vector<glm::dvec2> deadEnds;   ///< UV of line ends in the middle of the surface
    std::vector<std::string> warnings;  ///< of the planariser
};

/// Errors: noTextureCoordinates, limitExceeded, invalidData.
Result<CutSurface> cutSurface(const SurfaceMesh& mesh, const MeshTopology& topology,
                              const FractureMap& map, const SeamOptions& options);

/// Splitting keeps what it splits: every source triangle's area (to `tolerance`, relative to the
/// whole), no vertex outside its source triangle, no new border.
bool isFaithfulSplit(const SurfaceMesh& mesh, const MeshTopology& before, const CutSurface& cut,
                     double tolerance);

}  // namespace sherd
