// SPDX-License-Identifier: MIT
#include "sherd/baker/fracture_plan.h"

#include <algorithm>
#include <iterator>
#include <optional>

namespace sherd {
namespace {

void setLevel(FracturePlan& plan, uint32_t level) {
    for (FracturePlan::Drawing& drawing : plan.drawings) {
        for (FractureMap::Line& line : drawing.map.lines) line.level = level;
        for (FractureMap::SurfaceLine& line : drawing.map.surfaceLines) line.level = level;
    }
    for (FracturePlan::Grown& grown : plan.patterns) grown.level = level;
}

/// A level for clusters alone: it has no number of its own among lines and cuts.
bool isCluster(const FracturePlan& plan) {
    return !plan.clusters.empty() && plan.drawings.empty() && plan.patterns.empty() &&
           plan.cuts.empty();
}

/// What follows decides what clusters group: lines or cuts.
void placeClusters(std::vector<FracturePlan>& levels) {
    uint32_t lines = 0, cuts = 0;
    for (const FracturePlan& level : levels) {
        lines += isCluster(level) || !level.cuts.empty() ? 0 : 1;
        cuts += level.cuts.empty() ? 0 : 1;
    }
    bool cutFollows = false;
    for (size_t k = levels.size(); k-- > 0;) {
        if (!isCluster(levels[k])) {
            cutFollows = !levels[k].cuts.empty();
            (cutFollows ? cuts : lines) -= 1;
            continue;
        }
        for (FracturePlan::Grouped& group : levels[k].clusters) {
            group.lines = lines;
            group.cuts = cutFollows ? std::optional(cuts) : std::nullopt;
        }
    }
}

}  // namespace

FracturePlan stackLevels(std::vector<FracturePlan> levels) {
    FracturePlan all;
    placeClusters(levels);
    const auto counted = static_cast<size_t>(
        std::count_if(levels.begin(), levels.end(), [](const auto& l) { return !isCluster(l); }));
    uint32_t level = 0;
    for (FracturePlan& plan : levels) {
        if (!isCluster(plan) && counted > 1) setLevel(plan, ++level);
        std::move(plan.clusters.begin(), plan.clusters.end(), std::back_inserter(all.clusters));
        std::move(plan.drawings.begin(), plan.drawings.end(), std::back_inserter(all.drawings));
        std::move(plan.patterns.begin(), plan.patterns.end(), std::back_inserter(all.patterns));
        std::move(plan.cuts.begin(), plan.cuts.end(), std::back_inserter(all.cuts));
    }
    return all;
}

}  // namespace sherd
