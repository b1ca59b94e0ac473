// SPDX-License-Identifier: MIT
#include "sherd/runtime/structure_queries.h"

#include <algorithm>

namespace sherd {

void findNeighbors(const Structure& structure, uint32_t fragment,
                   std::vector<Neighbor>& neighbors) {
    neighbors.clear();
    const BondGraph& graph = structure.graph();
    if (fragment >= structure.asset().fragmentCount() || !structure.stands(fragment)) return;
    struct Side {
        uint32_t fragment = 0;
        double area = 0, whole = 0, left = 0;
    };
    std::vector<Side> sides;
    const Range leaves = graph.leavesOf(fragment);
    for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf)
        for (const BondGraph::Edge& edge : graph.edgesOf(leaf)) {
            const bool isAnchor = edge.other == BondGraph::kWorld;
            if (!isAnchor && graph.contains(fragment, edge.other)) continue;
            const double area = double(graph.bond(edge.bond).area);
            sides.push_back({isAnchor ? BondGraph::kWorld : structure.fragmentAt(edge.other),
                             structure.isBroken(edge.bond) ? 0 : area, area,
                             area * double(structure.health(edge.bond))});
        }
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side& x, const Side& y) { return x.fragment < y.fragment; });
    for (size_t i = 0; i < sides.size();) {
        Side sum{sides[i].fragment, 0, 0, 0};
        for (; i < sides.size() && sides[i].fragment == sum.fragment; ++i) {
            sum.area += sides[i].area;
            sum.whole += sides[i].whole;
            sum.left += sides[i].left;
        }
        if (sum.area > 0)
            neighbors.push_back({sum.fragment, float(sum.area), float(sum.left / sum.whole)});
    }
}

float healthOf(const Structure& structure, uint32_t fragment) {
    const BondGraph& graph = structure.graph();
    const Range leaves = graph.leavesOf(fragment);
    double whole = 0, left = 0;
    for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf)
        for (const BondGraph::Edge& edge : graph.edgesOf(leaf)) {
            const BondGraph::Bond& bond = graph.bond(edge.bond);
            // A bond within is listed with both of its leaves.
            if (bond.b == leaf && graph.contains(fragment, bond.a)) continue;
            whole += double(bond.area);
            left += double(bond.area) * double(structure.health(edge.bond));
        }
    return whole > 0 ? float(left / whole) : 1.0F;
}

}  // namespace sherd
