// SPDX-License-Identifier: MIT
#include "sherd/runtime/structure.h"

#include <algorithm>

namespace sherd {

void Structure::prepare() {
    if (!lost_.empty()) return;
    standing_.assign(graph().leafCount(), 0);
    lost_.assign(std::max<size_t>(graph().bonds().size(), 1), 0.0F);
}

void Structure::weaken(uint32_t bond, float share) {
    constexpr float kAlmostAll = 1 - 0x1p-20F;
    prepare();
    if (!(lost_[bond] < kAlmostAll)) return;
    lost_[bond] = std::min(lost_[bond] + share, kAlmostAll);
}

void Structure::breakBond(uint32_t bond) {
    prepare();
    lost_[bond] = 1;
}

void Structure::open(uint32_t fragment) {
    prepare();
    const Range children = asset_->fragment(fragment).children;
    for (uint32_t c = children.first; c < children.first + children.count; ++c) {
        const Range leaves = graph().leavesOf(c);
        std::fill_n(standing_.begin() + leaves.first, leaves.count, c);
    }
}

void Structure::islandsOf(std::span<const uint32_t> fragments, std::vector<Island>& islands) const {
    islands.clear();
    std::vector<uint32_t> byLeaf(fragments.begin(), fragments.end());
    const auto firstLeaf = [&](uint32_t f) { return graph().leavesOf(f).first; };
    std::sort(byLeaf.begin(), byLeaf.end(),
              [&](uint32_t x, uint32_t y) { return firstLeaf(x) < firstLeaf(y); });
    std::vector<uint8_t> seen(byLeaf.size(), 0);
    // Where a fragment lies in `byLeaf`; the count when it is not one of these.
    const auto placeOf = [&](uint32_t fragment) {
        const auto found =
            std::lower_bound(byLeaf.begin(), byLeaf.end(), firstLeaf(fragment),
                             [&](uint32_t f, uint32_t leaf) { return firstLeaf(f) < leaf; });
        const bool isHere = found != byLeaf.end() && *found == fragment;
        return isHere ? size_t(found - byLeaf.begin()) : byLeaf.size();
    };
    std::vector<size_t> open;
    for (size_t start = 0; start < byLeaf.size(); ++start) {
        if (seen[start] != 0) continue;
        Island& island = islands.emplace_back();
        seen[start] = 1;
        open.assign(1, start);
        while (!open.empty()) {
            const uint32_t fragment = byLeaf[open.back()];
            open.pop_back();
            island.fragments.push_back(fragment);
            island.mass += double(asset_->fragment(fragment).mass);
            const Range leaves = graph().leavesOf(fragment);
            for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf) {
                for (const BondGraph::Edge& edge : graph().edgesOf(leaf)) {
                    if (isBroken(edge.bond)) continue;
                    if (edge.other == BondGraph::kWorld) {
                        island.anchored = true;
                        continue;
                    }
                    if (graph().contains(fragment, edge.other)) continue;
                    const size_t place = placeOf(fragmentAt(edge.other));
                    if (place == byLeaf.size() || seen[place] != 0) continue;
                    seen[place] = 1;
                    open.push_back(place);
                }
            }
        }
        std::sort(island.fragments.begin(), island.fragments.end());
    }
}

}  // namespace sherd
