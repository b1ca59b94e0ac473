// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "bullet/body_motion.h"
#include "bullet/own_body.h"
#include "sherd/runtime/memory.h"

namespace sherd {

/// Two that come at each other, as they moved before Bullet solved their contacts.
struct Approach {
    const btCollisionObject* a;
    const btCollisionObject* b;
    int indexA, indexB;  ///< in Bullet's world
    uint32_t sequence;
    bool matters;  ///< can bring enough energy
    Motion motionA, motionB;
};

/// For moments only. Bullet may ask on several threads.
class SpinLock {
  public:
    void lock() {
        while (isTaken_.test_and_set(std::memory_order_acquire)) {
        }
    }
    void unlock() { isTaken_.clear(std::memory_order_release); }

  private:
    std::atomic_flag isTaken_;
};

/// What comes at breakable bodies with enough energy to matter. Bullet asks such bodies of every
/// pair it is going to look at (OwnBody), so that where all rest nobody must read their contacts,
/// and where something strikes only that is read.
class ApproachWatch {
  public:
    /// Bullet is looking at the pair now, maybe on several threads. It is noted if it can bring
    /// `leastEnergy`, J.
    void note(const OwnBody& own, const btCollisionObject& other, float leastEnergy) noexcept;
    /// Of what else changes something when Bullet asks.
    [[nodiscard]] SpinLock& lock() { return lock_; }

    /// Bullet may have passed over pairs without asking.
    void miss() { sawAll_ = false; }
    /// False: contacts of the substep must be looked through.
    [[nodiscard]] bool sawAll() const { return sawAll_; }

    /// Of the substep just done; each pair once, as it was seen last.
    [[nodiscard]] std::span<const Approach> approaches();
    /// The next substep begins.
    void clear();

  private:
    bool sawAll_ = true;
    uint64_t round_ = 1;
    SpinLock lock_;
    Vector<Approach> approaches_;
};

}  // namespace sherd
