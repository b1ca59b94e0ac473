// SPDX-License-Identifier: MIT
// Where the border of a cap crosses itself: the mesh crosses itself there.
#pragma once

#include <cstdint>
#include <vector>

#include "volume/cap_plane.h"

namespace sherd {

/// Part of a cap's border, all uses of it added up.
struct BorderSegment {
    uint32_t a, b;      ///< points, a < b
    int times;          ///< net, from a to b; not 0
    uint32_t triangle;  ///< one whose section it is; CapEdge::kNone: none
};

/// Pairs of segments that cross between their ends.
std::vector<std::pair<uint32_t, uint32_t>> borderCrossings(
    const std::vector<BorderSegment>& segments, CapPlane& plane);

}  // namespace sherd
