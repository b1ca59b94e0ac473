// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory_resource>

namespace sherd {

/// Where a world's memory comes from. It keeps what is given back, large lists too, for what comes
/// next. Small things are taken many at once, so that they lie together, and what others take
/// meanwhile does, too; large ones few at once, or most of it would never be used.
class WorldMemory final : public std::pmr::memory_resource {
  public:
    explicit WorldMemory(std::pmr::memory_resource* upstream)
        : small_(kSmall, upstream), large_(kLarge, upstream) {}

  private:
    static constexpr std::pmr::pool_options kSmall{64, 512};
    static constexpr std::pmr::pool_options kLarge{4, size_t{1} << 22};

    [[nodiscard]] std::pmr::memory_resource& poolFor(size_t size) {
        if (size <= kSmall.largest_required_pool_block) return small_;
        return large_;
    }
    void* do_allocate(size_t size, size_t alignment) override {
        return poolFor(size).allocate(size, alignment);
    }
    void do_deallocate(void* memory, size_t size, size_t alignment) override {
        poolFor(size).deallocate(memory, size, alignment);
    }
    [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override {
        return this == &other;
    }

    std::pmr::unsynchronized_pool_resource small_, large_;
};

}  // namespace sherd
