// SPDX-License-Identifier: MIT
#include "sherd/runtime/bond_graph.h"

#include <algorithm>
#include <tuple>

#include "sherd/runtime/material.h"

namespace sherd {
namespace {

/// The deepest fragment above both: parents lie in front of their children, so the larger index is
/// never the common one.
uint32_t commonFragment(const std::vector<Fragment>& fragments, uint32_t a, uint32_t b) {
    while (a != b) {
        uint32_t& deeper = a > b ? a : b;
        deeper = uint32_t(std::max(fragments[deeper].parent, 0));
    }
    return a;
}

}  // namespace

BondGraph::BondGraph(const FractureSet& set)
    : leavesOf_(set.fragments.size()), anchored_(set.fragments.size(), 0) {
    const auto count = uint32_t(set.fragments.size());
    children_.reserve(count);
    for (const Fragment& fragment : set.fragments) children_.push_back(fragment.children);
    // Children lie behind their parents: backwards for the sizes, forwards for the places.
    for (uint32_t f = count; f-- > 0;) {
        const Fragment& fragment = set.fragments[f];
        if (fragment.children.count == 0) leavesOf_[f].count = 1;
        if (fragment.parent >= 0) leavesOf_[uint32_t(fragment.parent)].count += leavesOf_[f].count;
    }
    fragmentOfLeaf_.resize(count > 0 ? leavesOf_[0].count : 0);
    for (uint32_t f = 0; f < count; ++f) {
        uint32_t first = leavesOf_[f].first;
        const Range children = children_[f];
        if (children.count == 0) fragmentOfLeaf_[first] = f;
        for (uint32_t c = children.first; c < children.first + children.count; ++c) {
            leavesOf_[c].first = first;
            first += leavesOf_[c].count;
        }
    }

    for (const sherd::Bond& from : set.bonds) {
        if (!(from.area > 0) || from.a < 0) continue;
        Bond bond;
        bond.a = leavesOf_[size_t(from.a)].first;
        bond.b = from.b < 0 ? kWorld : leavesOf_[size_t(from.b)].first;
        if (bond.a == bond.b) continue;
        bond.centroid = from.centroid;
        bond.normal = from.normal;
        bond.area = from.area;
        bond.strength = from.strength;
        bond.toughness = from.toughness;
        const Fragment& side = set.fragments[fragmentOfLeaf_[bond.a]];
        bond.energy = bond.area * bond.toughness * materialNamed(side.material).dissipation;
        if (bond.b != kWorld) {
            bond.parting =
                commonFragment(set.fragments, fragmentOfLeaf_[bond.a], fragmentOfLeaf_[bond.b]);
        } else {
            for (auto f = int32_t(fragmentOfLeaf_[bond.a]); f >= 0;
                 f = set.fragments[size_t(f)].parent)
                anchored_[size_t(f)] = 1;
        }
        bonds_.push_back(bond);
    }

    firstEdge_.assign(fragmentOfLeaf_.size() + 1, 0);
    const auto forEachSide = [&](const auto& visit) {
        for (uint32_t b = 0; b < bonds_.size(); ++b) {
            visit(bonds_[b].a, Edge{b, bonds_[b].b});
            if (bonds_[b].b != kWorld) visit(bonds_[b].b, Edge{b, bonds_[b].a});
        }
    };
    forEachSide([&](uint32_t leaf, Edge) { ++firstEdge_[leaf + 1]; });
    for (size_t l = 1; l < firstEdge_.size(); ++l) firstEdge_[l] += firstEdge_[l - 1];
    edges_.resize(firstEdge_.back());
    std::vector<uint32_t> next(firstEdge_.begin(), firstEdge_.end() - 1);
    forEachSide([&](uint32_t leaf, Edge edge) { edges_[next[leaf]++] = edge; });
    for (size_t l = 0; l + 1 < firstEdge_.size(); ++l)
        std::sort(edges_.begin() + firstEdge_[l], edges_.begin() + firstEdge_[l + 1],
                  [](const Edge& x, const Edge& y) {
                      return std::tie(x.other, x.bond) < std::tie(y.other, y.bond);
                  });
}

uint32_t BondGraph::childWith(uint32_t fragment, uint32_t leaf) const {
    const Range children = children_[fragment];
    uint32_t low = children.first, high = children.first + children.count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        (leavesOf_[middle].first <= leaf ? low : high) = middle;
    }
    return low;
}

}  // namespace sherd
