// SPDX-License-Identifier: MIT
#include "levels/drawn_classes.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/union_find.h"

namespace sherd {

DrawnClasses::DrawnClasses(const CutSurface& cut, const Components& drawn) : drawn_(drawn) {
    for (uint32_t h = 0; h < 3 * cut.surface.triangles.size(); ++h) {
        const uint32_t o = cut.topology.opposite[h];
        const uint32_t mark = cut.surface.triangles[h / 3].line[h % 3];
        if (o == kNone || mark == 0) continue;
        const auto [a, b] = std::minmax(drawn.leaf[h / 3], drawn.leaf[o / 3]);
        if (a != b) gates_.insert({a, b, cut.lines.level(mark)});
    }
}

const std::vector<uint32_t>& DrawnClasses::at(uint32_t level, const std::set<uint32_t>& skipped) {
    while (level > 0 && skipped.contains(level)) --level;
    const std::set<uint32_t> open(skipped.begin(), skipped.lower_bound(level));
    const auto [it, isNew] = known_.try_emplace({level, open});
    if (!isNew) return it->second;
    if (level == 0) {
        std::vector<uint32_t> each(drawn_.leafCount);
        std::iota(each.begin(), each.end(), 0U);
        return it->second = openGates(std::move(each), nullptr);
    }
    return it->second =
               open.empty() ? drawn_.ofLeaf[level - 1] : openGates(drawn_.ofLeaf[level - 1], &open);
}

/// levels: null: all.
std::vector<uint32_t> DrawnClasses::openGates(std::vector<uint32_t> labels,
                                              const std::set<uint32_t>* levels) const {
    UnionFind classes(labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end()) + 1);
    for (const Gate& gate : gates_)
        if (levels == nullptr || levels->contains(gate.level))
            classes.unite(labels[gate.a], labels[gate.b]);
    for (uint32_t& label : labels) label = classes.find(label);
    return labels;
}

}  // namespace sherd
