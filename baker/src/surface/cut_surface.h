// SPDX-License-Identifier: MIT
// Thesis steps 1 to 5 in a row: all lines of a plan are cut into a mesh.
//
// Drawings in UV are cut together, in the exact frame of the texture coordinates; then each
// projected drawing in its own frame; then lines over the surface and patterns, in the frame of
// every triangle. Each cut is exact over the surface that the one before left.
#pragma once

#include <optional>

#include "map/gap_closing.h"
#include "sherd/baker/fracture_plan.h"
#include "sherd/baker/recipe.h"
#include "sherd/baker/report.h"
#include "sherd/baker/surface_mesh.h"
#include "surface/line_table.h"
#include "surface/mesh_topology.h"
#include "surface/pieces.h"
#include "surface/seam_joining.h"
#include "surface/split_surface.h"

namespace sherd {

struct CutOptions {
    SeamOptions seams;
    double closeGaps = 0;  ///< dangling ends reach so far for a line: UV units in drawings, shares
                           ///< of the diagonal on the surface
    double snapDistance = 1e300;  ///< places in 3D farther from the surface are refused; metres
    PageWrap wrap = PageWrap::texture;
    bool splitPatches = false;  ///< every patch of a pattern's cell is a piece of its own
    bool wholeCells = false;    ///< all patches of a site's cell are one piece: they may hang
                                ///< together inside
};

struct CutSurface {
    SplitSurface surface;
    MeshTopology topology;  ///< of the split surface
    LineTable lines;
    PartGroups groups;             ///< empty unless patterns asked for it
    std::vector<CellLevel> cells;  ///< of patterns, shallow to deep
    bool splitPatches = false;     ///< as the options said
    SeamReport seams;
    std::vector<BakePlace> deadEnds;    ///< line ends in the middle of the surface
    std::vector<BakePlace> offSurface;  ///< places too far from the surface, or outside every chart
    std::vector<BakePlace> gaps;        ///< where no way leads on over the surface
    std::vector<BakePlace> alongEdges;  ///< where the way on follows the mesh's edges
    std::vector<BakePlace> closedGaps;  ///< ends that were led on to a line
    std::vector<BakePlace> offCharts;   ///< lines that touch no chart: where one begins, in UV only
    std::vector<std::string> warnings;

    /// Whether a pattern's cells, not patches, are the pieces of a level.
    bool hasCells(uint32_t level) const;
};

/// The lines of `mesh` itself and of the plan. Errors: noTextureCoordinates, limitExceeded,
/// invalidData.
Result<CutSurface> cutSurface(const SurfaceMesh& mesh, const MeshTopology& topology,
                              const FracturePlan& plan, const CutOptions& options);

/// The components of every level, patches of one pattern cell put together unless they are to be
/// split.
Components componentsOf(const CutSurface& cut, std::vector<CellReport>& reports);

/// Splitting keeps what it splits: every source triangle's area (to `tolerance`, relative to the
/// whole), no vertex outside its source triangle, no new border.
bool isFaithfulSplit(const SurfaceMesh& mesh, const MeshTopology& before, const CutSurface& cut,
                     double tolerance);

}  // namespace sherd
