// SPDX-License-Identifier: MIT
// Islands of an IslandWorld that go, and assets that take others' places.
#include "core/rigid_pose.h"
#include "sherd/runtime/island_world.h"

namespace sherd {

void IslandWorld::lose(uint32_t index) {
    const uint32_t owner = islands_[index].object;
    takeOut(index);
    if (objects_[owner].islands.empty()) remove(owner);
}

bool IslandWorld::exchange(uint32_t index, std::shared_ptr<const Asset> asset) {
    Object& object = objects_[index];
    const Structure& structure = *object.structure;
    if (object.islands.size() != 1 || structure.isDamaged()) return false;
    for (uint32_t leaf = 0; leaf < structure.graph().leafCount(); ++leaf)
        if (structure.isPinned(leaf)) return false;
    const uint32_t slot = object.islands.front();
    Island& island = islands_[slot];
    const bool wasAnchored = island.isAnchored;
    BodyMotion motion = bodies_.motion(slot);
    const glm::vec3 before = motion.pose.translation;
    bodies_.beforeSplit(slot);
    object.asset = std::move(asset);
    object.structure = makePooled<Structure>(object.asset);
    island.isAnchored = object.asset->graph().isAnchored(0);
    // One that stood by the file's anchors alone falls without them.
    island.isFixed = island.isAnchored || (island.isFixed && !wasAnchored);
    island.mass = double(object.asset->fragment(0).mass);
    IslandBody body = describe(slot);
    island.frame = body.frame;
    motion.pose = placesOf(slot).now * body.frame;
    motion.linearVelocity += glm::cross(motion.angularVelocity, motion.pose.translation - before);
    body.motion = island.isFixed ? BodyMotion{motion.pose, {}, {}} : motion;
    bodies_.update(body);
    bodies_.afterSplit(slot, {&slot, 1});
    poses_.noteRegrouped(index);
    return true;
}

}  // namespace sherd
