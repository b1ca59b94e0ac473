// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include "sherd/runtime/memory.h"

namespace sherd {

/// Events in the order they happened, each handed out once. Later ones than fit are dropped.
template <class Event>
class EventList {
  public:
    explicit EventList(uint32_t most) : most_(most) {}

    void add(const Event& event) {
        if (pending_.size() < most_) pending_.push_back(event);
    }
    /// Those since the last call; until the next one.
    std::span<const Event> take() {
        taken_.swap(pending_);
        pending_.clear();
        return taken_;
    }

  private:
    uint32_t most_;
    Vector<Event> pending_, taken_;
};

}  // namespace sherd
