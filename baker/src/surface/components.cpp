// SPDX-License-Identifier: MIT
#include "surface/components.h"

#include <numeric>

namespace sherd {

uint32_t Components::separatedFrom(uint32_t leafA, uint32_t leafB) const {
    for (uint32_t k = 1; k <= levels; ++k) {
        if (at(k, leafA) != at(k, leafB)) return k;
    }
    return levels + 1;
}

namespace {

/// Labels of a flood fill over `n` items whose neighbours `forEachNeighbour(item, visit)` names.
template <class ForEachNeighbour>
uint32_t fill(uint32_t n, std::vector<uint32_t>& label, ForEachNeighbour&& forEachNeighbour) {
    label.assign(n, kNone);
    std::vector<uint32_t> stack;
    uint32_t count = 0;
    for (uint32_t seed = 0; seed < n; ++seed) {
        if (label[seed] != kNone) continue;
        label[seed] = count;
        stack.push_back(seed);
        while (!stack.empty()) {
            const uint32_t item = stack.back();
            stack.pop_back();
            forEachNeighbour(item, [&](uint32_t neighbour) {
                if (label[neighbour] != kNone) return;
                label[neighbour] = count;
                stack.push_back(neighbour);
            });
        }
        ++count;
    }
    return count;
}

}  // namespace

Components floodFill(const SplitSurface& surface, const MeshTopology& topology,
                     const LineTable& lines, uint32_t levels) {
    Components result;
    result.levels = levels;
    const auto triangleCount = static_cast<uint32_t>(surface.triangles.size());
    const auto levelOf = [&](uint32_t h) {
        const uint32_t line = surface.triangles[h / 3].line[h % 3];
        return line == 0 ? 0 : lines.level(line);
    };
    result.leafCount = fill(triangleCount, result.leaf, [&](uint32_t t, auto&& visit) {
        for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
            const uint32_t o = topology.opposite[h];
            if (o == kNone) continue;
            const uint32_t level = levelOf(h);
            if (level == 0 || level > levels) visit(o / 3);
        }
    });

    struct Gate {
        uint32_t neighbour, level;
    };
    std::vector<std::vector<Gate>> gates(result.leafCount);
    for (uint32_t h = 0; h < 3 * triangleCount; ++h) {
        const uint32_t level = levelOf(h);
        if (level == 0 || topology.opposite[h] == kNone) continue;
        const uint32_t a = result.leaf[h / 3];
        const uint32_t b = result.leaf[topology.opposite[h] / 3];
        if (a != b) gates[a].push_back({b, level});
    }
    std::vector<uint32_t> parts;
    result.parts = fill(result.leafCount, parts, [&](uint32_t leaf, auto&& visit) {
        for (const Gate& gate : gates[leaf]) visit(gate.neighbour);
    });
    result.ofLeaf.resize(levels);
    for (uint32_t k = 1; k <= levels; ++k) {
        result.count.push_back(
            fill(result.leafCount, result.ofLeaf[k - 1], [&](uint32_t leaf, auto&& visit) {
                for (const Gate& gate : gates[leaf]) {
                    if (gate.level > k) visit(gate.neighbour);
                }
            }));
    }
    return result;
}

}  // namespace sherd
