// SPDX-License-Identifier: MIT
#include "levels/sliver_joining.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "geometry/closed_mesh.h"
#include "geometry/compact_labels.h"
#include "geometry/triangle.h"
#include "geometry/union_find.h"
#include "levels/leaf_cut.h"
#include "levels/level_exposure.h"

namespace sherd {
namespace {

/// Of the parent's volume. Below what cuts of single leaves leave: those stay as they are.
constexpr double kSmallestShare = 1e-10;

class SliverJoiner {
  public:
    explicit SliverJoiner(const PieceModel& model)
        : model_(model),
          level_(model.components.levels),
          groups_(model.components.count[level_ - 1]),
          volumes_(model.components.count[level_ - 1], 0),
          parentOf_(volumes_.size(), 0) {}

    uint32_t run() {
        measure();
        uint32_t joined = 0;
        for (const std::vector<uint32_t>& siblings : siblings_) {
            double whole = 0;
            for (const uint32_t p : siblings) whole += volumes_[p];
            joined += joinAmong(siblings, kSmallestShare * std::max(whole, 0.0));
        }
        if (joined > 0) store();
        return joined;
    }

  private:
    uint32_t pieceOf(uint32_t leaf) const { return model_.components.at(level_, leaf); }

    /// Walls within a piece are there from both sides, and count for nothing.
    void measure() {
        const std::vector<std::vector<uint32_t>> faces = facesOfLeaves(model_);
        const auto outer = static_cast<uint32_t>(model_.surface.triangles.size());
        std::vector<std::array<uint32_t, 3>> triangles;
        for (uint32_t leaf = 0; leaf < faces.size(); ++leaf) {
            triangles.clear();
            for (const uint32_t f : faces[leaf])
                triangles.push_back(f < outer ? model_.surface.triangles[f].v
                                              : model_.hidden.faces[f - outer].v);
            parentOf_[pieceOf(leaf)] = level_ > 1 ? model_.components.at(level_ - 1, leaf) : 0;
            if (triangles.empty()) continue;
            const glm::dvec3 origin = model_.hidden.positions[triangles[0][0]];
            volumes_[pieceOf(leaf)] += signedVolume(model_.hidden.positions, triangles, origin);
        }
        siblings_.resize(level_ > 1 ? model_.components.count[level_ - 2] : 1);
        for (uint32_t p = 0; p < parentOf_.size(); ++p) siblings_[parentOf_[p]].push_back(p);
    }

    uint32_t joinAmong(const std::vector<uint32_t>& siblings, double smallest) {
        std::vector<uint32_t> alone = siblings;  // one of each group
        uint32_t joined = 0;
        while (alone.size() > 1) {
            const auto least =
                std::min_element(alone.begin(), alone.end(),
                                 [&](uint32_t a, uint32_t b) { return volumes_[a] < volumes_[b]; });
            if (volumes_[*least] > smallest) break;
            const uint32_t sliver = *least;
            alone.erase(least);
            const uint32_t other = neighbourOf(sliver, alone);
            const double volume = volumes_[sliver] + volumes_[other];
            groups_.unite(sliver, other);
            const uint32_t now = groups_.find(sliver);
            std::replace(alone.begin(), alone.end(), other, now);
            volumes_[now] = volume;
            ++joined;
        }
        return joined;
    }

    uint32_t neighbourOf(uint32_t sliver, const std::vector<uint32_t>& others) {
        std::map<uint32_t, double> shared;
        for (const auto& [pieces, area] : areas()) {
            const uint32_t a = groups_.find(pieces.first), b = groups_.find(pieces.second);
            if (a == sliver && b != sliver) shared[b] += area;
            if (b == sliver && a != sliver) shared[a] += area;
        }
        const auto rank = [&](uint32_t p) {
            const auto area = shared.find(p);
            return std::make_pair(area == shared.end() ? 0 : area->second, volumes_[p]);
        };
        return *std::max_element(others.begin(), others.end(),
                                 [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
    }

    using Areas = std::map<std::pair<uint32_t, uint32_t>, double>;

    /// Of walls, by the two pieces: slivers are rare, so this is found for the first of them.
    const Areas& areas() {
        if (!areas_.empty()) return areas_;
        areas_[{0, 0}] = 0;
        const std::vector<uint32_t> places = placesOf(model_);
        std::map<std::array<uint32_t, 3>, std::vector<uint32_t>> pieces;  // by places, ascending
        for (const HiddenMesh::Face& face : model_.hidden.faces) {
            std::array<uint32_t, 3> key{places[face.v[0]], places[face.v[1]], places[face.v[2]]};
            std::sort(key.begin(), key.end());
            const uint32_t piece = pieceOf(face.leaf);
            std::vector<uint32_t>& others = pieces[key];
            for (const uint32_t other : others)
                areas_[std::minmax(other, piece)] += triangleArea(model_.hidden.positions, face.v);
            others.push_back(piece);
        }
        return areas_;
    }

    void store() {
        Components& components = model_.components;
        std::vector<uint32_t> sizes(volumes_.size(), 0);
        for (uint32_t p = 0; p < sizes.size(); ++p) ++sizes[groups_.find(p)];
        // Walls of what is one piece now show only if something is left of them.
        for (HiddenMesh::Face& face : model_.hidden.faces) {
            if (face.wall && face.exposedFrom == level_ &&
                sizes[groups_.find(pieceOf(face.leaf))] > 1)
                face.exposedFrom = kNotExposed;
        }
        std::vector<uint32_t> labels;
        for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf)
            labels.push_back(groups_.find(pieceOf(leaf)));
        components.ofLeaf.back() = compactLabels(labels, components.count.back());
    }

    const PieceModel& model_;
    uint32_t level_;
    UnionFind groups_;
    std::vector<double> volumes_;  ///< of a group: at its lowest piece
    std::vector<uint32_t> parentOf_;
    std::vector<std::vector<uint32_t>> siblings_;
    Areas areas_;
};

}  // namespace

uint32_t joinSlivers(const PieceModel& model) {
    return SliverJoiner(model).run();
}

}  // namespace sherd
