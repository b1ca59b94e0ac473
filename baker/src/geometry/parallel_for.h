// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace sherd {

/// Calls work(first, last) for runs of at most `grain` items that make up [0, count), on at most
/// `threads` threads. Which thread takes which run is left to chance: runs must not depend on each
/// other, nor results on their order.
template <class Work>
void parallelRuns(size_t count, size_t grain, unsigned threads, const Work& work) {
    grain = std::max<size_t>(grain, 1);
    const size_t runs = (count + grain - 1) / grain;
    std::atomic<size_t> next{0};
    const auto take = [&] {
        for (size_t r = next++; r < runs; r = next++)
            work(r * grain, std::min(count, (r + 1) * grain));
    };
    std::vector<std::thread> others;
    for (size_t w = 1; w < std::min<size_t>(std::max(threads, 1U), runs); ++w)
        others.emplace_back(take);
    take();
    for (std::thread& other : others) other.join();
}

}  // namespace sherd
