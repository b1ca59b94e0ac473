// SPDX-License-Identifier: MIT
#include "bullet/released_pairs.h"

#include <algorithm>
#include <tuple>

#include "bullet/bullet_bodies.h"

namespace sherd {

void ReleasedPairs::beforeSplit(uint32_t island) {
    partners_.clear();
    ignored_.remove(bodies_.body(island), partners_);
}

/// The islands are to be tested with each other (and with what else came out of the same one), and
/// with whatever they still overlapped as one.
void ReleasedPairs::afterSplit(uint32_t parent, std::span<const uint32_t> islands) {
    uint32_t group = groupCount_;
    const auto self = std::find_if(newcomers_.begin(), newcomers_.end(),
                                   [&](const Newcomer& n) { return n.island == parent; });
    if (self == newcomers_.end()) {
        ++groupCount_;
    } else {
        group = self->group;
        newcomers_.erase(self);
    }
    for (const uint32_t island : islands) newcomers_.push_back({group, island});

    for (const btCollisionObject* partner : partners_)
        inherited_.emplace_back(parent, bodies_.islandOf(*partner));
    partners_.clear();
    const size_t count = inherited_.size();
    for (size_t i = 0; i < count; ++i) {
        const auto [a, b] = inherited_[i];
        if (a != parent && b != parent) continue;
        for (const uint32_t island : islands)
            if (island != parent) inherited_.emplace_back(island, a == parent ? b : a);
    }
}

void ReleasedPairs::addGroup(std::span<const uint32_t> islands) {
    for (const uint32_t island : islands) newcomers_.push_back({groupCount_, island});
    ++groupCount_;
}

void ReleasedPairs::forget(uint32_t island) {
    beforeSplit(island);
    std::erase_if(newcomers_, [&](const Newcomer& n) { return n.island == island; });
    std::erase_if(inherited_,
                  [&](const auto& pair) { return pair.first == island || pair.second == island; });
}

/// Sweep and prune along x inside each group, then the exact test.
void ReleasedPairs::settle() {
    struct Extent {
        uint32_t group;
        float low;
        float high;
        uint32_t island;
    };
    if (newcomers_.empty() && inherited_.empty()) return;
    std::vector<Extent> extents;
    extents.reserve(newcomers_.size());
    for (const Newcomer& newcomer : newcomers_) {
        btVector3 low;
        btVector3 high;
        bodies_.body(newcomer.island).getAabb(low, high);
        extents.push_back({newcomer.group, float(low.x()), float(high.x()), newcomer.island});
    }
    std::sort(extents.begin(), extents.end(), [](const Extent& x, const Extent& y) {
        return std::tuple(x.group, x.low, x.island) < std::tuple(y.group, y.low, y.island);
    });
    const auto test = [&](uint32_t a, uint32_t b) {
        ignored_.addIfOverlapping(bodies_.body(a), bodies_.body(b),
                                  tolerance_ * bodies_.diagonalOf(a));
    };
    for (size_t i = 0; i < extents.size(); ++i) {
        for (size_t j = i + 1; j < extents.size(); ++j) {
            const bool reach =
                extents[j].group == extents[i].group && extents[j].low <= extents[i].high;
            if (!reach) break;
            test(extents[i].island, extents[j].island);
        }
    }
    for (const auto& [a, b] : inherited_) test(a, b);
    newcomers_.clear();
    inherited_.clear();
    groupCount_ = 0;
}

}  // namespace sherd
