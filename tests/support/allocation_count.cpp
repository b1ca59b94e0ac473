// SPDX-License-Identifier: MIT
#include "support/allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

// What std::stable_sort takes is `nothrow`; all must match in what frees them.
namespace {

std::atomic<uint64_t> allocations{0};

}  // namespace

uint64_t sherd::test::allocationCount() {
    return allocations;
}

void* operator new(std::size_t size) {
    void* const memory = operator new(size, std::nothrow);
    if (!memory) throw std::bad_alloc();
    return memory;
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
    std::free(memory);
}
