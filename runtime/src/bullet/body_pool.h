// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "sherd/runtime/memory.h"

namespace sherd {

/// Memory for bodies, which lie one behind the other: Bullet goes over all of them many times a
/// step, and a processor fetches ahead only what comes at even distances. What is given back is
/// kept for the next; an address sanitizer sees whoever still looks at it.
class BodyPool {
  public:
    /// For bodies of `size` bytes, from what is current memory now.
    explicit BodyPool(size_t size);
    /// Everything has been given back.
    ~BodyPool();
    BodyPool(const BodyPool&) = delete;
    BodyPool& operator=(const BodyPool&) = delete;

    [[nodiscard]] void* take();
    void giveBack(void* place);

  private:
    struct Run {
        std::byte* first;
        size_t bytes;
    };

    void grow();

    size_t size_;
    size_t count_ = 0;  ///< of bodies, free or not
    Vector<Run> runs_;
    Vector<void*> free_;  ///< the next is the last
};

}  // namespace sherd
