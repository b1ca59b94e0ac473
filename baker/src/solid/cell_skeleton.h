// SPDX-License-Identifier: MIT
// The lines along which cells of a pattern meet inside the solid.
#pragma once

#include "solid/cell_space.h"
#include "solid/skeleton.h"

namespace sherd {

/// Follows the lines of the cells inwards from every node of three pieces, to where another piece
/// comes in (a hub, from which three more lines lead on) or to a node of the reversed order. Nodes
/// from which that does not work out keep no line.
void followCells(const SplitSurface& surface, const CellSpace& space, const BorderGraph& graph,
                 Skeleton& skeleton);

}  // namespace sherd
