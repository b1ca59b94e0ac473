// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "assembly/labels.h"
#include "levels/level_order.h"
#include "levels/piece_choice.h"
#include "surface/components.h"

namespace sherd {

/// The pieces that labels name, as far as their levels are there.
std::vector<PieceName> namesOf(const std::vector<PlacedLabel>& labels, const LevelOrder& order,
                               const Components& components);

}  // namespace sherd
