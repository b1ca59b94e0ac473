// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "bullet/body_motion.h"
#include "sherd/runtime/memory.h"

namespace sherd {

/// Two that come at each other, as they moved before Bullet solved their contacts.
struct Approach {
    const btCollisionObject* a;
    const btCollisionObject* b;
    int indexA, indexB;  ///< in Bullet's world
    uint32_t sequence;
    Motion motionA, motionB;
};

/// What comes at breakable bodies with enough energy to matter. Bullet asks such bodies of every
/// pair it is going to look at (OwnBody), so that where all rest nobody must read their contacts,
/// and where something strikes only that is read.
class ApproachWatch {
  public:
    /// Bullet is looking at the pair now, maybe on several threads. It is noted if it can bring
    /// `leastEnergy`, J.
    void note(const btRigidBody& own, const btCollisionObject& other, float leastEnergy);

    /// Bullet may have passed over pairs without asking.
    void miss() { sawAll_ = false; }
    /// False: contacts of the substep must be looked through.
    [[nodiscard]] bool sawAll() const { return sawAll_; }

    /// Of the substep just done; each pair once, the last seen of it.
    [[nodiscard]] std::span<const Approach> approaches();
    /// The next substep begins.
    void clear();

  private:
    bool sawAll_ = true;
    std::atomic_flag isAdding_;
    Vector<Approach> approaches_;
};

}  // namespace sherd
