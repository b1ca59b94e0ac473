// SPDX-License-Identifier: MIT
// A wall whose two sides are cut in other ways, and what closes it all the same.
//
// One leaf of the side where the smallest part of the wall is not its own takes the other side's
// faces, turned round, for its own, and between itself and what else is on its side a fold without
// volume. Then all faces have their opposite, bit by bit, and every leaf is as closed as it was:
// the border of what it gains is that of what it loses.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "levels/piece_model.h"

namespace sherd {

struct WallFold {
    std::vector<HiddenMesh::Face> added;
    std::vector<uint32_t> dropped;  ///< faces that are no more
    std::vector<uint32_t> inner;    ///< faces that lie on the fold now, not on the wall
    uint32_t exposedFrom = 0;       ///< of these
};

/// faces: over places; sides: those of them on each side of the wall. Nothing if the two sides do
/// not end at the same edges.
std::optional<WallFold> foldWall(const std::vector<HiddenMesh::Face>& faces,
                                 const std::array<std::vector<uint32_t>, 2>& sides,
                                 const PieceModel& model);

}  // namespace sherd
