// SPDX-License-Identifier: MIT
// What the pipeline's stages have to say: refusals, and entries of the report.
#pragma once

#include "interior/piece_mending.h"
#include "levels/level_order.h"
#include "repair/cap_holes.h"
#include "sherd/baker/report.h"
#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/result.h"
#include "solid/line_carrying.h"
#include "surface/cut_surface.h"

namespace sherd {

/// Tells which holes were capped; refuses meshes of which one could not be, unless allowed.
Result<void> judgeCaps(const SurfaceMesh& mesh, const std::vector<HoleCap>& caps, bool allowOpen,
                       BakedObjectReport& report);

/// Refuses open and non-manifold meshes unless allowed, and solids turned inside out.
Result<void> judgeTopology(const SurfaceMesh& mesh, const MeshTopology& topology, bool allowOpen,
                           BakedObjectReport& report);

/// Refuses maps of which a level separates nothing. Fills the levels' component counts. order: of
/// the levels that lines and cuts make, for messages.
Result<void> judgeSeparation(const Components& components, const CutSurface& cut,
                             const LevelOrder& order, BakedObjectReport& report);

/// The same after pieces were merged, and refuses objects of which no piece has a volume.
Result<void> judgeMerged(const Components& components, const CutSurface& cut,
                         const MendedPieces& pieces, const LevelOrder& order,
                         const BakedObjectReport& report);

/// Refuses sizes at which masses and moments of inertia do not fit a float.
Result<void> judgeSize(const SurfaceMesh& mesh, double diagonal);

/// How many pieces patterns made of those asked for, and why.
void reportCells(const std::vector<CellReport>& cells, const LevelOrder& order,
                 BakedObjectReport& report);

void reportCutting(const SurfaceMesh& mesh, const CutSurface& cut, const Components& components,
                   BakedObjectReport& report);

/// Where cutting changes the light on the surface enough to be seen.
void reportShading(const SurfaceMesh& mesh, const CutSurface& cut, BakedObjectReport& report);

void reportPieces(const SurfaceMesh& mesh, const std::vector<MergedLeaf>& small,
                  const MendedPieces& pieces, BakedObjectReport& report);

/// What was drawn on the far side of a solid interior's walls.
void reportCarried(const CarriedLines& carried, BakedObjectReport& report);

/// Which leaves a solid interior had to leave to the medial surface, and their share of the area.
void reportSolid(const SurfaceMesh& mesh, const CutSurface& cut, const Components& components,
                 const SolidLeaves& solid, BakedObjectReport& report);

/// Counts, closed ones proven over positions, and volume shares. Shells are meant to be hollow.
void reportFragments(const FractureSet& set, bool shells, BakedObjectReport& report);

}  // namespace sherd
