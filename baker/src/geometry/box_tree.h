// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace sherd {

struct FloatBox {
    glm::vec3 low{0}, high{0};
    bool meets(const FloatBox& b) const {
        // Without branches: whether boxes meet is hard to guess.
        return (static_cast<int>(low.x <= b.high.x) & static_cast<int>(b.low.x <= high.x) &
                static_cast<int>(low.y <= b.high.y) & static_cast<int>(b.low.y <= high.y) &
                static_cast<int>(low.z <= b.high.z) & static_cast<int>(b.low.z <= high.z)) != 0;
    }
};

/// The box around each triangle.
std::vector<FloatBox> boxesOf(std::span<const glm::vec3> positions,
                              std::span<const std::array<uint32_t, 3>> triangles);

/// Boxes in a binary tree, at most four to a leaf. Built in linear time: for questions that would
/// not repay a better tree.
class BoxTree {
  public:
    explicit BoxTree(std::vector<FloatBox> boxes);

    size_t leafCount() const { return leaves_.size(); }

    /// visit(a, b) once for every pair of boxes that meet, a being in the leaf, b there or in a
    /// later one. Returns how many pairs were looked at; stops beyond `limit` of them.
    template <class Visit>
    size_t pairsOf(size_t leaf, size_t limit, const Visit& visit) const;

    /// visit(item) for the items whose box `wants(box)`, until it returns true. Whether it did. A
    /// box that is not wanted holds none that is.
    template <class Wants, class Visit>
    bool any(const Wants& wants, const Visit& visit) const;

    /// visit(item, limit) for items whose box the ray enters before `limit` lengths of `along`;
    /// nearer nodes first. `visit` may lower the limit.
    template <class Visit>
    void along(const glm::dvec3& from, const glm::dvec3& along, double limit,
               const Visit& visit) const;

  private:
    static constexpr uint32_t kLeafSize = 4;
    /// Each level tells one of 30 bits apart, or halves what is in one step of the curve.
    static constexpr size_t kMaxDepth = 64;
    struct Node {
        FloatBox box;
        uint32_t first = 0, last = 0;  ///< its items
        uint32_t right = 0;            ///< its right child, the left one is next; 0: a leaf
    };
    uint32_t build(uint32_t first, uint32_t last, const std::vector<uint32_t>& codes);
    static double enters(const FloatBox& box, const glm::dvec3& from, const glm::dvec3& inverse);

    std::vector<uint32_t> items_;   ///< along the curve
    std::vector<FloatBox> boxes_;   ///< of items_, in their order
    std::vector<Node> nodes_;       ///< depth first
    std::vector<uint32_t> leaves_;  ///< those of nodes_
};

template <class Visit>
size_t BoxTree::pairsOf(size_t leaf, size_t limit, const Visit& visit) const {
    const Node& own = nodes_[leaves_[leaf]];
    std::array<uint32_t, kMaxDepth> stack;
    size_t depth = 0, looked = 0;
    stack[depth++] = 0;
    while (depth > 0 && looked <= limit) {
        const uint32_t index = stack[--depth];
        const Node& node = nodes_[index];
        if (node.last <= own.first || !node.box.meets(own.box)) continue;
        if (node.right > 0) {
            stack[depth++] = node.right;
            stack[depth++] = index + 1;
            continue;
        }
        for (uint32_t a = own.first; a < own.last; ++a) {
            if (!boxes_[a].meets(node.box)) continue;
            for (uint32_t b = std::max(node.first, a + 1); b < node.last; ++b) {
                ++looked;
                if (boxes_[a].meets(boxes_[b])) visit(items_[a], items_[b]);
            }
        }
    }
    return looked;
}

template <class Wants, class Visit>
bool BoxTree::any(const Wants& wants, const Visit& visit) const {
    if (nodes_.empty()) return false;
    std::array<uint32_t, kMaxDepth> stack;
    size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const uint32_t index = stack[--depth];
        const Node& node = nodes_[index];
        if (!wants(node.box)) continue;
        if (node.right > 0) {
            stack[depth++] = node.right;
            stack[depth++] = index + 1;
            continue;
        }
        for (uint32_t i = node.first; i < node.last; ++i)
            if (wants(boxes_[i]) && visit(items_[i])) return true;
    }
    return false;
}

/// Lengths of the ray until it is in the box, 1e300 if it never is. `inverse` is 1 / along, and
/// 1e300 where that is 0: infinity times 0 would be no number.
inline double BoxTree::enters(const FloatBox& box, const glm::dvec3& from,
                              const glm::dvec3& inverse) {
    double enter = 0;
    double leave = 1e300;
    for (int k = 0; k < 3; ++k) {
        const double x = (box.low[k] - from[k]) * inverse[k];
        const double y = (box.high[k] - from[k]) * inverse[k];
        const double first = x < y ? x : y, last = x < y ? y : x;
        if (first > enter) enter = first;
        if (last < leave) leave = last;
    }
    return enter <= leave ? enter : 1e300;
}

template <class Visit>
void BoxTree::along(const glm::dvec3& from, const glm::dvec3& along, double limit,
                    const Visit& visit) const {
    if (nodes_.empty()) return;
    glm::dvec3 inverse;
    for (int k = 0; k < 3; ++k) inverse[k] = along[k] == 0 ? 1e300 : 1 / along[k];
    struct Entry {
        uint32_t node;
        double enter;
    };
    std::array<Entry, kMaxDepth> stack;
    size_t depth = 0;
    stack[depth++] = {0, enters(nodes_[0].box, from, inverse)};
    while (depth > 0) {
        const Entry entry = stack[--depth];
        if (entry.enter >= limit) continue;
        const Node& node = nodes_[entry.node];
        if (node.right > 0) {
            Entry near{entry.node + 1, enters(nodes_[entry.node + 1].box, from, inverse)};
            Entry far{node.right, enters(nodes_[node.right].box, from, inverse)};
            if (far.enter < near.enter) std::swap(near, far);
            if (far.enter < limit) stack[depth++] = far;
            if (near.enter < limit) stack[depth++] = near;
            continue;
        }
        for (uint32_t i = node.first; i < node.last; ++i) visit(items_[i], limit);
    }
}

}  // namespace sherd
