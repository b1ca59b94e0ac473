// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "geometry/bisection.h"
#include "parallel/parallel_for.h"

namespace sherd {

/// What refineEdges does.
template <class Target>
class EdgeRefinement {
  public:
    EdgeRefinement(BisectedTriangles& mesh, Target& target, unsigned threads)
        : mesh_(mesh), target_(target), threads_(threads) {}

    void run() {
        constexpr int kMaxRounds = 60;
        const size_t parents = mesh_.nodes.size();
        even_.assign(mesh_.opposite.size(), 0);
        std::vector<uint32_t> fresh(mesh_.triangles.size());  // triangles not looked at yet
        std::iota(fresh.begin(), fresh.end(), 0U);
        for (int round = 0; round < kMaxRounds && refineOnce(fresh); ++round) {
        }
        if (mesh_.nodes.size() > parents) sortByParent(mesh_, threads_);
    }

  private:
    using Middle = typename Target::Middle;
    struct Found {
        Middle middle;
        bool isEven;
    };

    /// Whether there was something to cut; then `fresh` are the triangles it was cut into.
    bool refineOnce(std::vector<uint32_t>& fresh) {
        const auto count = static_cast<uint32_t>(mesh_.opposite.size());
        const std::vector<uint32_t> candidates = candidatesOf(fresh);
        std::vector<Found> found = middlesOf(candidates);
        std::vector<uint32_t> marks;
        std::vector<uint8_t> marked(count, 0);
        for (size_t i = 0; i < candidates.size(); ++i) {
            const uint32_t h = candidates[i], o = mesh_.opposite[h];
            if (found[i].isEven) {
                even_[h] = 1;
                if (o != BisectedTriangles::kNone) even_[o] = 1;
            } else {
                marked[h] = 1;
                marks.push_back(h);
            }
        }
        if (marks.empty()) return false;
        closeMarks(mesh_, length2_, marks, marked);
        std::vector<uint32_t> middle(count, BisectedTriangles::kNone);
        const auto add = [&](const std::vector<uint32_t>& sides, std::vector<Found>& middles) {
            for (size_t i = 0; i < sides.size(); ++i) {
                if (marked[sides[i]] == 0) continue;
                const uint32_t o = mesh_.opposite[sides[i]];
                middle[sides[i]] = target_.add(std::move(middles[i].middle));
                if (o != BisectedTriangles::kNone) middle[o] = middle[sides[i]];
            }
        };
        add(candidates, found);
        std::vector<uint32_t> more;  // marked to keep triangles in shape
        for (const uint32_t h : marks)
            if (h < mesh_.opposite[h] && middle[h] == BisectedTriangles::kNone) more.push_back(h);
        std::sort(more.begin(), more.end());
        found = middlesOf(more);
        add(more, found);
        fresh = bisect(mesh_, marked, middle, length2_, &even_);
        std::sort(fresh.begin(), fresh.end());
        return true;
    }

    /// The long edges of fresh triangles, each looked at from one of its sides.
    std::vector<uint32_t> candidatesOf(const std::vector<uint32_t>& fresh) const {
        constexpr size_t kScan = 4096;
        std::vector<uint8_t> isFresh(mesh_.triangles.size(), 0);
        for (const uint32_t t : fresh) isFresh[t] = 1;
        const auto isCandidate = [&](uint32_t h) {
            const uint32_t o = mesh_.opposite[h];
            const bool isOther = h > o && o != BisectedTriangles::kNone && isFresh[o / 3] != 0;
            return !isOther && even_[h] == 0 && target_.length2(h) > target_.shortest2();
        };
        std::vector<std::vector<uint32_t>> parts((fresh.size() + kScan - 1) / kScan);
        parallelRuns(fresh.size(), kScan, threads_, [&](size_t first, size_t last) {
            std::vector<uint32_t>& part = parts[first / kScan];
            for (size_t i = first; i < last; ++i)
                for (uint32_t h = 3 * fresh[i]; h < 3 * fresh[i] + 3; ++h)
                    if (isCandidate(h)) part.push_back(h);
        });
        std::vector<uint32_t> candidates;
        for (const std::vector<uint32_t>& part : parts)
            candidates.insert(candidates.end(), part.begin(), part.end());
        return candidates;
    }

    std::vector<Found> middlesOf(const std::vector<uint32_t>& sides) const {
        constexpr size_t kChunk = 64;
        std::vector<Found> found(sides.size());
        parallelRuns(sides.size(), kChunk, threads_, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) {
                found[i].middle = target_.middleOf(sides[i]);
                found[i].isEven = target_.isEven(sides[i], found[i].middle);
            }
        });
        return found;
    }

    BisectedTriangles& mesh_;
    Target& target_;
    unsigned threads_;
    std::vector<uint8_t> even_;  ///< per half edge: need not be cut
    const std::function<double(uint32_t)> length2_ = [this](uint32_t h) {
        return target_.length2(h);
    };
};

/// Cuts edges in their middle until all are even or short. Target says what that means, over the
/// half edges of `mesh`, which it must not change:
///
///   struct Middle;                                    what is known of an edge's middle
///   std::array<uint32_t, 2> endsOf(uint32_t) const;   the vertices of a half edge
///   double length2(uint32_t) const;                   squared; the same from both sides
///   double shortest2() const;                         edges up to this are left alone
///   Middle middleOf(uint32_t) const;                  called from several threads
///   bool isEven(uint32_t, const Middle&) const;       need not be cut; from several threads, too
///   uint32_t add(Middle&&);                           makes the vertex, returns its number
template <class Target>
void refineEdges(BisectedTriangles& mesh, Target& target, unsigned threads) {
    EdgeRefinement<Target>(mesh, target, threads).run();
}

}  // namespace sherd
