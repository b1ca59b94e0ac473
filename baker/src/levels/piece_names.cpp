// SPDX-License-Identifier: MIT
#include "levels/piece_names.h"

namespace sherd {

std::vector<PieceName> namesOf(const std::vector<PlacedLabel>& labels, const LevelOrder& order,
                               const Components& components) {
    std::vector<PieceName> names;
    for (const PlacedLabel& placed : labels) {
        const uint32_t level = order.ofLabel(placed.label->level);
        if (placed.label->name.empty() || level > components.levels) continue;
        const uint32_t leaf = components.leaf[placed.triangle];
        names.push_back({level, components.at(level, leaf), placed.label->name});
    }
    return names;
}

}  // namespace sherd
