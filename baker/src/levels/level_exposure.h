// SPDX-License-Identifier: MIT
// From which level on walls show, where that follows from levels to come.
//
// What is between two leaves shows when they part. Until then its two sides cancel: they are the
// same triangles, seen from either side, and so the sum of the leaves is closed without them.
#pragma once

#include <cstdint>
#include <vector>

#include "levels/piece_model.h"

namespace sherd {

/// HiddenMesh::Face::exposedFrom of what both of its sides are still together at.
inline constexpr uint32_t kNotExposed = 0xFFFFFFFFU;

/// Of hidden faces that do not show yet which one is its other side; kNone for others.
std::vector<uint32_t> otherSides(const PieceModel& model);

/// What parts at the deepest level that there is shows from there on; so does what has no other
/// side, for it would leave a hole where it does not show.
void exposeWalls(const PieceModel& model);

/// Where walls could not be cut alike on both sides, these may not cancel. A piece that would not
/// be closed without them shows them, from its level on: its leaves are closed with all that they
/// have. Returns how many pieces do.
uint32_t showOpenPieces(const PieceModel& model);

/// Makes leaves of one class one; walls within them are gone. classOfLeaf: leaves of one class are
/// together at all levels that there are.
void mergeClasses(const std::vector<uint32_t>& classOfLeaf, const PieceModel& model);

}  // namespace sherd
