// SPDX-License-Identifier: MIT
#include "measures/self_intersections.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "geometry/triangle_crossing.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

constexpr uint64_t kMostPairsOfLeaf = uint64_t{1} << 20;
/// The bound is looked at between rounds, so that where the search ends is not left to chance.
constexpr size_t kLeavesPerRound = 256;
constexpr size_t kLeavesPerRun = 16;

}  // namespace

SelfIntersections selfIntersections(const ShownTriangles& shown, const BoxTree& tree,
                                    const SelfIntersectionOptions& options) {
    const size_t fragments = shown.set().fragments.size();
    // Small sets are done before the bound matters.
    const uint64_t mostPairs = options.pairsPerTriangle * (shown.triangles().size() + 1000);
    std::vector<std::atomic<uint64_t>> counts(fragments);
    std::atomic<uint64_t> looked{0};
    std::atomic<bool> complete{true};
    const auto search = [&](size_t leaf) {
        std::optional<CrossingTest> test;
        uint32_t tested = 0;
        const uint64_t pairs = tree.pairsOf(leaf, kMostPairsOfLeaf, [&](uint32_t a, uint32_t b) {
            if (!shown.shownTogether(a, b)) return;
            if (!test || tested != a) test.emplace(shown.places(a));
            tested = a;
            if (!test->crosses(shown.places(b))) return;
            shown.forEachShowing(a, b, [&](uint32_t f) { ++counts[f]; });
        });
        looked += pairs;
        if (pairs > kMostPairsOfLeaf) complete = false;
    };
    SelfIntersections result;
    for (size_t first = 0; first < tree.leafCount(); first += kLeavesPerRound) {
        if (looked > mostPairs) {
            complete = false;
            break;
        }
        const size_t count = std::min(kLeavesPerRound, tree.leafCount() - first);
        parallelRuns(count, kLeavesPerRun, options.threads, [&](size_t begin, size_t end) {
            for (size_t leaf = begin; leaf < end; ++leaf) search(first + leaf);
        });
    }
    result.complete = complete;
    result.ofFragment.assign(counts.begin(), counts.end());
    return result;
}

}  // namespace sherd
