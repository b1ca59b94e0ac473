// SPDX-License-Identifier: MIT
#include "surface/pieces.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <tuple>

#include "geometry/compact_labels.h"
#include "geometry/ray_hit.h"
#include "geometry/triangle.h"
#include "geometry/union_find.h"

namespace sherd {
namespace {

/// A patch of one level: leaves that hang together.
struct Patch {
    uint32_t triangle = kNone;  ///< its largest
    double largest = -1;
    double area = 0;
    uint32_t parent = 0;  ///< piece of the level before
};

/// Finds what lies across the solid from a triangle.
class Through {
  public:
    explicit Through(const SplitSurface& surface) : surface_(surface) {}

    uint32_t opposite(uint32_t triangle) {
        if (!tree_) tree_.emplace(surface_.positions, vertexTriangles(surface_));
        const auto& v = surface_.triangles[triangle].v;
        const glm::dvec3 a = surface_.positions[v[0]];
        const glm::dvec3 b = surface_.positions[v[1]];
        const glm::dvec3 c = surface_.positions[v[2]];
        const glm::dvec3 inwards = glm::cross(c - a, b - a);
        return firstHit(*tree_, centroidOf(surface_, triangle), inwards, triangle).triangle;
    }

  private:
    const SplitSurface& surface_;
    std::optional<TriangleBvh> tree_;  ///< built when first asked: most surfaces never do
};

/// One level's patches made into pieces.
class LevelGrouping {
  public:
    LevelGrouping(const SplitSurface& surface, const MeshTopology& topology,
                  const PartGroups& groups, const Components& base, const LineTable& lines,
                  uint32_t level, const std::vector<uint32_t>& parentOfLeaf)
        : surface_(surface),
          topology_(topology),
          groups_(groups),
          base_(base),
          level_(level),
          patches_(base.count[level - 1]),
          owner_(patches_.size()) {
        for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
            Patch& patch = patches_[patchOf(t)];
            const double area = triangleArea(surface.positions, surface.triangles[t].v);
            patch.area += area;
            patch.parent = parentOfLeaf[base.leaf[t]];
            if (area <= patch.largest) continue;
            patch.largest = area;
            patch.triangle = t;
        }
        uniteOverDeadLines(lines);
    }

    /// Per patch a label of its piece.
    std::vector<uint32_t> byCell(const CellLevel& cells, Through& through, uint32_t& strays) {
        const std::vector<Key> keys = keysOf(cells);
        std::map<Key, std::vector<uint32_t>> members;
        for (uint32_t p = 0; p < patches_.size(); ++p) members[keys[p]].push_back(p);
        std::vector<uint8_t> attached(patches_.size(), cells.wholeCells ? 1 : 0);
        for (const auto& [key, patches] : members) {
            if (cells.wholeCells)
                for (const uint32_t p : patches) owner_.unite(p, patches[0]);
            else
                keepLargest(patches, keys, through, attached);
        }
        strays = static_cast<uint32_t>(std::count(attached.begin(), attached.end(), 0));
        if (strays > 0) attachStrays(cells, attached);
        // What borders on nothing that stays is a lump of its cell after all.
        for (uint32_t p = 0; p < patches_.size(); ++p)
            if (attached[p] == 0) owner_.unite(p, members[keys[p]][0]);
        std::vector<uint32_t> label(patches_.size());
        for (uint32_t p = 0; p < label.size(); ++p) label[p] = owner_.find(p);
        return label;
    }

