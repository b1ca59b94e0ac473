// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "bullet/overlaps.h"
#include "sherd/runtime/memory.h"

namespace sherd {

class BulletBodies;

/// Finds out which of the islands released together overlap, so that they ignore each other until
/// they are apart. Those that came out of one body lie as they do in their object, where it is
/// known what overlaps.
class ReleasedPairs {
  public:
    /// `tolerance`: share of the object's diagonal that counts as touching.
    ReleasedPairs(BulletBodies& bodies, float tolerance) : bodies_(bodies), tolerance_(tolerance) {}

    void beforeSplit(uint32_t island);
    void afterSplit(uint32_t parent, std::span<const uint32_t> islands);
    /// Bodies that were put into the world at once.
    void addGroup(std::span<const uint32_t> islands);
    void forget(uint32_t island);
    /// Takes up all that was released since the last call.
    void settle();

    /// Lets pairs that came apart collide again.
    void releaseSeparated() { ignored_.releaseSeparated(); }
    [[nodiscard]] size_t ignoredCount() const { return ignored_.size(); }

  private:
    BulletBodies& bodies_;
    float tolerance_;
    IgnoredPairs ignored_;
    struct Newcomer {
        uint32_t group;  ///< all that came out of one body since the last `settle`
        uint32_t island;
        bool isInPlace;  ///< where its object has it, seen from the others of the group
    };
    void settleInPlace(std::span<const Newcomer> group);
    void settleAnywhere(std::span<const Newcomer> group);
    void test(uint32_t a, uint32_t b);

    Vector<Newcomer> newcomers_;
    Vector<uint32_t> islandOf_;  ///< per fragment, of the group just looked at
    uint32_t groupCount_ = 0;
    Vector<std::pair<uint32_t, uint32_t>> inherited_;  ///< overlapped as parts of others
    Vector<btCollisionObject*> partners_;
};

}  // namespace sherd
