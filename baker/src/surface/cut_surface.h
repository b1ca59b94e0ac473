// SPDX-License-Identifier: MIT
// Thesis steps 1 to 5 in a row: all lines of a plan are cut into a mesh.
//
// Drawings in UV are cut together, in the exact frame of the texture coordinates; then each
// projected drawing in its own frame; then lines over the surface and patterns, in the frame of
// every triangle. Each cut is exact over the surface that the one before left.
#pragma once

#include "sherd/baker/fracture_plan.h"
#include "sherd/baker/surface_mesh.h"
#include "surface/line_table.h"
#include "surface/mesh_topology.h"
#include "surface/seam_joining.h"
#include "surface/split_surface.h"

namespace sherd {

struct CutOptions {
    SeamOptions seams;
};

struct CutSurface {
    SplitSurface surface;
    MeshTopology topology;  ///< of the split surface
    LineTable lines;
    SeamReport seams;
    std::vector<LooseEnd> deadEnds;     ///< line ends in the middle of the surface
    std::vector<std::string> warnings;  ///< of the planariser
};

/// Errors: noTextureCoordinates, limitExceeded, invalidData.
Result<CutSurface> cutSurface(const SurfaceMesh& mesh, const MeshTopology& topology,
                              const FracturePlan& plan, const CutOptions& options);

/// Splitting keeps what it splits: every source triangle's area (to `tolerance`, relative to the
/// whole), no vertex outside its source triangle, no new border.
bool isFaithfulSplit(const SurfaceMesh& mesh, const MeshTopology& before, const CutSurface& cut,
                     double tolerance);

}  // namespace sherd