    /// Where no cells are given: every patch is a piece, but a parent of which no patch is divided
    /// stays whole. `before`: per leaf the patch of the level before.
    std::vector<uint32_t> byPatch(const std::vector<uint32_t>* before) {
        std::vector<uint32_t> label(patches_.size());
        for (uint32_t p = 0; p < label.size(); ++p) label[p] = owner_.find(p);
        if (before == nullptr) return label;
        std::map<uint32_t, std::vector<uint32_t>> here, there;  // parent -> patches
        for (uint32_t leaf = 0; leaf < base_.leafCount; ++leaf) {
            const uint32_t p = base_.ofLeaf[level_ - 1][leaf];
            here[patches_[p].parent].push_back(p);
            there[patches_[p].parent].push_back((*before)[leaf]);
        }
        const auto distinct = [](std::vector<uint32_t>& items) {
            std::sort(items.begin(), items.end());
            items.erase(std::unique(items.begin(), items.end()), items.end());
            return items.size();
        };
        for (auto& [parent, patches] : here) {
            if (distinct(patches) != distinct(there[parent])) continue;
            for (const uint32_t p : patches) label[p] = patches[0];
        }
        return label;
    }

  private:
    using Key = std::tuple<uint32_t, uint32_t>;  ///< domain, cell

    uint32_t patchOf(uint32_t triangle) const {
        return base_.ofLeaf[level_ - 1][base_.leaf[triangle]];
    }

    /// A line of a shallower level with one piece on both sides separates nothing any more: strays
    /// were joined over it.
    void uniteOverDeadLines(const LineTable& lines) {
        for (uint32_t h = 0; h < 3 * surface_.triangles.size(); ++h) {
            const uint32_t o = topology_.opposite[h];
            const uint32_t line = surface_.triangles[h / 3].line[h % 3];
            if (o == kNone || line == 0 || lines.level(line) >= level_) continue;
            const uint32_t p = patchOf(h / 3);
            const uint32_t q = patchOf(o / 3);
            if (patches_[p].parent == patches_[q].parent) owner_.unite(p, q);
        }
    }

    std::vector<Key> keysOf(const CellLevel& cells) const {
        std::vector<Key> keys;
        keys.reserve(patches_.size());
        for (const Patch& patch : patches_) {
            const uint32_t domain = cells.domain[patch.triangle];
            const uint32_t source = surface_.triangles[patch.triangle].source;
            keys.emplace_back(domain,
                              cells.cellOf(domain, source, centroidOf(surface_, patch.triangle)));
        }
        return keys;
    }

    uint32_t partOf(uint32_t patch) const {
        return groups_.part[surface_.triangles[patches_[patch].triangle].source];
    }

    /// Of the patches of one cell: within each part the largest, with those across the solid from
    /// one another, stays; and all that stay are one piece.
    void keepLargest(const std::vector<uint32_t>& patches, const std::vector<Key>& keys,
                     Through& through, std::vector<uint8_t>& attached) {
        std::map<uint32_t, std::vector<uint32_t>> ofPart;
        for (const uint32_t p : patches) ofPart[partOf(p)].push_back(p);
        uint32_t first = kNone;
        for (const auto& [part, here] : ofPart) {
            if (here.size() > 1) {
                for (const uint32_t p : here) {
                    const uint32_t hit = through.opposite(patches_[p].triangle);
                    if (hit == kNone) continue;
                    const uint32_t q = patchOf(hit);
                    if (keys[q] == keys[p] && partOf(q) == part) owner_.unite(p, q);
                }
            }
            std::map<uint32_t, double> area;
            for (const uint32_t p : here) area[owner_.find(p)] += patches_[p].area;
            uint32_t best = owner_.find(here[0]);
            for (const auto& [cluster, size] : area)
                if (size > area[best]) best = cluster;
            for (const uint32_t p : here) attached[p] = owner_.find(p) == best ? 1 : 0;
            if (first == kNone) first = best;
            owner_.unite(first, best);
        }
    }

