// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>

#include "parallel/workers.h"

namespace sherd {

/// Calls share() here and at the same time on up to `others` workers.
template <class Share>
void shareWork(unsigned others, const Share& share) {
    if (others == 0) {
        share();
        return;
    }
    const void* context = &share;
    Workers::Job job([](void* self) { (*static_cast<const Share*>(self))(); },
                     const_cast<void*>(context));
    Workers::shared().run(job, others);
}

/// Calls work(first, last) for runs of at most `grain` items that make up [0, count), on at most
/// `threads` threads. Which thread takes which run is left to chance: runs must not depend on each
/// other, nor results on their order.
template <class Work>
void parallelRuns(size_t count, size_t grain, unsigned threads, const Work& work) {
    grain = std::max<size_t>(grain, 1);
    const size_t runs = (count + grain - 1) / grain;
    if (runs == 0) return;
    std::atomic<size_t> next{0};
    const size_t useful = std::min<size_t>(std::max(threads, 1U), runs);
    shareWork(static_cast<unsigned>(useful - 1), [&] {
        for (size_t r = next++; r < runs; r = next++)
            work(r * grain, std::min(count, (r + 1) * grain));
    });
}

/// Calls all of `tasks`, each once, on at most `threads` threads. The caller begins with the first
/// one, workers with the last: a task that is parallel by itself should be the first.
template <class... Tasks>
void parallelTasks(unsigned threads, const Tasks&... tasks) {
    constexpr size_t kCount = sizeof...(Tasks);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<int> left{static_cast<int>(kCount)};
    size_t front = 0;
    std::atomic<size_t> back{kCount};
    const size_t useful = std::min<size_t>(std::max(threads, 1U), kCount);
    shareWork(static_cast<unsigned>(useful - 1), [&] {
        while (left-- > 0) {
            const size_t chosen = std::this_thread::get_id() == caller ? front++ : --back;
            size_t i = 0;
            ((i++ == chosen ? tasks() : void()), ...);
        }
    });
}

}  // namespace sherd
