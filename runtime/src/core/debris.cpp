// SPDX-License-Identifier: MIT
#include "core/debris.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace sherd {
namespace {

constexpr uint32_t kAtOnce = 64;    // looked at in a substep at least,
constexpr uint32_t kSubsteps = 30;  // and all of them once in so many

}  // namespace

bool Debris::mayFade(IslandWorld& islands, uint32_t index) const {
    const IslandWorld::Island& island = islands.island(index);
    if (island.fragments.front() == 0 || island.isFixed || island.isAnchored) return false;
    const bool isOld =
        islands.time() - std::max(island.bornAt, island.keptAt) >= double(options_.lifetime);
    if (!isOld && !(viewer_ && std::isfinite(options_.distance))) return false;
    DebrisInfo piece = islands.describePiece(index);
    const bool isFar = viewer_ && glm::distance(piece.position, *viewer_) > options_.distance;
    if (!isOld && !isFar) return false;
    piece.why = isFar ? RemovalReason::distance : RemovalReason::age;
    if (piece.size > options_.maxSize || piece.size > options_.maxShare * piece.asset->diagonal())
        return false;
    if (!options_.largestToo && islands.heaviestOf(island.object) == index) return false;
    if (!options_.mayGo || options_.mayGo(piece)) {
        islands.startFading(index, piece.why);
        return true;
    }
    islands.keep(index);
    return false;
}

void Debris::step(IslandWorld& islands) {
    if (!std::isfinite(options_.lifetime) && !std::isfinite(options_.distance)) return;
    const auto count = uint32_t(islands.islands().size());
    uint32_t removals = std::max(options_.maxRemovalsPerStep, 1U);
    for (uint32_t n = std::min(count, std::max(kAtOnce, count / kSubsteps + 1)); n > 0; --n) {
        next_ = next_ + 1 < count ? next_ + 1 : 0;
        if (!islands.island(next_).isAlive) continue;
        if (!islands.island(next_).isFading() && !mayFade(islands, next_)) continue;
        if (removals == 0) continue;
        const double faded = islands.time() - islands.island(next_).fadingSince;
        if (faded < double(options_.fade)) continue;
        islands.removeIsland(next_, islands.island(next_).why);
        --removals;
    }
}

}  // namespace sherd
