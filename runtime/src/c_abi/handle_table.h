// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace sherd::c_abi {

/// Things by numbers that stay invalid once they are: a slot, counted from 1, and its generation.
/// For all threads.
template <class T>
class HandleTable {
  public:
    /// Of the game, until it releases it.
    uint64_t add(std::shared_ptr<T> thing) {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) {
            slots_.reserve(slots_.size() + 1);
            free_.reserve(slots_.size() + 1);  // so that giving it back needs no memory
            slots_.emplace_back();
            free_.push_back(uint32_t(slots_.size() - 1));
        }
        const uint32_t index = free_.back();
        free_.pop_back();
        Slot& slot = slots_[index];
        slot.thing = std::move(thing);
        slot.isReleased = false;
        slot.holds = 0;
        return uint64_t{slot.generation} << 32 | (index + 1);
    }

    /// Null when there is no such thing any more.
    [[nodiscard]] std::shared_ptr<T> find(uint64_t id) const {
        const std::lock_guard lock(mutex_);
        const Slot* slot = slotOf(id);
        return slot ? slot->thing : nullptr;
    }

    /// The game needs it no longer; saying so twice does no harm.
    void release(uint64_t id) {
        std::shared_ptr<T> dropped;  // ends after the lock
        const std::lock_guard lock(mutex_);
        Slot* slot = const_cast<Slot*>(slotOf(id));
        if (!slot) return;
        slot->isReleased = true;
        if (slot->holds == 0) dropped = give(*slot);
    }

    /// Keeps it, and its number, beyond its release.
    void hold(uint64_t id) {
        const std::lock_guard lock(mutex_);
        if (Slot* slot = const_cast<Slot*>(slotOf(id))) ++slot->holds;
    }
    void letGo(uint64_t id) {
        std::shared_ptr<T> dropped;
        const std::lock_guard lock(mutex_);
        Slot* slot = const_cast<Slot*>(slotOf(id));
        if (slot && --slot->holds == 0 && slot->isReleased) dropped = give(*slot);
    }

  private:
    struct Slot {
        std::shared_ptr<T> thing;
        uint32_t generation = 0;
        uint32_t holds = 0;
        bool isReleased = false;
    };

    const Slot* slotOf(uint64_t id) const {
        const auto number = uint32_t(id);
        if (number == 0 || number > slots_.size()) return nullptr;
        const Slot& slot = slots_[number - 1];
        return slot.thing && slot.generation == uint32_t(id >> 32) ? &slot : nullptr;
    }
    std::shared_ptr<T> give(Slot& slot) {
        ++slot.generation;
        free_.push_back(uint32_t(&slot - slots_.data()));
        return std::move(slot.thing);
    }

    mutable std::mutex mutex_;
    std::vector<Slot> slots_;
    std::vector<uint32_t> free_;
};

}  // namespace sherd::c_abi
