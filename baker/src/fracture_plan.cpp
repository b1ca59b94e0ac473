// SPDX-License-Identifier: MIT
#include "sherd/baker/fracture_plan.h"

#include <iterator>

namespace sherd {
namespace {

void setLevel(FracturePlan& plan, uint32_t level) {
    for (FracturePlan::Drawing& drawing : plan.drawings) {
        for (FractureMap::Line& line : drawing.map.lines) line.level = level;
        for (FractureMap::SurfaceLine& line : drawing.map.surfaceLines) line.level = level;
    }
    for (FracturePlan::Grown& grown : plan.patterns) grown.level = level;
}

}  // namespace

FracturePlan stackLevels(std::vector<FracturePlan> levels) {
    FracturePlan all;
    for (size_t k = 0; k < levels.size(); ++k) {
        if (levels.size() > 1) setLevel(levels[k], static_cast<uint32_t>(k + 1));
        std::move(levels[k].drawings.begin(), levels[k].drawings.end(),
                  std::back_inserter(all.drawings));
        std::move(levels[k].patterns.begin(), levels[k].patterns.end(),
                  std::back_inserter(all.patterns));
        std::move(levels[k].cuts.begin(), levels[k].cuts.end(), std::back_inserter(all.cuts));
    }
    return all;
}

}  // namespace sherd
