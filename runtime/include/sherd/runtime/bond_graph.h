// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd {

/// The support graph of an object: its leaves, the bonds between them and to the world. Leaves are
/// numbered so that every fragment, at whatever level, owns one run of them. Immutable.
class BondGraph {
  public:
    static constexpr uint32_t kWorld = UINT32_MAX;  ///< in place of a leaf: a bond is an anchor

    struct Bond {
        uint32_t a = 0;  ///< leaf
        uint32_t b = 0;  ///< leaf, or kWorld
        glm::vec3 centroid{0.0F};
        glm::vec3 normal{0.0F, 1.0F, 0.0F};  ///< unit, from a to b
        float area = 0;                      ///< m^2
        float strength = 0;                  ///< Pa
        float toughness = 0;                 ///< J/m^2
        float energy =
            0;  ///< that breaking it consumes: area x toughness x the dissipation of a, J
        uint32_t parting = 0;  ///< the deepest fragment that holds both sides; 0 of anchors
    };
    struct Edge {
        uint32_t bond;
        uint32_t other;  ///< the leaf across, or kWorld
    };

    /// Of a set whose tree and bonds were checked. Bonds of no area, and those within one leaf, are
    /// left out; a bond of a fragment that is divided counts for the first of its leaves.
    explicit BondGraph(const FractureSet& set);

    [[nodiscard]] uint32_t leafCount() const { return uint32_t(fragmentOfLeaf_.size()); }
    [[nodiscard]] uint32_t fragmentOfLeaf(uint32_t leaf) const { return fragmentOfLeaf_[leaf]; }
    /// The leaves that fill a fragment, a run.
    [[nodiscard]] Range leavesOf(uint32_t fragment) const { return leavesOf_[fragment]; }
    [[nodiscard]] bool contains(uint32_t fragment, uint32_t leaf) const {
        return leaf - leavesOf_[fragment].first < leavesOf_[fragment].count;
    }

    [[nodiscard]] std::span<const Bond> bonds() const { return bonds_; }
    [[nodiscard]] const Bond& bond(uint32_t b) const { return bonds_[b]; }
    /// The bonds of a leaf by what is across, anchors last.
    [[nodiscard]] std::span<const Edge> edgesOf(uint32_t leaf) const {
        return std::span(edges_).subspan(firstEdge_[leaf], firstEdge_[leaf + 1] - firstEdge_[leaf]);
    }
    /// Of all leaves of a run, one after the other.
    [[nodiscard]] std::span<const Edge> edgesOf(Range leaves) const {
        const uint32_t first = firstEdge_[leaves.first];
        return std::span(edges_).subspan(first, firstEdge_[leaves.first + leaves.count] - first);
    }
    [[nodiscard]] bool isAnchored(uint32_t fragment) const { return anchored_[fragment] != 0; }

    /// The child of `fragment` that holds `leaf`, one of its own.
    [[nodiscard]] uint32_t childWith(uint32_t fragment, uint32_t leaf) const;

  private:
    std::vector<Range> children_;
    std::vector<Range> leavesOf_;
    std::vector<uint32_t> fragmentOfLeaf_;
    std::vector<Bond> bonds_;
    std::vector<uint32_t> firstEdge_;
    std::vector<Edge> edges_;
    std::vector<uint8_t> anchored_;  ///< per fragment: some leaf of it has a bond to the world
};

}  // namespace sherd
