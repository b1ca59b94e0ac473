// SPDX-License-Identifier: MIT
#include "bullet/body_pool.h"

#include <algorithm>

#include "core/report.h"

#if __has_include(<sanitizer/asan_interface.h>)
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(place, size) ((void)(place), (void)(size))
#define ASAN_UNPOISON_MEMORY_REGION(place, size) ((void)(place), (void)(size))
#endif

namespace sherd {
namespace {

/// What processors fetch at once, bytes.
constexpr size_t kLine = 64;

/// At least that many, and twice as many as before if it has to grow.
template <class List>
void makeRoom(List& list, size_t count) {
    if (list.capacity() < count) list.reserve(std::max(count, 2 * list.capacity()));
}

}  // namespace

BodyPool::BodyPool(size_t size) : size_((size + kLine - 1) / kLine * kLine) {}

BodyPool::~BodyPool() {
    (void)SHERD_ASSERT(free_.size() == count_);
    for (const Run& run : runs_) {
        ASAN_UNPOISON_MEMORY_REGION(run.first, run.bytes);
        runs_.get_allocator().memory().deallocate(run.first, run.bytes, kLine);
    }
}

void* BodyPool::take() {
    if (free_.empty()) grow();
    void* place = free_.back();
    free_.pop_back();
    ASAN_UNPOISON_MEMORY_REGION(place, size_);
    return place;
}

void BodyPool::giveBack(void* place) {
    ASAN_POISON_MEMORY_REGION(place, size_);
    free_.push_back(place);
}

void BodyPool::grow() {
    // Powers of two, which memory that is made of such gives without a rest.
    constexpr size_t kFirst = size_t{1} << 14, kMost = size_t{1} << 16;
    const size_t bytes = runs_.empty() ? kFirst : std::min(2 * runs_.back().bytes, kMost);
    const size_t count = bytes / size_;
    makeRoom(free_, count_ + count);  // giving back takes no memory
    makeRoom(runs_, runs_.size() + 1);
    auto* first = static_cast<std::byte*>(runs_.get_allocator().memory().allocate(bytes, kLine));
    runs_.push_back({first, bytes});
    for (size_t i = count; i-- > 0;) giveBack(first + i * size_);
    count_ += count;
}

}  // namespace sherd
