// SPDX-License-Identifier: MIT
// Pieces of hardly any volume, where cuts and lines meet in one place.
//
// A cut joins such cells of a leaf to their neighbours itself. But where several leaves make up a
// piece, what is left of it may be too thin only after its walls were matched or folded, or once
// lines let its leaves part; and where sheets reach through each other it has less than none.
#pragma once

#include <cstdint>

#include "levels/piece_model.h"

namespace sherd {

/// Pieces of the deepest level that have hardly any volume, or less than none, become part of the
/// one of the same parent that they have the largest wall in common with; of the largest if they
/// have none. Before `exposeWalls`, which finds what shows. Returns how many there were.
uint32_t joinSlivers(const PieceModel& model);

}  // namespace sherd
