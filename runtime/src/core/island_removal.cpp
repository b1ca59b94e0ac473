// SPDX-License-Identifier: MIT
// How single islands of an IslandWorld fade and go.
#include <algorithm>
#include <glm/geometric.hpp>

#include "core/rigid_pose.h"
#include "sherd/runtime/island_world.h"

namespace sherd {

DebrisInfo IslandWorld::describePiece(uint32_t index) const {
    const Island& island = islands_[index];
    const Asset& asset = *objects_[island.object].asset;
    DebrisInfo piece;
    piece.object = idOf(island.object);
    piece.asset = &asset.original();
    piece.fragment = island.fragments.front();
    piece.level = asset.fragment(piece.fragment).level;
    piece.position = (placesOf(index).now * island.frame).translation;
    piece.mass = float(island.mass);
    const Asset::Box around = asset.boxAround(island.fragments);
    piece.size = glm::distance(around.low, around.high);
    return piece;
}

uint32_t IslandWorld::heaviestOf(uint32_t index) {
    Object& object = objects_[index];
    if (object.heaviest == UINT32_MAX && !object.islands.empty())
        object.heaviest = *std::max_element(
            object.islands.begin(), object.islands.end(),
            [this](uint32_t x, uint32_t y) { return islands_[x].mass < islands_[y].mass; });
    return object.heaviest;
}

void IslandWorld::startFading(uint32_t island, RemovalReason why) {
    islands_[island].fadingSince = time_;
    islands_[island].why = why;
    fading_.push_back(island);
    poses_.noteMoved(islands_[island].object);
}

float IslandWorld::fadeOf(const Island& island) const {
    if (!island.isFading()) return 0;
    const double faded = time_ - island.fadingSince;
    return faded < double(fade_) ? float(faded / double(fade_)) : 1.0F;
}

void IslandWorld::removeIsland(uint32_t index, RemovalReason why) {
    RemovalEvent event{describePiece(index), time_};
    event.why = why;
    removals_.add(event);
    bodies_.remove(index);
    takeOut(index);
}

/// An island without a body, and what it consists of, are no part of its object any more.
void IslandWorld::takeOut(uint32_t index) {
    Object& object = objects_[islands_[index].object];
    for (const uint32_t fragment : islands_[index].fragments) object.structure->discard(fragment);
    forgetIsland(index);
    freeIslands_.push_back(index);
    std::erase(object.islands, index);
    object.heaviest = UINT32_MAX;
    poses_.noteRegrouped(islands_[index].object);
}

}  // namespace sherd
