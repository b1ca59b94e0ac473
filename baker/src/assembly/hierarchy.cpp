// SPDX-License-Identifier: MIT
#include "assembly/hierarchy.h"

#include <algorithm>
#include <numeric>

namespace sherd {
namespace {

std::vector<uint32_t> depthFirstOrder(const Components& components) {
    std::vector<uint32_t> order(components.leafCount);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        for (uint32_t k = 1; k <= components.levels; ++k) {
            if (components.at(k, a) != components.at(k, b))
                return components.at(k, a) < components.at(k, b);
        }
        return false;
    });
    return order;
}

}  // namespace

Hierarchy buildHierarchy(const Components& components) {
    Hierarchy h;
    h.leafOrder = depthFirstOrder(components);
    h.rankOfLeaf.resize(components.leafCount);
    for (uint32_t r = 0; r < components.leafCount; ++r) h.rankOfLeaf[h.leafOrder[r]] = r;

    const auto addFragment = [&](Range leaves, int32_t parent, uint32_t level) {
        h.leaves.push_back(leaves);
        h.parent.push_back(parent);
        h.children.push_back({});
        h.level.push_back(level);
    };
    addFragment({0, components.leafCount}, -1, 0);
    h.levels.push_back({0, 1});
    h.fragmentOfRank.assign(components.leafCount, 0);

    for (uint32_t k = 1; k <= components.levels; ++k) {
        const auto first = static_cast<uint32_t>(h.leaves.size());
        for (uint32_t r = 0; r < components.leafCount;) {
            uint32_t end = r + 1;
            const uint32_t component = components.at(k, h.leafOrder[r]);
            while (end < components.leafCount && components.at(k, h.leafOrder[end]) == component)
                ++end;
            const uint32_t parent = h.fragmentOfRank[r];
            if (h.leaves[parent].count != end - r) {
                const auto fragment = static_cast<uint32_t>(h.leaves.size());
                if (h.children[parent].count == 0) h.children[parent].first = fragment;
                ++h.children[parent].count;
                addFragment({r, end - r}, static_cast<int32_t>(parent), k);
                std::fill(h.fragmentOfRank.begin() + r, h.fragmentOfRank.begin() + end, fragment);
            }
            r = end;
        }
        h.levels.push_back({first, static_cast<uint32_t>(h.leaves.size()) - first});
    }
    return h;
}

}  // namespace sherd
