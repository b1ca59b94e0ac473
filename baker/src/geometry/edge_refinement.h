// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <unordered_set>
#include <vector>

#include "geometry/bisection.h"
#include "geometry/parallel_for.h"

namespace sherd {

/// Cuts edges in their middle until all are even or short. Target says what that means, over the
/// half edges of `mesh`, which it must not change:
///
///   struct Middle;                                    what is known of an edge's middle
///   std::array<uint32_t, 2> endsOf(uint32_t) const;   the vertices of a half edge
///   double length2(uint32_t) const;                   squared; the same from both sides
///   double shortest2() const;                         edges up to this are left alone
///   Middle middleOf(uint32_t) const;                  called from several threads
///   bool isEven(uint32_t, const Middle&) const;       need not be cut
///   uint32_t add(Middle&&);                           makes the vertex, returns its number
template <class Target>
void refineEdges(BisectedTriangles& mesh, Target& target, unsigned threads) {
    using Middle = typename Target::Middle;
    constexpr int kMaxRounds = 60;
    constexpr size_t kChunk = 64, kScan = 4096;
    const size_t parents = mesh.nodes.size();
    const std::function<double(uint32_t)> length2 = [&](uint32_t h) { return target.length2(h); };
    const auto key = [&](uint32_t h) {
        const auto [a, b] = target.endsOf(h);
        return static_cast<uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
    };
    // Each edge is looked at from one of its sides.
    const auto isFirst = [&](uint32_t h) { return h < mesh.opposite[h]; };
    std::unordered_set<uint64_t> even;
    std::vector<uint32_t> fresh(mesh.triangles.size());  // triangles not looked at yet
    std::iota(fresh.begin(), fresh.end(), 0U);
    for (int round = 0; round < kMaxRounds; ++round) {
        const auto count = static_cast<uint32_t>(mesh.opposite.size());
        std::vector<uint8_t> isFresh(mesh.triangles.size(), 0), marked(count, 0);
        for (const uint32_t t : fresh) isFresh[t] = 1;
        const auto isCandidate = [&](uint32_t h) {
            const uint32_t o = mesh.opposite[h];
            const bool isOther = h > o && o != BisectedTriangles::kNone && isFresh[o / 3] != 0;
            return !isOther && target.length2(h) > target.shortest2() && !even.contains(key(h));
        };
        parallelRuns(fresh.size(), kScan, threads, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) {
                for (uint32_t h = 3 * fresh[i]; h < 3 * fresh[i] + 3; ++h)
                    marked[h] = isCandidate(h) ? 1 : 0;
            }
        });
        std::vector<uint32_t> candidates;
        for (uint32_t h = 0; h < count; ++h)
            if (marked[h] != 0) candidates.push_back(h);
        if (candidates.empty()) break;
        const auto middlesOf = [&](const std::vector<uint32_t>& sides) {
            std::vector<Middle> middles(sides.size());
            parallelRuns(sides.size(), kChunk, threads, [&](size_t first, size_t last) {
                for (size_t i = first; i < last; ++i) middles[i] = target.middleOf(sides[i]);
            });
            return middles;
        };
        std::vector<Middle> middles = middlesOf(candidates);
        bool any = false;
        even.reserve(even.size() + candidates.size());
        for (size_t i = 0; i < candidates.size(); ++i) {
            if (target.isEven(candidates[i], middles[i])) {
                even.insert(key(candidates[i]));
                marked[candidates[i]] = 0;
            } else {
                any = true;
            }
        }
        if (!any) break;
        closeMarks(mesh, length2, marked);
        std::vector<uint32_t> middle(count, BisectedTriangles::kNone);
        const auto add = [&](const std::vector<uint32_t>& sides, std::vector<Middle>& found) {
            for (size_t i = 0; i < sides.size(); ++i) {
                if (marked[sides[i]] == 0) continue;
                const uint32_t o = mesh.opposite[sides[i]];
                middle[sides[i]] = target.add(std::move(found[i]));
                if (o != BisectedTriangles::kNone) middle[o] = middle[sides[i]];
            }
        };
        add(candidates, middles);
        std::vector<uint32_t> more;  // marked to keep triangles in shape
        for (uint32_t h = 0; h < count; ++h)
            if (marked[h] != 0 && isFirst(h) && middle[h] == BisectedTriangles::kNone)
                more.push_back(h);
        middles = middlesOf(more);
        add(more, middles);
        fresh = bisect(mesh, marked, middle, length2);
    }
    if (mesh.nodes.size() > parents) sortByParent(mesh);
}

}  // namespace sherd
