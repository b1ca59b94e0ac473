// SPDX-License-Identifier: MIT
// Lines of one skin carried through the solid onto the other (thesis 6.3.2).
#pragma once

#include "sherd/baker/surface_mesh.h"
#include "surface/cut_surface.h"

namespace sherd {

struct CarriedLines {
    uint32_t edges = 0;           ///< pieces of line that were carried across
    std::vector<BakePlace> rims;  ///< line ends that were led over a rim to where they arrive
};

/// Draws on the far side what only the near side has: a line is carried unless one that runs its
/// way lies about where it would arrive. Where lines end at an edge of the surface they are led on
/// over it. Lines of patterns are not carried: their cells say what a piece is. Errors:
/// limitExceeded, invalidData.
Result<CarriedLines> carryLines(const SurfaceMesh& mesh, const CutOptions& options,
                                CutSurface& cut);

}  // namespace sherd
