// SPDX-License-Identifier: MIT
#include "sherd/runtime/structure.h"

#include <algorithm>
#include <utility>

namespace sherd {

void Structure::renew(std::shared_ptr<const Asset> asset) {
    asset_ = std::move(asset);
    standing_.clear();
    lost_.clear();
    pins_.clear();
    gone_.clear();
}

void Structure::makeRoom() {
    standing_.assign(graph().leafCount(), 0);
    lost_.assign(std::max<size_t>(graph().bonds().size(), 1), 0.0F);
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

void Structure::openDownTo(uint32_t fragment, Vector<uint32_t>& opened) {
    const uint32_t leaf = graph().leavesOf(fragment).first;
    for (;;) {
        const uint32_t standing = fragmentAt(leaf);
        // Parents lie in front of their children.
        if (standing > fragment || asset_->fragment(standing).children.count == 0) return;
        open(standing);
        opened.push_back(standing);
    }
}

void IslandFinder::find(const Structure& structure, std::span<const uint32_t> fragments) {
    islands_.clear();
    front_.clear();
    if (state_.size() < structure.asset().fragmentCount() || round_ > UINT32_MAX - 2) {
        state_.assign(std::max<size_t>(structure.asset().fragmentCount(), state_.size()), 0);
        label_.resize(state_.size());
        round_ = 0;
    }
    const uint32_t sought = ++round_;
    ++round_;
    for (const uint32_t fragment : fragments) state_[fragment] = sought;
    for (const uint32_t start : fragments)
        if (state_[start] == sought) flood(structure, start, sought);
    // Sharing them out in their order sorts those of every island.
    uint32_t first = 0;
    for (Island& island : islands_) {
        island.fragments.first = first;
        first += std::exchange(island.fragments.count, 0);
    }
    fragments_.resize(fragments.size());
    for (const uint32_t fragment : fragments) {
        Range& range = islands_[label_[fragment]].fragments;
        fragments_[range.first + range.count++] = fragment;
    }
}

/// Breadth first through bonds that hold, from a fragment whose island is not known yet.
void IslandFinder::flood(const Structure& structure, uint32_t start, uint32_t sought) {
    const BondGraph& graph = structure.graph();
    const auto label = uint32_t(islands_.size());
    Island& island = islands_.emplace_back();
    const auto reach = [&](uint32_t fragment) {
        state_[fragment] = sought + 1;
        label_[fragment] = label;
        front_.push_back(fragment);
    };
    const auto first = uint32_t(front_.size());
    reach(start);
    for (size_t next = first; next < front_.size(); ++next) {
        const uint32_t fragment = front_[next];
        island.mass += double(structure.asset().fragment(fragment).mass);
        const Range leaves = graph.leavesOf(fragment);
        for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf)
            island.anchored = island.anchored || structure.isPinned(leaf);
        for (const BondGraph::Edge& edge : graph.edgesOf(leaves)) {
            if (edge.other == BondGraph::kWorld) {
                island.anchored = island.anchored || !structure.isBroken(edge.bond);
                continue;
            }
            const uint32_t other = structure.fragmentAt(edge.other);
            if (state_[other] == sought && !structure.isBroken(edge.bond)) reach(other);
        }
    }
    island.fragments.count = uint32_t(front_.size()) - first;
}

}  // namespace sherd
