// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "sherd/runtime/events.h"
#include "sherd/runtime/memory.h"

namespace sherd {

class IslandWorld;

/// What to draw, in one run of memory, ordered by object and then fragment. It is kept from substep
/// to substep and written only where something has moved or come apart.
class PoseList {
  public:
    void noteMoved(uint32_t object);
    /// Other fragments stand for it now, or it is new or gone.
    void noteRegrouped(uint32_t object);

    /// Until the next call that is not const.
    std::span<const FragmentPose> list(const IslandWorld& world);
    /// The runs of the list that are not what they were at the last call, ascending.
    std::span<const Range> takeChanges(const IslandWorld& world);

  private:
    void relist(const IslandWorld& world);
    void append(const IslandWorld& world, uint32_t object);
    void noteChange(size_t first, size_t end);

    Vector<FragmentPose> poses_;
    Vector<uint32_t> islandOf_;  ///< per pose
    Vector<size_t> firstOf_;     ///< per object, and the end
    uint32_t listed_ = 0;        ///< objects from here on are not listed rightly
    Vector<uint32_t> moved_;     ///< objects
    Vector<uint8_t> isMoved_;    ///< per object
    Vector<std::pair<uint32_t, uint32_t>> members_;  ///< fragment and island, of one object
    Vector<Range> changes_, taken_;
};

}  // namespace sherd
