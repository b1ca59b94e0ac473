// SPDX-License-Identifier: MIT
// Leaves that were cut one by one, put together again as the leaves of a new level.
#pragma once

#include <vector>

#include "levels/leaf_cut.h"
#include "levels/piece_model.h"

namespace sherd {

struct JoinedPieces {
    std::vector<uint32_t> parents;  ///< per leaf as they are now: which it was part of
    uint32_t folded = 0;  ///< triangles of walls that could not be cut on both sides alike
    uint32_t apart = 0;   ///< of which that was no help either
};

/// cuts: per leaf; those that are not divided stay as they are. Every piece becomes a leaf, and a
/// component of a new, deepest level, which shows the caps; pieces of one component with one label
/// are one. Where a leaf is cut, the edges it shares with others are split in those, too. Walls
/// between pieces are cut on both sides alike.
JoinedPieces joinPieces(const std::vector<LeafCut>& cuts, const PieceModel& model);

}  // namespace sherd
