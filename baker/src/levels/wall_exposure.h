// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "levels/piece_model.h"

namespace sherd {

/// The levels that stand where one level stood, coarse to fine.
struct LevelSpan {
    uint32_t first = 0, last = 0;
};

/// After levels were added in between: spans[e] is where level e went, and what was put before it.
/// Of what faces showed from level e on, walls between pieces that are together at some of the new
/// levels show only from where these are apart; all other faces from the first. A coarser piece is
/// so the sum of its leaves less what cancels out in pairs, and closed as they are.
void exposeBetween(const std::vector<LevelSpan>& spans, const PieceModel& model);

}  // namespace sherd
