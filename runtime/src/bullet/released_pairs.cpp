// SPDX-License-Identifier: MIT
#include "bullet/released_pairs.h"

#include <algorithm>
#include <tuple>

#include "bullet/bullet_bodies.h"

namespace sherd {
namespace {

constexpr uint32_t kNotReleased = UINT32_MAX;

}  // namespace

void ReleasedPairs::beforeSplit(uint32_t island) {
    partners_.clear();
    ignored_.remove(bodies_.body(island), partners_);
}

/// The islands are to be tested with each other (and with what else came out of the same one), and
/// with whatever they still overlapped as one.
void ReleasedPairs::afterSplit(uint32_t parent, std::span<const uint32_t> islands) {
    uint32_t group = groupCount_;
    bool isInPlace = true;
    const auto self = std::find_if(newcomers_.begin(), newcomers_.end(),
                                   [&](const Newcomer& n) { return n.island == parent; });
    if (self == newcomers_.end()) {
        ++groupCount_;
    } else {
        group = self->group;
        isInPlace = self->isInPlace;
        newcomers_.erase(self);
    }
    for (const uint32_t island : islands) newcomers_.push_back({group, island, isInPlace});

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
    for (const uint32_t island : islands) newcomers_.push_back({groupCount_, island, false});
    ++groupCount_;
}

void ReleasedPairs::forget(uint32_t island) {
    beforeSplit(island);
    std::erase_if(newcomers_, [&](const Newcomer& n) { return n.island == island; });
    std::erase_if(inherited_,
                  [&](const auto& pair) { return pair.first == island || pair.second == island; });
}

void ReleasedPairs::test(uint32_t a, uint32_t b) {
    ignored_.addIfOverlapping(bodies_.body(a), bodies_.body(b), tolerance_ * bodies_.diagonalOf(a));
}

void ReleasedPairs::settleInPlace(std::span<const Newcomer> group) {
    const RestOverlaps& overlaps = bodies_.restOverlapsOf(group.front().island);
    if (overlaps.areNone()) return;
    for (const Newcomer& newcomer : group)
        for (const uint32_t fragment : bodies_.fragmentsOf(newcomer.island)) {
            if (islandOf_.size() <= fragment) islandOf_.resize(fragment + 1, kNotReleased);
            islandOf_[fragment] = newcomer.island;
        }
    for (const Newcomer& newcomer : group)
        for (const uint32_t fragment : bodies_.fragmentsOf(newcomer.island))
            for (const uint32_t other : overlaps.of(fragment)) {
                if (other >= islandOf_.size()) break;
                const uint32_t partner = islandOf_[other];
                if (partner == kNotReleased || partner <= newcomer.island) continue;
                ignored_.add(bodies_.body(newcomer.island), bodies_.body(partner),
                             tolerance_ * bodies_.diagonalOf(partner));
            }
    for (const Newcomer& newcomer : group)
        for (const uint32_t fragment : bodies_.fragmentsOf(newcomer.island))
            islandOf_[fragment] = kNotReleased;
}

/// Sweep and prune along x, then the exact test.
void ReleasedPairs::settleAnywhere(std::span<const Newcomer> group) {
    struct Extent {
        float low, high;
        uint32_t island;
    };
    Vector<Extent> extents;
    extents.reserve(group.size());
    for (const Newcomer& newcomer : group) {
        btVector3 low, high;
        bodies_.body(newcomer.island).getAabb(low, high);
        extents.push_back({float(low.x()), float(high.x()), newcomer.island});
    }
    std::sort(extents.begin(), extents.end(), [](const Extent& x, const Extent& y) {
        return std::tuple(x.low, x.island) < std::tuple(y.low, y.island);
    });
    for (size_t i = 0; i < extents.size(); ++i)
        for (size_t j = i + 1; j < extents.size() && extents[j].low <= extents[i].high; ++j)
            test(extents[i].island, extents[j].island);
}

void ReleasedPairs::settle() {
    std::sort(newcomers_.begin(), newcomers_.end(), [](const Newcomer& x, const Newcomer& y) {
        return std::pair(x.group, x.island) < std::pair(y.group, y.island);
    });
    for (size_t first = 0; first < newcomers_.size();) {
        size_t end = first;
        while (end < newcomers_.size() && newcomers_[end].group == newcomers_[first].group) ++end;
        const auto group = std::span(newcomers_).subspan(first, end - first);
        if (group.front().isInPlace) {
            settleInPlace(group);
        } else {
            settleAnywhere(group);
        }
        first = end;
    }
    for (const auto& [a, b] : inherited_) test(a, b);
    newcomers_.clear();
    inherited_.clear();
    groupCount_ = 0;
}

}  // namespace sherd
