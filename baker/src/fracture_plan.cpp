// SPDX-License-Identifier: MIT
#include "sherd/baker/fracture_plan.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace sherd {
namespace {

constexpr uint32_t kAllLines = 0xFFFFFFFFU;

bool hasLines(const FracturePlan& plan) {
    return !plan.drawings.empty() || !plan.patterns.empty();
}

/// newLevel: from a level.
template <class NewLevel>
void changeLevels(FracturePlan& plan, const NewLevel& newLevel) {
    for (FracturePlan::Drawing& drawing : plan.drawings) {
        for (FractureMap::Line& line : drawing.map.lines) line.level = newLevel(line.level);
        for (FractureMap::SurfaceLine& line : drawing.map.surfaceLines)
            line.level = newLevel(line.level);
    }
    for (FracturePlan::Grown& grown : plan.patterns) grown.level = newLevel(grown.level);
}

/// The layers of the one plan with lines, k levels in.
void shiftLevels(FracturePlan& plan, uint32_t k) {
    changeLevels(plan, [k](uint32_t level) { return level + k; });
    for (FracturePlan::Drawing& drawing : plan.drawings)
        for (FractureMap::Label& label : drawing.map.labels)
            if (label.level > 0) label.level += k;
}

}  // namespace

FracturePlan stackLevels(std::vector<FracturePlan> levels) {
    FracturePlan all;
    const auto drawn = std::count_if(levels.begin(), levels.end(), hasLines);
    const auto lastDrawn = std::find_if(levels.rbegin(), levels.rend(), hasLines).base();
    for (size_t k = 0; k < levels.size(); ++k) {
        const auto level = static_cast<uint32_t>(k + 1);
        if (drawn > 1)
            changeLevels(levels[k], [level](uint32_t) { return level; });
        else
            shiftLevels(levels[k], level - 1);
        const bool linesFollow = levels.begin() + static_cast<ptrdiff_t>(k) < lastDrawn;
        all.cutsBehind.insert(all.cutsBehind.end(), levels[k].cuts.size(),
                              linesFollow ? level : kAllLines);
        std::move(levels[k].drawings.begin(), levels[k].drawings.end(),
                  std::back_inserter(all.drawings));
        std::move(levels[k].patterns.begin(), levels[k].patterns.end(),
                  std::back_inserter(all.patterns));
        std::move(levels[k].cuts.begin(), levels[k].cuts.end(), std::back_inserter(all.cuts));
    }
    return all;
}

}  // namespace sherd
