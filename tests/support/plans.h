// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "sherd/baker/fracture_plan.h"

namespace sherd::test {

/// One drawing in UV.
inline FracturePlan planOf(FractureMap map) {
    FracturePlan plan;
    plan.drawings.push_back({std::move(map), {}});
    return plan;
}

/// Drawings in UV, a level each.
inline FracturePlan stack(std::vector<FractureMap> maps) {
    std::vector<FracturePlan> levels;
    levels.reserve(maps.size());
    for (FractureMap& map : maps) levels.push_back(planOf(std::move(map)));
    return stackLevels(std::move(levels));
}

}  // namespace sherd::test
