// SPDX-License-Identifier: MIT
// Walls with several outlines made one polygon.
#pragma once

#include <functional>

#include "solid/polygon_filling.h"
#include "solid/wall_loops.h"

namespace sherd {

/// An outline with what filling it needs.
struct WallPolygon {
    WallOutline outline;
    std::vector<PolygonCorner> corners;  ///< one for each vertex of the outline
};

/// A ring around a solid leg is the rim of a disc. All others (around a hole, around a plug that is
/// cut out of a wall) have a partner between the same pieces: the nearest outline, to which a
/// bridge leads. Pieces of rings that find none are marked broken. allowed: whether an edge between
/// two outline vertices may be made.
void joinOutlines(std::vector<WallPolygon>& walls,
                  const std::function<bool(const OutlineVertex&, const OutlineVertex&)>& allowed,
                  std::vector<uint8_t>& broken);

}  // namespace sherd
