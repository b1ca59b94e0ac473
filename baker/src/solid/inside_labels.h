// SPDX-License-Identifier: MIT
// Which piece every part of the inside goes to.
#pragma once

#include <cstdint>
#include <vector>

#include "solid/tetra_complex.h"
#include "surface/components.h"

namespace sherd {

struct InsideLabels {
    std::vector<uint32_t> piece;  ///< per tetrahedron
    std::vector<uint8_t> broken;  ///< per piece: cannot be told apart from another somewhere
    uint32_t pinchedEdges = 0;    ///< where a fragment still meets itself along an edge
};

/// Everything goes to the piece whose patch is nearest, and from there on to where walls are
/// smaller; what lies at the skin goes to the patch there. pieces: of the surface before the cut.
InsideLabels labelInside(const TetraComplex& complex, const SplitSurface& before,
                         const Components& pieces);

}  // namespace sherd
