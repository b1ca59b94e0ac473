// SPDX-License-Identifier: MIT
#pragma once

#include "interior/hidden_sheet.h"
#include "surface/components.h"

namespace sherd {

/// Per point of the sheet: whether it is below a border of a component, where a wall ends.
std::vector<uint8_t> onBorders(const MeshTopology& topology, const Components& components,
                               const HiddenSheet& sheet);

/// Puts hidden points that lie near each other in one place, that of the first of them: none moves
/// by as much as `farthest` (metres), as two edges of the sheet, or as its own depth. So the sheets
/// below the two sides of a piece meet in the same points instead of crossing between them. Those
/// that `first` marks (empty: none) choose among themselves, before all others: so the ends of
/// walls stay on their lines.
void mergeNearPoints(double farthest, std::span<const uint8_t> first, HiddenSheet& sheet);

}  // namespace sherd
