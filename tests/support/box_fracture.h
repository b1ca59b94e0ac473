// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd::test {

/// A box cut into a grid of boxes, and each of those into a grid again: two levels whose masses,
/// inertias, bonds and colliders are known exactly.
struct BoxFracture {
    glm::vec3 size{1.0F};        ///< metres
    glm::ivec3 level1{2, 2, 2};  ///< cuts the object
    glm::ivec3 level2{1, 1, 1};  ///< cuts every level 1 fragment; 1, 1, 1: a single level
    float density = 1000;        ///< kg/m^3
    float toughness = 50;        ///< J/m^2
    float hullGrowth = 0;        ///< metres: fragment colliders stick out by this and so overlap
    glm::vec3 center{0.0F};      ///< of the box in the object frame
};

namespace box_fracture {

struct Box {
    glm::vec3 low;
    glm::vec3 high;
};

inline std::vector<Box> divide(const Box& box, glm::ivec3 counts) {
    std::vector<Box> parts;
    const glm::vec3 step = (box.high - box.low) / glm::vec3(counts);
    for (int z = 0; z < counts.z; ++z) {
        for (int y = 0; y < counts.y; ++y) {
            for (int x = 0; x < counts.x; ++x) {
                const glm::vec3 low = box.low + step * glm::vec3(x, y, z);
                parts.push_back({low, low + step});
            }
        }
    }
    return parts;
}

inline void addHull(FractureSet& set, Fragment& fragment, const Box& box, float growth) {
    const glm::vec3 extent = box.high - box.low;
    const float margin = 0.05F * std::min({extent.x, extent.y, extent.z});
    fragment.hulls = {uint32_t(set.hulls.size()), 1};
    set.hulls.push_back({{uint32_t(set.hullPoints.size()), 8}, margin});
    const glm::vec3 low = box.low + glm::vec3(margin - growth);
    const glm::vec3 high = box.high - glm::vec3(margin - growth);
    for (int corner = 0; corner < 8; ++corner) {
        set.hullPoints.emplace_back((corner & 1) ? high.x : low.x, (corner & 2) ? high.y : low.y,
                                    (corner & 4) ? high.z : low.z);
    }
}

inline Fragment makeFragment(FractureSet& set, const Box& box, int32_t parent, uint32_t level,
                             const BoxFracture& recipe) {
    Fragment fragment;
    const glm::vec3 e = box.high - box.low;
    fragment.parent = parent;
    fragment.level = level;
    fragment.volume = e.x * e.y * e.z;
    fragment.mass = fragment.volume * recipe.density;
    fragment.density = recipe.density;
    fragment.toughness = recipe.toughness;
    fragment.centerOfMass = (box.low + box.high) * 0.5F;
    fragment.inertiaDiagonal =
        glm::vec3(e.y * e.y + e.z * e.z, e.x * e.x + e.z * e.z, e.x * e.x + e.y * e.y) *
        (fragment.mass / 12);
    addHull(set, fragment, box, level == 0 ? 0.0F : recipe.hullGrowth);
    return fragment;
}

/// The area two boxes share, its centroid and its normal from a to b; area 0: none.
inline Bond sharedFace(const Box& a, const Box& b) {
    Bond bond;
    for (int axis = 0; axis < 3; ++axis) {
        const bool above = std::abs(a.high[axis] - b.low[axis]) < 1e-6F;
        const bool below = std::abs(b.high[axis] - a.low[axis]) < 1e-6F;
        if (!above && !below) continue;
        const glm::vec3 low = glm::max(a.low, b.low);
        const glm::vec3 high = glm::min(a.high, b.high);
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        if (high[u] - low[u] < 1e-6F || high[v] - low[v] < 1e-6F) continue;
        bond.area = (high[u] - low[u]) * (high[v] - low[v]);
        bond.centroid = (low + high) * 0.5F;
        bond.normal = glm::vec3(0.0F);
        bond.normal[axis] = above ? 1.0F : -1.0F;
        return bond;
    }
    return bond;
}

/// Which primitive a leaf's face belongs to: the level at which it shows.
inline uint32_t exposure(const Box& object, const Box& parent, const Box& leaf, int axis,
                         bool high) {
    const auto on = [&](const Box& box) {
        const float plane = high ? box.high[axis] : box.low[axis];
        return std::abs(plane - (high ? leaf.high[axis] : leaf.low[axis])) < 1e-6F;
    };
    if (on(object)) return 0;
    return on(parent) ? 1 : 2;
}

inline void addFace(FractureGeometry& geometry, const Box& box, int axis, bool high) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto base = uint32_t(geometry.positions.size());
    glm::vec3 normal(0.0F);
    normal[axis] = high ? 1.0F : -1.0F;
    constexpr std::array<std::array<bool, 2>, 4> kCorners{
        {{false, false}, {true, false}, {true, true}, {false, true}}};
    for (const auto& corner : kCorners) {
        glm::vec3 p;
        p[axis] = high ? box.high[axis] : box.low[axis];
        p[u] = corner[0] ? box.high[u] : box.low[u];
        p[v] = corner[1] ? box.high[v] : box.low[v];
        geometry.positions.push_back(p);
        for (int c = 0; c < 3; ++c) geometry.attributes[0].values.push_back(normal[c]);
    }
    for (const uint32_t i : high ? std::array<uint32_t, 6>{0, 1, 2, 0, 2, 3}
                                 : std::array<uint32_t, 6>{0, 2, 1, 0, 3, 2}) {
        geometry.indices.push_back(base + i);
    }
}

