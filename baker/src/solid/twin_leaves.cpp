// SPDX-License-Identifier: MIT
#include "solid/twin_leaves.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <set>

#include "geometry/compact_labels.h"
#include "geometry/triangle.h"
#include "geometry/union_find.h"
#include "surface/component_merging.h"

namespace sherd {
namespace {

/// Rays from a leaf: how much of its area sees which leaf.
using Views = std::vector<std::map<uint32_t, double>>;

/// A few triangles of every leaf look across, those with the most area. They see nothing that is
/// farther off than their leaf is wide, by `mostWidths`.
Views viewsOf(const SplitSurface& surface, const Components& components, const FarSide& farSide,
              double mostWidths, std::vector<double>& looked) {
    const std::vector<double> areas = leafAreas(surface, components);
    constexpr size_t kMostRays = 48;
    std::vector<std::vector<std::pair<double, uint32_t>>> triangles(components.leafCount);
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        triangles[components.leaf[t]].emplace_back(
            -triangleArea(surface.positions, surface.triangles[t].v), t);
    }
    Views views(components.leafCount);
    looked.assign(components.leafCount, 0);
    for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf) {
        auto& own = triangles[leaf];
        const size_t count = std::min(own.size(), kMostRays);
        std::partial_sort(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(count), own.end());
        for (size_t i = 0; i < count; ++i) {
            const auto [minusArea, t] = own[i];
            looked[leaf] -= minusArea;
            const auto place = farSide.acrossFrom(t);
            if (!place || glm::distance(place->position, centroidOf(surface, t)) >
                              mostWidths * std::sqrt(areas[leaf]))
                continue;
            views[leaf][components.leaf[place->triangle]] -= minusArea;
        }
    }
    return views;
}

/// A piece sees another if that is more of its view than this.
constexpr double kLeastView = 0.25;

/// What is seen most of an area that looks; kNone if that is little.
uint32_t mostOf(const std::map<uint32_t, double>& seen, double looked) {
    uint32_t best = kNone;
    double most = kLeastView * looked;
    for (const auto& [leaf, area] : seen) {
        if (!(area > most)) continue;
        best = leaf;
        most = area;
    }
    return best;
}

/// What one level's pieces see of each other.
class LevelTwins {
  public:
    LevelTwins(const Components& components, uint32_t level, const Views& views,
               const std::vector<double>& looked, std::span<const uint32_t> parent)
        : parent_(parent) {
        seen_.resize(components.count[level - 1]);
        looked_.assign(seen_.size(), 0);
        for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf) {
            const uint32_t own = components.at(level, leaf);
            looked_[own] += looked[leaf];
            for (const auto& [other, area] : views[leaf])
                seen_[own][components.at(level, other)] += area;
        }
    }

    /// Pairs that look mostly at each other. Neighbours must have been drawn apart for a
    /// reason, unless one of them does nothing but face the other.
    void unite(const std::set<std::pair<uint32_t, uint32_t>>& neighbours, UnionFind& pieces) const {
        for (uint32_t a = 0; a < seen_.size(); ++a) {
            const uint32_t b = mostSeen(a);
            if (b == kNone || b <= a || mostSeen(b) != a) continue;
            if (parent_[a] != parent_[b]) continue;
            constexpr double kNothingElse = 0.95;
            if (neighbours.contains({a, b}) && std::max(share(a, b), share(b, a)) < kNothingElse)
                continue;
            pieces.unite(a, b);
        }
    }

  private:
    double share(uint32_t a, uint32_t b) const {
        const auto found = seen_[a].find(b);
        return found == seen_[a].end() ? 0 : found->second / looked_[a];
    }
    /// What a piece sees most of, unless that is little or itself.
    uint32_t mostSeen(uint32_t a) const {
        const uint32_t best = mostOf(seen_[a], looked_[a]);
        return best == a ? kNone : best;
    }

    std::span<const uint32_t> parent_;  ///< per piece: the united one of the level before
    Views seen_;
    std::vector<double> looked_;
};

}  // namespace

std::vector<uint32_t> twinLeaves(const SplitSurface& surface, const MeshTopology& topology,
                                 const Components& components, const FarSide& farSide,
                                 const std::function<bool(uint32_t level)>& drawn, bool far) {
    constexpr double kWall = 1.5;
    std::vector<double> looked;
    const Views views = viewsOf(surface, components, farSide, far ? 1e300 : kWall, looked);
    std::set<std::pair<uint32_t, uint32_t>> touching;
    for (uint32_t h = 0; h < topology.opposite.size(); ++h) {
        if (topology.opposite[h] == kNone) continue;
        const uint32_t a = components.leaf[h / 3], b = components.leaf[topology.opposite[h] / 3];
        if (a < b) touching.insert({a, b});
    }
    std::vector<uint32_t> united(components.leafCount, 0);  // per leaf, at the level before
    for (uint32_t level = 1; level <= components.levels; ++level) {
        std::vector<uint32_t> parent(components.count[level - 1], 0);
        for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf)
            parent[components.at(level, leaf)] = united[leaf];
        std::set<std::pair<uint32_t, uint32_t>> neighbours;
        for (const auto& [a, b] : touching) {
            const uint32_t x = components.at(level, a), y = components.at(level, b);
            if (x != y) neighbours.insert(std::minmax(x, y));
        }
        UnionFind pieces(components.count[level - 1]);
        if (drawn(level))
            LevelTwins(components, level, views, looked, parent).unite(neighbours, pieces);
        for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf)
            united[leaf] = pieces.find(components.at(level, leaf));
    }
    // Leaves that end at a shallower level have a number of their own at the deepest one.
    std::map<uint32_t, uint32_t> lowest;
    std::vector<uint32_t> group(components.leafCount);
    for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf)
        group[leaf] = lowest.try_emplace(united[leaf], leaf).first->second;
    return group;
}

Components uniteLeaves(const Components& components, std::span<const uint32_t> group,
                       std::vector<uint32_t>& newLeaf) {
    Components result;
    result.levels = components.levels;
    result.parts = components.parts;
    newLeaf = compactLabels(std::vector<uint32_t>(group.begin(), group.end()), result.leafCount);
    result.leaf.reserve(components.leaf.size());
    for (const uint32_t leaf : components.leaf) result.leaf.push_back(newLeaf[leaf]);
    for (uint32_t level = 1; level <= components.levels; ++level) {
        UnionFind pieces(components.count[level - 1]);
        for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf)
            pieces.unite(components.at(level, leaf), components.at(level, group[leaf]));
        std::vector<uint32_t> labels(result.leafCount);
        for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf)
            labels[newLeaf[leaf]] = pieces.find(components.at(level, leaf));
        uint32_t count = 0;
        result.ofLeaf.push_back(compactLabels(labels, count));
        result.count.push_back(count);
    }
    return result;
}

}  // namespace sherd
