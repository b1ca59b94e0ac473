// SPDX-License-Identifier: MIT
// What islands of an IslandWorld carry at rest.
#include <algorithm>

#include "core/rigid_pose.h"
#include "sherd/runtime/island_world.h"

namespace sherd {

void IslandWorld::strain(uint32_t island) {
    if (island == stressed_) isStressNew_ = true;
    if (!islands_[island].isAnchored) return;
    if (std::find(strained_.begin(), strained_.end(), island) == strained_.end())
        strained_.push_back(island);
}

void IslandWorld::workOnStress(const glm::vec3& gravity, uint32_t maxIterations) {
    if (maxIterations == 0) return;
    const auto isOver = [&](uint32_t i) { return !islands_[i].isAlive || !islands_[i].isAnchored; };
    if (stressed_ == UINT32_MAX || isStressNew_ || isOver(stressed_)) {
        stressed_ = UINT32_MAX;
        isStressNew_ = false;
        while (stressed_ == UINT32_MAX && !strained_.empty()) {
            if (!isOver(strained_.front())) stressed_ = strained_.front();
            strained_.erase(strained_.begin());
        }
        if (stressed_ == UINT32_MAX) return;
        const Island& island = islands_[stressed_];
        const Object& object = objects_[island.object];
        stressedObject_ = island.object;
        stress_.reset(*object.structure, island.fragments, object.damage);
    }
    const Island& island = islands_[stressed_];
    Object& object = objects_[island.object];
    stress_.setGravity(glm::conjugate(island.pose.rotation) * gravity);
    if (!stress_.step(maxIterations)) return;

    // A crack leads the load elsewhere: the worst first, the others when it is clear what is left.
    const auto atOnce = uint32_t(1 + stress_.overloaded().size() / 8);
    hit_.clear();
    const bool breaks = breakOverloaded(*object.structure, stress_, atOnce, hit_.bonds);
    const uint32_t solved = stressed_;
    stressed_ = UINT32_MAX;
    if (!breaks) return;
    BreakEvent event;
    for (const uint32_t b : hit_.bonds) {
        const BondGraph::Bond& bond = object.structure->graph().bond(b);
        hit_.area += bond.area;
        hit_.level = std::max(hit_.level, object.asset->fragment(bond.parting).level + 1);
        event.point = island.pose * bond.centroid;
    }
    settle(solved, island.fragments.front(), event, true);
    strain(solved);
}

float IslandWorld::overload(uint32_t object, uint32_t bond) const {
    return object == stressedObject_ ? stress_.overload(bond) : 0;
}

}  // namespace sherd
