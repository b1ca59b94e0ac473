// SPDX-License-Identifier: MIT
#include "sherd/runtime/structure.h"

#include <algorithm>

namespace sherd {
namespace {

constexpr float kAlmostAll = 1 - 0x1p-20F;  // that a bond can lose without breaking

}  // namespace

void Structure::prepare() {
    if (!lost_.empty()) return;
    standing_.assign(graph().leafCount(), 0);
    lost_.assign(std::max<size_t>(graph().bonds().size(), 1), 0.0F);
}

void Structure::weaken(uint32_t bond, float share) {
    prepare();
    if (!(lost_[bond] < kAlmostAll)) return;
    lost_[bond] = std::min(lost_[bond] + share, kAlmostAll);
}

void Structure::breakBond(uint32_t bond) {
    prepare();
    lost_[bond] = 1;
}

void Structure::hold(uint32_t bond) {
    if (isBroken(bond)) lost_[bond] = kAlmostAll;
}

void Structure::strengthen(uint32_t bond, float share) {
    if (isDamaged() && !isBroken(bond)) lost_[bond] = std::max(lost_[bond] - share, 0.0F);
}

void Structure::discard(uint32_t fragment) {
    prepare();
    if (gone_.empty()) gone_.assign(graph().leafCount(), 0);
    const Range leaves = graph().leavesOf(fragment);
    std::fill_n(gone_.begin() + leaves.first, leaves.count, uint8_t(1));
}

void Structure::pin(uint32_t leaf, bool pinned) {
    if (pins_.empty()) {
        if (!pinned) return;
        pins_.assign(graph().leafCount(), 0);
    }
    pins_[leaf] = pinned ? 1 : 0;
}

void Structure::open(uint32_t fragment) {
    prepare();
    const Range children = asset_->fragment(fragment).children;
    for (uint32_t c = children.first; c < children.first + children.count; ++c) {
        const Range leaves = graph().leavesOf(c);
        std::fill_n(standing_.begin() + leaves.first, leaves.count, c);
    }
}

void Structure::close(uint32_t fragment) {
    const Range leaves = graph().leavesOf(fragment);
    if (isDamaged()) std::fill_n(standing_.begin() + leaves.first, leaves.count, fragment);
}

void IslandFinder::find(const Structure& structure, std::span<const uint32_t> fragments) {
    const BondGraph& graph = structure.graph();
    islands_.clear();
    fragments_.clear();
    if (state_.size() < structure.asset().fragmentCount() || round_ > UINT32_MAX - 2) {
        state_.assign(std::max<size_t>(structure.asset().fragmentCount(), state_.size()), 0);
        round_ = 0;
    }
    const uint32_t sought = ++round_, found = ++round_;
    for (const uint32_t fragment : fragments) state_[fragment] = sought;
    for (const uint32_t start : fragments) {
        if (state_[start] != sought) continue;
        Island& island = islands_.emplace_back();
        island.fragments.first = uint32_t(fragments_.size());
        state_[start] = found;
        fragments_.push_back(start);
        for (size_t next = island.fragments.first; next < fragments_.size(); ++next) {
            const uint32_t fragment = fragments_[next];
            island.mass += double(structure.asset().fragment(fragment).mass);
            const Range leaves = graph.leavesOf(fragment);
            for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf) {
                island.anchored = island.anchored || structure.isPinned(leaf);
                for (const BondGraph::Edge& edge : graph.edgesOf(leaf)) {
                    if (structure.isBroken(edge.bond)) continue;
                    if (edge.other == BondGraph::kWorld) {
                        island.anchored = true;
                        continue;
                    }
                    const uint32_t other = structure.fragmentAt(edge.other);
                    if (state_[other] != sought) continue;
                    state_[other] = found;
                    fragments_.push_back(other);
                }
            }
        }
        island.fragments.count = uint32_t(fragments_.size()) - island.fragments.first;
        std::sort(fragments_.begin() + island.fragments.first, fragments_.end());
    }
}

}  // namespace sherd
