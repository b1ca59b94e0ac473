// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory_resource>

namespace sherd::test {

/// The heap, and what is asked of it through this.
class CountingMemory final : public std::pmr::memory_resource {
  public:
    [[nodiscard]] uint64_t count() const { return count_; }  ///< of allocations
    [[nodiscard]] size_t bytes() const { return bytes_; }    ///< not given back

  private:
    void* do_allocate(size_t size, size_t alignment) override {
        ++count_;
        bytes_ += size;
        return std::pmr::new_delete_resource()->allocate(size, alignment);
    }
    void do_deallocate(void* memory, size_t size, size_t alignment) override {
        bytes_ -= size;
        std::pmr::new_delete_resource()->deallocate(memory, size, alignment);
    }
    [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override {
        return this == &other;
    }

    uint64_t count_ = 0;
    size_t bytes_ = 0;
};

}  // namespace sherd::test