    /// Each stray joins, of the neighbours that stay, the one with the longest border; strays among
    /// strays follow.
    void attachStrays(const CellLevel& cells, std::vector<uint8_t>& attached) {
        std::map<std::pair<uint32_t, uint32_t>, double> border;  // stray, neighbour
        for (uint32_t h = 0; h < 3 * surface_.triangles.size(); ++h) {
            const uint32_t o = topology_.opposite[h];
            if (o == kNone || cells.domain[h / 3] != cells.domain[o / 3]) continue;
            const uint32_t p = patchOf(h / 3);
            const uint32_t q = patchOf(o / 3);
            if (p == q || attached[p] != 0) continue;
            border[{p, q}] += edgeLength(surface_, h);
        }
        // Clusters of strays were united with one another; each patch now goes its own way.
        UnionFind kept(patches_.size());
        for (uint32_t p = 0; p < patches_.size(); ++p)
            if (attached[p] != 0) kept.unite(p, owner_.find(p));
        owner_ = std::move(kept);
        for (bool changed = true; changed;) {
            changed = false;
            std::map<uint32_t, std::pair<double, uint32_t>> best;
            for (const auto& [pair, length] : border) {
                if (attached[pair.first] != 0 || attached[pair.second] == 0) continue;
                const auto [it, isNew] = best.try_emplace(pair.first, length, pair.second);
                if (!isNew && length > it->second.first) it->second = {length, pair.second};
            }
            for (const auto& [stray, target] : best) {
                owner_.unite(stray, target.second);
                attached[stray] = 1;
                changed = true;
            }
        }
    }

    const SplitSurface& surface_;
    const MeshTopology& topology_;
    const PartGroups& groups_;
    const Components& base_;
    uint32_t level_;
    std::vector<Patch> patches_;
    UnionFind owner_;  ///< over patches
};

}  // namespace

Components findPieces(const SplitSurface& surface, const MeshTopology& topology,
                      const LineTable& lines, uint32_t levels, const PartGroups& groups,
                      std::span<const CellLevel> cells, const PatchOptions& options,
                      std::vector<CellReport>& reports) {
    Components base = floodFill(surface, topology, lines, levels);
    if (cells.empty() || levels == 0) return base;
    Through through(surface);
    std::vector<std::vector<uint32_t>> piece;  // [level - 1][leaf]
    std::vector<uint32_t> count;
    for (uint32_t k = 1; k <= levels; ++k) {
        const std::vector<uint32_t> parent =
            k == 1 ? std::vector<uint32_t>(base.leafCount, 0) : piece[k - 2];
        LevelGrouping grouping(surface, topology, groups, base, lines, k, parent);
        const auto level = std::find_if(cells.begin(), cells.end(),
                                        [k](const CellLevel& c) { return c.level == k; });
        uint32_t strays = 0;
        const std::vector<uint32_t> ofPatch =
            level == cells.end() || !level->cellOf || options.splitPatches
                ? grouping.byPatch(k == 1 ? nullptr : &base.ofLeaf[k - 2])
                : grouping.byCell(*level, through, strays);
        std::vector<std::pair<uint32_t, uint32_t>> label;
        for (uint32_t leaf = 0; leaf < base.leafCount; ++leaf)
            label.emplace_back(parent[leaf], ofPatch[base.ofLeaf[k - 1][leaf]]);
        piece.push_back(compactLabels(label, count.emplace_back()));
        if (level == cells.end()) continue;
        reports.push_back({k, level->asked, count.back(), level->domains, strays, level->text});
    }

    Components result;
    result.levels = levels;
    result.parts = base.parts;
    const std::vector<uint32_t>& deepest = piece.back();
    result.leafCount = count.back();
    result.leaf.reserve(base.leaf.size());
    for (const uint32_t leaf : base.leaf) result.leaf.push_back(deepest[leaf]);
    result.count = count;
    for (const std::vector<uint32_t>& ofLeaf : piece) {
        std::vector<uint32_t> labels(result.leafCount);
        for (uint32_t leaf = 0; leaf < base.leafCount; ++leaf) labels[deepest[leaf]] = ofLeaf[leaf];
        result.ofLeaf.push_back(std::move(labels));
    }
    return result;
}

}  // namespace sherd
