// SPDX-License-Identifier: MIT
// How many islands a hit may make: rounds as in O. Boruvka's minimum spanning tree (1926), but only
// groups that have not grown in this round join another, so that the islands stay of like size.
#include "core/budget.h"

#include <algorithm>
#include <tuple>

namespace sherd {

uint32_t IslandMerger::rootOf(uint32_t group) {
    while (groups_[group].root != group) {
        groups_[group].root = groups_[groups_[group].root].root;
        group = groups_[group].root;
    }
    return group;
}

/// To the root with the lower number, whose first fragment is the lower one, too.
bool IslandMerger::join(uint32_t a, uint32_t b) {
    a = rootOf(a);
    b = rootOf(b);
    if (a == b) return false;
    if (b < a) std::swap(a, b);
    groups_[b].root = a;
    groups_[a].mass += groups_[b].mass;
    groups_[a].anchored = groups_[a].anchored || groups_[b].anchored;
    groups_[a].grown = true;
    --count_;
    return true;
}

/// What the roots shared, summed over the bonds of each two, in the order of the roots.
void IslandMerger::findShared(const Structure& structure, const HitResult& hit) {
    const BondGraph& graph = structure.graph();
    shared_.clear();
    for (const uint32_t b : hit.bonds) {
        const BondGraph::Bond& bond = graph.bond(b);
        if (bond.b == BondGraph::kWorld) continue;
        const uint32_t x = rootOf(groupOf_[structure.fragmentAt(bond.a)]);
        const uint32_t y = rootOf(groupOf_[structure.fragmentAt(bond.b)]);
        if (x == y) continue;
        shared_.push_back({x, y, bond.area});
        shared_.push_back({y, x, bond.area});
    }
    std::sort(shared_.begin(), shared_.end(), [](const Shared& x, const Shared& y) {
        return std::tie(x.from, x.to, x.area) < std::tie(y.from, y.to, y.area);
    });
    for (Group& group : groups_) group.shared = {};
    size_t count = 0;
    for (const Shared& next : shared_) {
        if (count > 0 && shared_[count - 1].from == next.from && shared_[count - 1].to == next.to) {
            shared_[count - 1].area += next.area;
            continue;
        }
        Range& list = groups_[next.from].shared;
        if (list.count++ == 0) list.first = uint32_t(count);
        shared_[count++] = next;
    }
    shared_.resize(count);
}

/// The one to join; UINT32_MAX when there is none.
uint32_t IslandMerger::neighbourOf(uint32_t index, bool alsoGrown) {
    const Range list = groups_[index].shared;
    uint32_t best = UINT32_MAX;
    std::tuple<bool, float, double> most;
    for (uint32_t i = list.first; i < list.first + list.count; ++i) {
        const uint32_t other = rootOf(shared_[i].to);
        const Group& group = groups_[other];
        if (other == index || (group.grown && !alsoGrown)) continue;
        const std::tuple worth(!group.anchored, shared_[i].area, -group.mass);
        if (best != UINT32_MAX && worth <= most) continue;
        best = other;
        most = worth;
    }
    return best;
}

/// Returns whether any two were joined.
bool IslandMerger::joinRound(const Structure& structure, const HitResult& hit, uint32_t most) {
    findShared(structure, hit);
    order_.clear();
    for (uint32_t g = 0; g < groups_.size(); ++g) {
        groups_[g].grown = false;
        if (groups_[g].root == g) order_.push_back(g);
    }
    // What is anchored comes to others last.
    std::sort(order_.begin(), order_.end(), [&](uint32_t x, uint32_t y) {
        return std::tuple(groups_[x].anchored, groups_[x].mass, x) <
               std::tuple(groups_[y].anchored, groups_[y].mass, y);
    });
    // Two by two. Where many have but one neighbour, such as around a core, that would take as many
    // rounds as there are: then more of them come to it at once.
    size_t joined = 0;
    for (const bool alsoGrown : {false, true}) {
        if (joined * 8 > order_.size()) break;
        for (const uint32_t g : order_) {
            if (count_ <= most) break;
            if (groups_[g].root != g || groups_[g].grown) continue;
            const uint32_t other = neighbourOf(g, alsoGrown);
            if (other != UINT32_MAX && join(g, other)) ++joined;
        }
    }
    return joined > 0;
}

/// What came out of a fragment without bonds between: the finest first, as little as will do.
void IslandMerger::closeOpened(Structure& structure, uint32_t most, HitResult& hit) {
    const BondGraph& graph = structure.graph();
    for (size_t i = hit.opened.size(); i-- > 0 && count_ > most;) {
        const uint32_t fragment = hit.opened[i];
        const Range leaves = graph.leavesOf(fragment);
        const auto groupAt = [&](uint32_t leaf) { return groupOf_[structure.fragmentAt(leaf)]; };
        const uint32_t first = groupAt(leaves.first);
        bool joined = false;
        for (uint32_t l = 1; l < leaves.count; ++l)
            joined = join(first, groupAt(leaves.first + l)) || joined;
        if (!joined) continue;
        groupOf_[fragment] = first;
        structure.close(fragment);
        std::erase_if(hit.opened, [&](uint32_t f) {
            const uint32_t leaf = graph.leavesOf(f).first;
            return f >= fragment && graph.contains(fragment, leaf);
        });
        i = std::min(i, hit.opened.size());
    }
}

bool IslandMerger::limit(Structure& structure, const IslandFinder& groups, uint32_t most,
                         HitResult& hit) {
    const auto found = groups.islands();
    most = std::max(most, 1U);
    if (found.size() <= most) return false;
    count_ = uint32_t(found.size());
    groups_.clear();
    if (groupOf_.size() < structure.asset().fragmentCount())
        groupOf_.resize(structure.asset().fragmentCount());
    for (uint32_t g = 0; g < found.size(); ++g) {
        groups_.push_back({g, found[g].mass, found[g].anchored});
        for (const uint32_t fragment : groups.fragmentsOf(found[g])) groupOf_[fragment] = g;
    }
    while (count_ > most && joinRound(structure, hit, most)) {
    }
    if (count_ > most) closeOpened(structure, most, hit);
    if (count_ == found.size()) return false;

    // What was joined holds, and so does what was closed. A crack inside one group stays.
    const BondGraph& graph = structure.graph();
    std::erase_if(hit.bonds, [&](uint32_t b) {
        const BondGraph::Bond& bond = graph.bond(b);
        if (bond.b == BondGraph::kWorld) return false;
        const uint32_t f = structure.fragmentAt(bond.a), g = structure.fragmentAt(bond.b);
        const bool isJoined =
            groupOf_[f] != groupOf_[g] && rootOf(groupOf_[f]) == rootOf(groupOf_[g]);
        if (f != g && !isJoined) return false;
        structure.hold(b);
        return true;
    });
    hit.area = 0;
    for (const uint32_t b : hit.bonds) hit.area += graph.bond(b).area;
    return true;
}

}  // namespace sherd
