// SPDX-License-Identifier: MIT
#include "bullet/body_pool.h"

#include <algorithm>

namespace sherd {
namespace {

/// What processors fetch at once, bytes.
constexpr size_t kLine = 64;

}  // namespace

BodyPool::BodyPool(size_t size) : size_((size + kLine - 1) / kLine * kLine) {}

BodyPool::~BodyPool() {
    for (const Run& run : runs_)
        runs_.get_allocator().memory().deallocate(run.bytes, run.count * size_, kLine);
}

void* BodyPool::take() {
    if (free_.empty()) grow();
    void* place = free_.back();
    free_.pop_back();
    return place;
}

void BodyPool::grow() {
    constexpr size_t kFewest = 16, kMost = 1024;
    const size_t count = std::clamp(count_, kFewest, kMost);
    free_.reserve(count_ + count);  // giving back takes no memory
    runs_.reserve(runs_.size() + 1);
    auto* bytes =
        static_cast<std::byte*>(runs_.get_allocator().memory().allocate(count * size_, kLine));
    runs_.push_back({bytes, count});
    for (size_t i = count; i-- > 0;) free_.push_back(bytes + i * size_);
    count_ += count;
}

}  // namespace sherd
