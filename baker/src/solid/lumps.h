// SPDX-License-Identifier: MIT
// The bodies that solid pieces consist of: a cell of a pattern may come to the surface in several
// places that hang together inside, or do not.
#pragma once

#include "solid/solid_walls.h"
#include "surface/components.h"
#include "surface/part_groups.h"

namespace sherd {

struct Lumps {
    std::vector<uint32_t> ofTriangle;
    std::vector<uint32_t> pieceOf;  ///< per lump
    /// Per lump the piece it goes to: its own, or, if it is a stray, that with which it shares the
    /// largest wall.
    std::vector<uint32_t> target;
    uint32_t strays = 0;
};

/// Names lumps instead of pieces in the walls; unless they are to be `judged`, every piece is one
/// lump. Of the lumps of one solid piece within one connected part of the mesh all but the largest
/// are strays; they go to solid neighbours that have the same parent.
Lumps splitLumps(const SplitSurface& surface, const MeshTopology& topology,
                 const Components& pieces, const PartGroups& groups, bool judged,
                 SolidWalls& walls);

}  // namespace sherd
