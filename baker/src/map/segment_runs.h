// SPDX-License-Identifier: MIT
// From drawn lines to supports: snapped, and what overlaps on one straight line put together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "map/planar_map.h"

namespace sherd {

/// A stretch of a run, covered by the same lines throughout.
struct RunPiece {
    GridPoint from, to;
    uint32_t level = 1;  ///< the coarsest level of the lines that cover it
    uint32_t line = 0;   ///< the first line of that level
};

/// Collinear segments that overlap or touch, as one support and its pieces. Two runs on one line
/// share no point.
struct SegmentRun {
    Support support;
    uint32_t firstPiece = 0;
    uint32_t pieceCount = 0;
};

struct SegmentRuns {
    std::vector<SegmentRun> runs;  ///< sorted by support
    std::vector<RunPiece> pieces;  ///< in order from a to b; each one's end is the next one's start
    std::vector<std::string> warnings;
};

Result<SegmentRuns> collectRuns(const FractureMap& map);

}  // namespace sherd
