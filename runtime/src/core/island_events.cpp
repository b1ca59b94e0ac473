// SPDX-License-Identifier: MIT
// What an IslandWorld tells of what happened.
#include <glm/geometric.hpp>

#include "sherd/runtime/island_world.h"

namespace sherd {
namespace {

float sizeOf(const Asset::Box& box) {
    return glm::distance(box.low, box.high);
}

}  // namespace

void IslandWorld::addEvent(BreakEvent event, uint32_t index, uint32_t bodies) {
    const uint32_t object = islands_[index].object;
    event.object = idOf(object);
    const Asset& asset = *objects_[object].asset;
    event.asset = &asset.original();
    event.size = sizeOf(asset.box(event.fragment));
    event.level = hit_.level;
    event.bonds = uint32_t(hit_.bonds.size());
    event.area = hit_.area;
    event.consumed = hit_.consumed;
    event.bodies = bodies;
    event.time = time_;
    breaks_.add(event);
}

void IslandWorld::addImpact(uint32_t index, uint32_t fragment, const ReportedHit& hit) {
    const uint32_t object = islands_[index].object;
    const Asset& asset = *objects_[object].asset;
    impacts_.add({idOf(object), &asset.original(), fragment, sizeOf(asset.box(fragment)), hit.point,
                  hit.normal, hit.impulse, hit.energy, hit.speed, time_});
}

/// Of a body that was just made or changed.
void IslandWorld::addIslandEvent(const IslandBody& body, uint32_t from) {
    IslandEvent event;
    event.object = body.object;
    event.asset = &body.asset->original();
    event.fragment = body.fragments.front();
    event.fragments = uint32_t(body.fragments.size());
    event.from = from;
    event.isFixed = body.mass == 0;
    event.mass = float(islands_[body.island].mass);
    event.size = sizeOf(body.asset->boxAround(body.fragments));
    event.center = body.motion.pose.translation;
    event.velocity = body.motion.linearVelocity;
    event.time = time_;
    born_.add(event);
}

}  // namespace sherd
