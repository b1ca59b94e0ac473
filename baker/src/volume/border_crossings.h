// SPDX-License-Identifier: MIT
// Where the border of a cap crosses itself: the mesh crosses itself there.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "volume/cap_border.h"

namespace sherd {

/// Pairs of segments that cross between their ends.
std::vector<std::pair<uint32_t, uint32_t>> borderCrossings(
    const std::vector<BorderSegment>& segments, CapPlane& plane);

}  // namespace sherd
