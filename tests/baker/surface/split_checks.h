// SPDX-License-Identifier: MIT
// What must hold of every cut surface. Each check returns what is wrong, "" if nothing is.
#pragma once

#include <string>

#include "support/cut_oracle.h"
#include "surface/components.h"
#include "surface/cut_surface.h"

namespace sherd::test {

/// Lines are cut where they are drawn and nowhere else: neither repeated nor joined at seams.
inline CutOptions exactOptions() {
    CutOptions options;
    options.seams = {0, false};
    options.wrap = PageWrap::none;
    return options;
}

/// Every piece of a mesh edge is used as often in each direction as the edge was, every other edge
/// once each way; pieces of an edge are the same vertices, and so the same bits, on all its sides.
/// `topology` says of the split surface what this finds.
std::string brokenConformity(const SurfaceMesh& mesh, const CutSurface& cut);

/// Every source triangle's area is that of its pieces, but for the rounding of positions.
std::string brokenArea(const SurfaceMesh& mesh, const CutSurface& cut);

/// Every vertex is where its weights say, within its source triangle.
std::string brokenPlaces(const SurfaceMesh& mesh, const CutSurface& cut);

/// Both sides of an edge carry the same mark.
std::string brokenMarks(const CutSurface& cut);

/// Components are what is connected, and those of a level lie within one of the level above.
std::string brokenComponents(const CutSurface& cut, const Components& components);

/// Against exact arithmetic: edges are split in exactly their points, triangles in exactly the ends
/// of their lines; no triangle is turned over or without area in UV; lines lie on marked edges, of
/// their level, and nothing else is marked. `undecided` counts triangles too thin in UV to tell
/// which point is which.
std::string brokenGeometry(const SurfaceMesh& mesh, const CutSurface& cut, const CutOracle& oracle,
                           uint32_t& undecided);

/// The number of components of every level, and which places lie in the same one. `samples` counts
/// the places compared: cells too small to hold one surely are left out.
std::string brokenPartition(const SurfaceMesh& mesh, const CutSurface& cut,
                            const Components& components, const CutOracle& oracle,
                            uint32_t& samples);

}  // namespace sherd::test
