// SPDX-License-Identifier: MIT
// What islands of an IslandWorld carry at rest.
#include <algorithm>

#include "core/finite.h"
#include "core/rigid_pose.h"
#include "sherd/runtime/island_world.h"

namespace sherd {

void IslandWorld::strain(uint32_t island) {
    if (island == stressed_) isStressNew_ = true;
    if (!islands_[island].isAnchored) return;
    if (std::find(strained_.begin(), strained_.end(), island) == strained_.end())
        strained_.push_back(island);
}

bool IslandWorld::setLoad(uint32_t index, const Load& load) {
    Object& object = objects_[index];
    if (load.fragment >= object.asset->fragmentCount() || !isFinite(load.force)) return false;
    std::erase_if(object.loads, [&](const Load& old) { return old.fragment == load.fragment; });
    if (load.force != glm::vec3(0.0F)) object.loads.push_back(load);
    const uint32_t leaf = object.asset->graph().leavesOf(load.fragment).first;
    const uint32_t island = findIsland(index, object.structure->fragmentAt(leaf));
    if (island != UINT32_MAX) strain(island);
    return true;
}

/// What is divided, but whole yet, is solved as its parts where the game has put a load on: it may
/// be too much for them. Without one, it stands as it was baked.
void IslandWorld::takeUp(uint32_t index) {
    const Island& island = islands_[index];
    const Object& object = objects_[island.object];
    const Asset& asset = *object.asset;
    stressedObject_ = island.object;
    if (object.loads.empty()) {
        stress_.reset(*object.structure, island.fragments, object.damage);
        return;
    }
    probe_ = *object.structure;
    parts_.clear();
    for (const uint32_t fragment : island.fragments) {
        const Range children = asset.fragment(fragment).children;
        const bool isDivided =
            children.count > 0 && asset.fragment(fragment).level < object.damage.maxLevel;
        if (isDivided) probe_->open(fragment);
        const Range stand = isDivided ? children : Range{fragment, 1};
        for (uint32_t f = 0; f < stand.count; ++f) parts_.push_back(stand.first + f);
    }
    stress_.reset(*probe_, parts_, object.damage);
    const glm::quat toObject = glm::conjugate(placesOf(index).now.rotation);
    for (const Load& load : object.loads) {
        const uint32_t leaf = asset.graph().leavesOf(load.fragment).first;
        stress_.addForce(probe_->fragmentAt(leaf), toObject * load.force,
                         asset.fragment(load.fragment).centerOfMass);
    }
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
        takeUp(stressed_);
    }
    const Island& island = islands_[stressed_];
    Object& object = objects_[island.object];
    const RigidPose place = placesOf(stressed_).now;
    stress_.setGravity(glm::conjugate(place.rotation) * gravity);
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
        event.point = place * bond.centroid;
        if (bond.b != BondGraph::kWorld) object.structure->openDownTo(bond.parting, hit_.opened);
    }
    settle(solved, island.fragments.front(), event, true);
    strain(solved);
}

float IslandWorld::overload(uint32_t object, uint32_t bond) const {
    return object == stressedObject_ ? stress_.overload(bond) : 0;
}

}  // namespace sherd
