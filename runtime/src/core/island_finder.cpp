// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "sherd/runtime/structure.h"

namespace sherd {
namespace {

/// By a bond to the world that is not broken, or a pin.
bool isHeld(const Structure& structure, uint32_t fragment) {
    const BondGraph& graph = structure.graph();
    const Range leaves = graph.leavesOf(fragment);
    for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf)
        if (structure.isPinned(leaf)) return true;
    if (!graph.isAnchored(fragment)) return false;
    const auto edges = graph.edgesOf(leaves);
    return std::any_of(edges.begin(), edges.end(), [&](const BondGraph::Edge& edge) {
        return edge.other == BondGraph::kWorld && !structure.isBroken(edge.bond);
    });
}

}  // namespace

void IslandFinder::begin(const Structure& structure) {
    islands_.clear();
    if (state_.size() < structure.asset().fragmentCount() || round_ > UINT32_MAX - 2) {
        state_.assign(std::max<size_t>(structure.asset().fragmentCount(), state_.size()), 0);
        label_.resize(state_.size());
        after_.resize(state_.size());
        round_ = 0;
    }
    round_ += 2;
}

void IslandFinder::find(const Structure& structure, std::span<const uint32_t> fragments) {
    begin(structure);
    for (const uint32_t fragment : fragments) state_[fragment] = sought();
    uint32_t groups = 0;
    for (const uint32_t start : fragments)
        if (state_[start] == sought()) flood(structure, start, groups++);
    shareOut(structure, fragments, groups, [this](uint32_t fragment) { return label_[fragment]; });
}

/// Breadth first through bonds that hold, from a fragment whose group is not known yet.
void IslandFinder::flood(const Structure& structure, uint32_t start, uint32_t group) {
    const BondGraph& graph = structure.graph();
    front_.clear();
    const auto reach = [&](uint32_t fragment) {
        state_[fragment] = found();
        label_[fragment] = group;
        front_.push_back(fragment);
    };
    reach(start);
    // It grows meanwhile.
    size_t next = 0;
    while (next < front_.size()) {
        for (const BondGraph::Edge& edge : graph.edgesOf(graph.leavesOf(front_[next++]))) {
            if (edge.other == BondGraph::kWorld) continue;
            const uint32_t other = structure.fragmentAt(edge.other);
            if (state_[other] == sought() && !structure.isBroken(edge.bond)) reach(other);
        }
    }
}

void IslandFinder::findAround(const Structure& structure, std::span<const uint32_t> fragments,
                              std::span<const uint32_t> disturbed) {
    // From so many the search would meet itself at every step.
    if (disturbed.size() > fragments.size() / 8) {
        find(structure, fragments);
        return;
    }
    begin(structure);
    searches_.clear();
    active_.clear();
    for (const uint32_t start : disturbed) {
        if (state_[start] == found()) continue;
        const auto search = uint32_t(searches_.size());
        searches_.push_back({search, start, start});
        active_.push_back(search);
        state_[start] = found();
        label_[start] = search;
        after_[start] = kNone;
    }
    while (active_.size() > 1) {
        size_t count = 0;
        for (const uint32_t search : active_) {
            if (searches_[search].root == search) advance(structure, search);
            const bool isOver = searches_[search].root != search || searches_[search].next == kNone;
            if (!isOver) active_[count++] = search;
        }
        active_.resize(count);
    }
    // Every fragment hangs on to one from which a search started, and those of searches that have
    // ended were all reached.
    const uint32_t rest = active_.empty() ? 0 : active_.front();
    const auto groups = std::max(uint32_t(searches_.size()), 1U);
    shareOut(structure, fragments, groups, [&](uint32_t fragment) {
        return state_[fragment] == found() ? rootOf(label_[fragment]) : rest;
    });
}

/// By one fragment. A search that meets another becomes part of it.
void IslandFinder::advance(const Structure& structure, uint32_t search) {
    const BondGraph& graph = structure.graph();
    const uint32_t fragment = searches_[search].next;
    searches_[search].next = after_[fragment];
    for (const BondGraph::Edge& edge : graph.edgesOf(graph.leavesOf(fragment))) {
        if (edge.other == BondGraph::kWorld || structure.isBroken(edge.bond)) continue;
        const uint32_t other = structure.fragmentAt(edge.other);
        if (other == fragment) continue;
        if (state_[other] != found()) {
            state_[other] = found();
            label_[other] = search;
            after_[other] = kNone;
            append(searches_[search], other, other);
            continue;
        }
        const uint32_t root = rootOf(label_[other]);
        if (root == search) continue;
        const Search met = searches_[search];
        searches_[search].root = root;
        if (met.next != kNone) append(searches_[root], met.next, met.last);
        search = root;
    }
}

/// A run of fragments that are to be looked at.
void IslandFinder::append(Search& search, uint32_t first, uint32_t last) {
    (search.next == kNone ? search.next : after_[search.last]) = first;
    search.last = last;
}

uint32_t IslandFinder::rootOf(uint32_t search) {
    while (searches_[search].root != search)
        search = searches_[search].root = searches_[searches_[search].root].root;
    return search;
}

/// Numbers the groups in the order of their first fragments. Sharing fragments out in their order
/// sorts those of every island.
template <class GroupOf>
void IslandFinder::shareOut(const Structure& structure, std::span<const uint32_t> fragments,
                            uint32_t groups, const GroupOf& groupOf) {
    numberOf_.assign(groups, kNone);
    for (const uint32_t fragment : fragments) {
        uint32_t& number = numberOf_[groupOf(fragment)];
        if (number == kNone) {
            number = uint32_t(islands_.size());
            islands_.emplace_back();
        }
        label_[fragment] = number;
        Island& island = islands_[number];
        ++island.fragments.count;
        island.mass += double(structure.asset().fragment(fragment).mass);
        island.anchored = island.anchored || isHeld(structure, fragment);
    }
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

}  // namespace sherd
