// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <type_traits>
#include <utility>
#include <vector>

namespace sherd {

/// Where containers that are made now, on this thread, get their memory from: the heap, or what the
/// innermost MemoryScope says.
std::pmr::memory_resource& currentMemory();

/// While it lives, containers made on this thread get their memory from `memory`, which must
/// outlive them; they go on doing so ever after.
class MemoryScope {
  public:
    explicit MemoryScope(std::pmr::memory_resource& memory);
    ~MemoryScope();
    MemoryScope(const MemoryScope&) = delete;
    MemoryScope& operator=(const MemoryScope&) = delete;

  private:
    std::pmr::memory_resource* before_;
};

/// An allocator that needs no mention where containers lie in containers: it takes what is current
/// when a container is made.
template <class T>
class Allocator {
  public:
    using value_type = T;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;

    Allocator() : memory_(&currentMemory()) {}
    template <class U>
    // NOLINTNEXTLINE(google-explicit-constructor): containers convert it for what they hold
    Allocator(const Allocator<U>& other) : memory_(&other.memory()) {}

    T* allocate(size_t count) {
        return std::pmr::polymorphic_allocator<T>(memory_).allocate(count);
    }
    void deallocate(T* items, size_t count) {
        std::pmr::polymorphic_allocator<T>(memory_).deallocate(items, count);
    }
    /// A copy is a container made now.
    [[nodiscard]] Allocator select_on_container_copy_construction() const { return {}; }

    [[nodiscard]] std::pmr::memory_resource& memory() const { return *memory_; }
    friend bool operator==(const Allocator& a, const Allocator& b) {
        return a.memory_ == b.memory_;
    }

  private:
    std::pmr::memory_resource* memory_;
};

/// Gives back what `makePooled` took.
template <class T>
struct PooledDelete {
    std::pmr::memory_resource* memory = nullptr;
    void operator()(T* thing) const {
        std::pmr::polymorphic_allocator<T>(memory).delete_object(thing);
    }
};
template <class T>
using Pooled = std::unique_ptr<T, PooledDelete<T>>;

/// One thing in what is current memory now.
template <class T, class... Arguments>
Pooled<T> makePooled(Arguments&&... arguments) {
    std::pmr::memory_resource* memory = &currentMemory();
    T* thing = std::pmr::polymorphic_allocator<T>(memory).template new_object<T>(
        std::forward<Arguments>(arguments)...);
    return Pooled<T>(thing, PooledDelete<T>{memory});
}

template <class T>
using Vector = std::vector<T, Allocator<T>>;

}  // namespace sherd
