// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace sherd {

/// Distances to a set of triangles: a binary tree of bounding boxes, split at the median.
class TriangleTree {
  public:
    TriangleTree(const std::vector<glm::vec3>& positions,
                 const std::vector<std::array<uint32_t, 3>>& triangles);

    /// Distance to the nearest triangle; stops as soon as it is known to be at most `enough`.
    double distance(const glm::dvec3& point, double enough) const;

    /// visit(s, t) for every two triangles whose bounding boxes meet, until it returns false.
    template <class Visit>
    void forEachMeetingPair(Visit visit) const;

    /// visit(t) for triangles whose bounding box the ray may reach within `limit` lengths, which
    /// `visit` may lower.
    template <class Visit>
    void forEachAlong(const glm::dvec3& from, const glm::dvec3& along, const double& limit,
                      Visit visit) const;

  private:
    struct Node {
        glm::vec3 low{0};
        glm::vec3 high{0};
        uint32_t first = 0;  ///< triangles of a leaf, or the second child
        uint32_t count = 0;  ///< 0: an inner node, its first child follows it
    };
    uint32_t build(uint32_t begin, uint32_t end);
    Node boxOf(const std::array<uint32_t, 3>& triangle) const;
    static float extent(const Node& node) {
        return node.high.x - node.low.x + node.high.y - node.low.y + node.high.z - node.low.z;
    }
    static bool meet(const Node& a, const Node& b);
    static double reached(const Node& box, const glm::dvec3& from, const glm::dvec3& along);
    uint32_t firstChild(uint32_t node) const { return node + 1; }
    uint32_t secondChild(uint32_t node) const { return nodes_[node].first; }
    template <class Visit>
    bool visitLeaves(const Node& a, const Node& b, bool same, Visit& visit) const;

    const std::vector<glm::vec3>& positions_;
    std::vector<std::array<uint32_t, 3>> triangles_;
    std::vector<Node> nodes_;
};

template <class Visit>
bool TriangleTree::visitLeaves(const Node& a, const Node& b, bool same, Visit& visit) const {
    for (uint32_t i = a.first; i < a.first + a.count; ++i) {
        const Node box = boxOf(triangles_[i]);
        for (uint32_t j = same ? i + 1 : b.first; j < b.first + b.count; ++j)
            if (meet(box, boxOf(triangles_[j])) && !visit(triangles_[i], triangles_[j]))
                return false;
    }
    return true;
}

/// The tree is held against itself: of two nodes that meet the larger one is opened.
template <class Visit>
void TriangleTree::forEachMeetingPair(Visit visit) const {
    std::vector<std::array<uint32_t, 2>> stack;
    if (!nodes_.empty()) stack.push_back({0, 0});
    while (!stack.empty()) {
        const auto [a, b] = stack.back();
        stack.pop_back();
        const Node &na = nodes_[a], &nb = nodes_[b];
        if (a != b && !meet(na, nb)) continue;
        if (na.count > 0 && nb.count > 0) {
            if (!visitLeaves(na, nb, a == b, visit)) return;
            continue;
        }
        if (a == b) {
            const uint32_t one = firstChild(a), two = secondChild(a);
            stack.insert(stack.end(), {{one, one}, {two, two}, {one, two}});
            continue;
        }
        const bool openA = nb.count > 0 || (na.count == 0 && extent(na) >= extent(nb));
        const uint32_t opened = openA ? a : b, kept = openA ? b : a;
        stack.push_back({firstChild(opened), kept});
        stack.push_back({secondChild(opened), kept});
    }
}

template <class Visit>
void TriangleTree::forEachAlong(const glm::dvec3& from, const glm::dvec3& along,
                                const double& limit, Visit visit) const {
    std::vector<uint32_t> stack;
    if (!nodes_.empty()) stack.push_back(0);
    while (!stack.empty()) {
        const uint32_t index = stack.back();
        const Node& node = nodes_[index];
        stack.pop_back();
        if (reached(node, from, along) > limit) continue;
        if (node.count > 0) {
            for (uint32_t t = node.first; t < node.first + node.count; ++t) visit(triangles_[t]);
            continue;
        }
        // The nearer child last, so that it is next.
        uint32_t near = firstChild(index), far = secondChild(index);
        if (reached(nodes_[far], from, along) < reached(nodes_[near], from, along))
            std::swap(near, far);
        stack.push_back(far);
        stack.push_back(near);
    }
}

}  // namespace sherd
