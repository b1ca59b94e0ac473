// SPDX-License-Identifier: MIT
// What breaks the islands of an IslandWorld.
#include <limits>

#include "core/rigid_pose.h"
#include "sherd/runtime/island_world.h"

namespace sherd {

bool IslandWorld::canTakeDamage(uint32_t index, float energy, float impulse) const {
    const Island& island = islands_[index];
    const Object& object = objects_[island.object];
    const DamageOptions& damage = object.damage;
    if (energy < damage.minimumEnergy || impulse < damage.minimumImpulse ||
        time_ - island.bornAt < double(damage.immunity))
        return false;
    return isBreakable(index);
}

bool IslandWorld::isBreakable(uint32_t index) const {
    const Island& island = islands_[index];
    const Object& object = objects_[island.object];
    if (object.damage.maxLevel == 0) return false;
    return island.fragments.size() > 1 || island.isAnchored ||
           sherd::isBreakable(*object.asset, island.fragments.front(), object.damage);
}

/// The island's fragment whose colliders' box is nearest to a point of the object's frame.
uint32_t IslandWorld::fragmentNear(uint32_t index, const glm::vec3& point) const {
    const Island& island = islands_[index];
    const Asset& asset = *objects_[island.object].asset;
    uint32_t nearest = island.fragments.front();
    float least = HUGE_VALF;
    for (const uint32_t fragment : island.fragments) {
        const float off = Asset::distance(asset.box(fragment), point);
        if (!(off < least)) continue;
        least = off;
        nearest = fragment;
    }
    return nearest;
}

const HitResult& IslandWorld::strike(uint32_t index, uint32_t fragment, const glm::vec3& point,
                                     float energy, float approachSpeed) {
    const Object& object = objects_[islands_[index].object];
    const RigidPose objectToWorld = bodies_.motion(index).pose * inverse(islands_[index].frame);
    Hit hit;
    hit.point = inverse(objectToWorld) * point;
    hit.fragment = object.structure->stands(fragment) ? fragment : fragmentNear(index, hit.point);
    hit.energy = energy;
    hit.stress = contactStress(*object.asset, fragment, approachSpeed);
    solver_.apply(*object.structure, hit, object.damage, hit_);
    return hit_;
}

/// What `hit_` has broken comes apart.
void IslandWorld::settle(uint32_t island, uint32_t fragment, BreakEvent event, bool isLimited) {
    event.fragment = fragment;
    regroup(island, isLimited);
    (void)split(island, event);
}

float IslandWorld::takeHit(uint32_t island, uint32_t fragment, const ReportedHit& hit) {
    if (!canTakeDamage(island, hit.energy, hit.impulse)) return 0;
    const float consumed = strike(island, fragment, hit.point, hit.energy, hit.speed).consumed;
    BreakEvent event;
    event.point = hit.point;
    event.normal = hit.normal;
    event.impulse = hit.impulse;
    event.energy = hit.energy;
    event.approachSpeed = hit.speed;
    settle(island, fragment, event, true);
    return consumed;
}

/// Damage in the object's frame to one island; `point` of the world is for the event.
uint32_t IslandWorld::dealTo(uint32_t index, const AreaDamage& damage, const glm::vec3& point,
                             bool isLimited) {
    const Object& object = objects_[islands_[index].object];
    applyArea(*object.structure, islands_[index].fragments, damage, object.damage, hit_);
    BreakEvent event;
    event.point = point;
    event.energy = hit_.consumed;
    event.fragment = islands_[index].fragments.front();
    regroup(index, isLimited);
    const auto broken = uint32_t(hit_.bonds.size());
    (void)split(index, event);
    return broken;
}

uint32_t IslandWorld::dealArea(uint32_t objectIndex, const AreaDamage& damage) {
    uint32_t broken = 0;
    const Vector<uint32_t> islands = objects_[objectIndex].islands;
    for (const uint32_t index : islands) {
        const RigidPose objectToWorld = bodies_.motion(index).pose * inverse(islands_[index].frame);
        broken += dealTo(index, seenFrom(objectToWorld, damage), damage.a, true);
    }
    return broken;
}

bool IslandWorld::breakFragment(uint32_t object, uint32_t fragment, bool whole) {
    const uint32_t island = findIsland(object, fragment);
    if (island == UINT32_MAX) return false;
    if (!whole && objects_[object].asset->fragment(fragment).children.count == 0) return false;
    shatter(*objects_[object].structure, fragment, whole, hit_);
    settle(island, fragment, {}, false);
    return true;
}

void IslandWorld::breakAll(uint32_t object) {
    AreaDamage everything;
    everything.fluence = std::numeric_limits<float>::infinity();
    everything.radius = std::numeric_limits<float>::max();
    everything.falloff = 0;
    // In its own frame: seen from the world an object may be too far away for any radius.
    const Vector<uint32_t> islands = objects_[object].islands;
    for (const uint32_t island : islands)
        dealTo(island, everything, placesOf(island).now.translation, false);
}

void IslandWorld::pin(uint32_t index, std::span<const uint32_t> leaves, bool pinned) {
    for (const uint32_t leaf : leaves) objects_[index].structure->pin(leaf, pinned);
    hit_.clear();
    const Vector<uint32_t> islands = objects_[index].islands;
    for (const uint32_t island : islands) settle(island, 0, {}, false);
}

bool IslandWorld::pinFragment(uint32_t object, uint32_t fragment, bool pinned) {
    if (findIsland(object, fragment) == UINT32_MAX) return false;
    const Range leaves = objects_[object].structure->graph().leavesOf(fragment);
    Vector<uint32_t> list;
    for (uint32_t l = 0; l < leaves.count; ++l) list.push_back(leaves.first + l);
    pin(object, list, pinned);
    return true;
}

}  // namespace sherd
