// SPDX-License-Identifier: MIT
#include "sherd/baker/fracture_plan.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>

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

/// A level for clusters alone: it has no number of its own among lines and cuts.
bool isCluster(const FracturePlan& plan) {
    return !plan.clusters.empty() && plan.drawings.empty() && plan.patterns.empty() &&
           plan.cuts.empty();
}

/// What follows decides what clusters group: lines or cuts.
void placeClusters(std::vector<FracturePlan>& levels) {
    auto before = static_cast<uint32_t>(
        std::count_if(levels.begin(), levels.end(), [](const auto& l) { return !isCluster(l); }));
    uint32_t cuts = 0;
    for (const FracturePlan& level : levels) cuts += static_cast<uint32_t>(level.cuts.size());
    bool cutFollows = false;
    for (size_t k = levels.size(); k-- > 0;) {
        if (!isCluster(levels[k])) {
            cutFollows = !levels[k].cuts.empty();
            cuts -= static_cast<uint32_t>(levels[k].cuts.size());
            --before;
            continue;
        }
        for (FracturePlan::Grouped& group : levels[k].clusters) {
            group.lines = before;
            group.cuts = cutFollows ? std::optional(cuts) : std::nullopt;
        }
    }
}

}  // namespace

FracturePlan stackLevels(std::vector<FracturePlan> levels) {
    FracturePlan all;
    placeClusters(levels);
    const auto drawn = std::count_if(levels.begin(), levels.end(), hasLines);
    const auto lastDrawn = std::find_if(levels.rbegin(), levels.rend(), hasLines).base();
    uint32_t level = 0;  // clusters count for none
    for (auto plan = levels.begin(); plan != levels.end(); ++plan) {
        std::move(plan->clusters.begin(), plan->clusters.end(), std::back_inserter(all.clusters));
        if (isCluster(*plan)) continue;
        ++level;
        if (drawn > 1)
            changeLevels(*plan, [level](uint32_t) { return level; });
        else
            shiftLevels(*plan, level - 1);
        all.cutsBehind.insert(all.cutsBehind.end(), plan->cuts.size(),
                              plan < lastDrawn ? level : kAllLines);
        std::move(plan->drawings.begin(), plan->drawings.end(), std::back_inserter(all.drawings));
        std::move(plan->patterns.begin(), plan->patterns.end(), std::back_inserter(all.patterns));
        std::move(plan->cuts.begin(), plan->cuts.end(), std::back_inserter(all.cuts));
    }
    return all;
}

}  // namespace sherd
