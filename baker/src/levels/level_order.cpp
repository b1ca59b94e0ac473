// SPDX-License-Identifier: MIT
#include "levels/level_order.h"

#include <algorithm>

namespace sherd {
namespace {

constexpr uint32_t kAllLines = 0xFFFFFFFFU;

bool hasLinesOf(const FracturePlan::Drawing& drawing, uint32_t asked) {
    const auto isHere = [asked](const auto& line) { return line.level == asked; };
    const FractureMap& map = drawing.map;
    return std::any_of(map.lines.begin(), map.lines.end(), isHere) ||
           std::any_of(map.surfaceLines.begin(), map.surfaceLines.end(), isHere);
}

/// What the first source of a level that chooses pieces says, and where the first of all is said.
OrderedLevel drawnLevel(const FracturePlan& plan, uint32_t drawn, uint32_t asked) {
    OrderedLevel level{drawn, nullptr, nullptr, {}, asked};
    const auto take = [&](const PieceChoice& only, const std::string& where) {
        if (level.where.empty()) level.where = where;
        if (level.only == nullptr && !only.all()) level.only = &only;
    };
    for (const FracturePlan::Drawing& drawing : plan.drawings)
        if (hasLinesOf(drawing, asked)) take(drawing.only, drawing.where);
    for (const FracturePlan::Grown& grown : plan.patterns)
        if (grown.level == asked) take(grown.only, grown.where);
    return level;
}

}  // namespace

LevelOrder::LevelOrder(const FracturePlan& plan, const LineTable& lines) {
    uint32_t drawn = 0;
    const auto addLines = [&](uint32_t upTo) {
        while (drawn < upTo) {
            ++drawn;
            levels_.push_back(drawnLevel(plan, drawn, lines.asked(drawn)));
        }
    };
    for (size_t c = 0; c < plan.cuts.size(); ++c) {
        const uint32_t behind = c < plan.cutsBehind.size() ? plan.cutsBehind[c] : kAllLines;
        addLines(lines.closedUp(behind));
        levels_.push_back({0, &plan.cuts[c], nullptr, {}, behind});
    }
    addLines(lines.levels());
}

uint32_t LevelOrder::plainLevels() const {
    const auto other = std::find_if(levels_.begin(), levels_.end(), [](const OrderedLevel& level) {
        return level.cut != nullptr || level.only != nullptr;
    });
    return static_cast<uint32_t>(other - levels_.begin());
}

uint32_t LevelOrder::above(const FracturePlan::Grouped& group) const {
    uint32_t cuts = 0;
    const auto next = std::find_if(levels_.begin(), levels_.end(), [&](const OrderedLevel& level) {
        if (level.cut == nullptr) return !group.cuts && level.asked > group.lines;
        return cuts++ == group.cuts;
    });
    return static_cast<uint32_t>(next - levels_.begin());
}

uint32_t LevelOrder::ofDrawn(uint32_t drawn) const {
    if (drawn == 0) return 0;
    const auto it =
        std::find_if(levels_.begin(), levels_.end(),
                     [drawn](const OrderedLevel& level) { return level.drawn == drawn; });
    return static_cast<uint32_t>(it - levels_.begin()) + 1;
}

uint32_t LevelOrder::ofLabel(uint32_t asked) const {
    uint32_t level = 0;
    for (uint32_t k = 0; k < levels_.size(); ++k)
        if (asked == 0 ? levels_[k].cut == nullptr : levels_[k].asked <= asked) level = k + 1;
    return level;
}

}  // namespace sherd
