// SPDX-License-Identifier: MIT
// All triangles of a fracture set, each once, with the fragments that show them. A coarse fragment
// consists of its leaves' triangles, those left out that its level does not expose: so every
// question is put to each triangle once and answered for all levels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd {

class ShownTriangles {
  public:
    struct Triangle {
        std::array<uint32_t, 3> v;
        uint32_t leaf;         ///< the undivided fragment it belongs to
        uint32_t exposedFrom;  ///< level; 0: the outer surface
        bool sheet;            ///< of the medial surface
    };

    /// The set must outlive it and have passed the rules of its format.
    explicit ShownTriangles(const FractureSet& set);

    const FractureSet& set() const { return set_; }
    /// In an order that keeps near ones near each other.
    const std::vector<Triangle>& triangles() const { return triangles_; }
    std::vector<std::array<uint32_t, 3>> corners() const;

    std::array<glm::dvec3, 3> places(uint32_t triangle) const {
        const auto& v = triangles_[triangle].v;
        const auto& p = set_.geometry.positions;
        return {glm::dvec3(p[v[0]]), glm::dvec3(p[v[1]]), glm::dvec3(p[v[2]])};
    }

    /// visit(fragment) for all that show the triangle, the leaf first.
    template <class Visit>
    void forEachShowing(uint32_t triangle, const Visit& visit) const {
        const Triangle& t = triangles_[triangle];
        forEachAbove(t.leaf, t.exposedFrom, visit);
    }

    /// visit(fragment) for all that show both; none if they are never seen together.
    template <class Visit>
    void forEachShowing(uint32_t a, uint32_t b, const Visit& visit) const {
        const Triangle &s = triangles_[a], &t = triangles_[b];
        const uint32_t exposed = s.exposedFrom > t.exposedFrom ? s.exposedFrom : t.exposedFrom;
        forEachAbove(commonOf(s.leaf, t.leaf), exposed, visit);
    }

    /// Whether some fragment shows both.
    bool shownTogether(uint32_t a, uint32_t b) const {
        const Triangle &s = triangles_[a], &t = triangles_[b];
        const uint32_t level = level_[commonOf(s.leaf, t.leaf)];
        return s.exposedFrom <= level && t.exposedFrom <= level;
    }

    uint32_t levelOf(uint32_t fragment) const { return level_[fragment]; }

    /// The fragment that a leaf is part of at a level.
    uint32_t fragmentAt(uint32_t level, uint32_t leaf) const {
        while (level_[leaf] > level) leaf = parent_[leaf];
        return leaf;
    }

  private:
    uint32_t commonOf(uint32_t a, uint32_t b) const {
        // Parents come before their children.
        while (a != b) (a > b ? a : b) = parent_[a > b ? a : b];
        return a;
    }
    template <class Visit>
    void forEachAbove(uint32_t fragment, uint32_t exposedFrom, const Visit& visit) const {
        for (; level_[fragment] >= exposedFrom; fragment = parent_[fragment]) {
            visit(fragment);
            if (fragment == 0) return;
        }
    }

    const FractureSet& set_;
    std::vector<Triangle> triangles_;
    std::vector<uint32_t> level_, parent_;  ///< per fragment; the object is its own parent
};

}  // namespace sherd