/// Triangles leaf by leaf within each primitive, so that every fragment owns contiguous ranges.
inline void addGeometry(FractureSet& set, const Box& object, const std::vector<Box>& boxes,
                        const std::vector<uint32_t>& leaves) {
    FractureGeometry& geometry = set.geometry;
    geometry.attributes = {{"NORMAL", 3, {}}};
    set.materials = {-1, -1};
    const size_t fragmentCount = set.fragments.size();
    const auto primitiveCount = uint32_t(set.levels.size());
    std::array<std::vector<Range>, 3> ranges;
    for (uint32_t p = 0; p < primitiveCount; ++p) {
        ranges[p].assign(fragmentCount, Range{});
        const auto first = uint32_t(geometry.indices.size());
        for (const uint32_t leaf : leaves) {
            const int32_t parent = set.fragments[leaf].parent;
            const Box& outer = set.fragments[leaf].level == 1 ? boxes[leaf] : boxes[size_t(parent)];
            const auto start = uint32_t(geometry.indices.size());
            for (int axis = 0; axis < 3; ++axis) {
                for (const bool high : {false, true}) {
                    if (exposure(object, outer, boxes[leaf], axis, high) == p) {
                        addFace(geometry, boxes[leaf], axis, high);
                    }
                }
            }
            const uint32_t count = uint32_t(geometry.indices.size()) - start;
            for (auto f = int32_t(leaf); f >= 0; f = set.fragments[size_t(f)].parent) {
                Range& range = ranges[p][size_t(f)];
                if (range.count == 0) range.first = start;
                range.count += count;
            }
        }
        geometry.primitives.push_back(
            {p == 0 ? 0U : 1U, p, {first, uint32_t(geometry.indices.size()) - first}});
    }
    for (size_t f = 0; f < fragmentCount; ++f) {
        for (uint32_t p = 0; p < primitiveCount; ++p) set.fragmentRanges.push_back(ranges[p][f]);
    }
}

}  // namespace box_fracture

inline FractureSet makeBoxFracture(const BoxFracture& recipe = {}) {
    using namespace box_fracture;
    FractureSet set;
    set.name = "box";
    const Box object{recipe.center - recipe.size * 0.5F, recipe.center + recipe.size * 0.5F};
    std::vector<Box> boxes{object};
    set.fragments.push_back(makeFragment(set, object, -1, 0, recipe));
    std::vector<uint32_t> leaves;

    const bool twoLevels = recipe.level2 != glm::ivec3(1);
    std::vector<uint32_t> parents{0};
    for (uint32_t level = 1; level <= (twoLevels ? 2U : 1U); ++level) {
        leaves.clear();
        for (const uint32_t parent : parents) {
            const auto parts = divide(boxes[parent], level == 1 ? recipe.level1 : recipe.level2);
            set.fragments[parent].children = {uint32_t(set.fragments.size()),
                                              uint32_t(parts.size())};
            for (const Box& part : parts) {
                leaves.push_back(uint32_t(set.fragments.size()));
                boxes.push_back(part);
                set.fragments.push_back(makeFragment(set, part, int32_t(parent), level, recipe));
            }
        }
        parents = leaves;
    }
    for (size_t i = 0; i < leaves.size(); ++i) {
        for (size_t j = i + 1; j < leaves.size(); ++j) {
            Bond bond = sharedFace(boxes[leaves[i]], boxes[leaves[j]]);
            if (!(bond.area > 0)) continue;
            bond.a = int32_t(leaves[i]);
            bond.b = int32_t(leaves[j]);
            bond.toughness = recipe.toughness;
            set.bonds.push_back(bond);
        }
    }
    set.levels.push_back({{0, 1}, "object"});
    const uint32_t level1Count = set.fragments[0].children.count;
    set.levels.push_back({{1, level1Count}, "level 1"});
    if (twoLevels) set.levels.push_back({{1 + level1Count, uint32_t(leaves.size())}, "level 2"});
    addGeometry(set, object, boxes, leaves);
    return set;
}

}  // namespace sherd::test
