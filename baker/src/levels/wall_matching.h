// SPDX-License-Identifier: MIT
// Walls that two pieces share, after each of these was cut in its own way.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "levels/edge_points.h"
#include "levels/piece_model.h"

namespace sherd {

/// A triangle that two leaves had, seen from both sides.
struct WallPair {
    std::array<uint32_t, 3> v;                              ///< as the first sees it
    std::array<std::vector<EdgePoints::Point>, 3> onSides;  ///< from corner k to corner k + 1,
                                                            ///< shares of that way
    std::array<std::vector<uint32_t>, 2> faces;             ///< hidden faces that its parts are now
};

struct MatchedWalls {
    uint32_t folded = 0;  ///< by way of `foldWall`
    uint32_t apart = 0;   ///< whose two sides still have other triangles
};

/// Gives both sides of every wall the same triangles, by both cuts at once; caps that meet the wall
/// get the points that it gains. A wall whose parts are too small for the grid they are decided on
/// is folded.
MatchedWalls matchWalls(const std::vector<WallPair>& pairs, const PieceModel& model);

}  // namespace sherd
