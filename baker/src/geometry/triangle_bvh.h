// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace sherd {

/// The nearest point of a set of triangles.
struct ClosestPoint {
    static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
    glm::dvec3 point{0};
    double distance2 = std::numeric_limits<double>::infinity();  ///< squared
    uint32_t triangle = kNone;                                   ///< kNone: nothing within reach
};

/// The point of triangle abc nearest to p; degenerate triangles are segments or points.
glm::dvec3 closestOnTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                             const glm::dvec3& c);

/// Closest points on triangles, by a bounding volume hierarchy split at the median.
class TriangleBvh {
  public:
    /// Copies what it needs. Indices must be below positions.size(); positions finite.
    TriangleBvh(std::span<const glm::vec3> positions,
                std::span<const std::array<uint32_t, 3>> triangles);

    /// The closest point no farther than maxDistance, among triangles that `accept(index)` allows.
    template <class Accept>
    ClosestPoint closest(const glm::dvec3& point, double maxDistance, const Accept& accept) const;

    ClosestPoint closest(const glm::dvec3& point,
                         double maxDistance = std::numeric_limits<double>::infinity()) const {
        return closest(point, maxDistance, [](uint32_t) { return true; });
    }

    /// visit(triangle, corners) for every triangle that may lie in boxes for which
    /// `wants(low, high)` is true.
    template <class Wants, class Visit>
    void forEach(const Wants& wants, const Visit& visit) const;

  private:
    struct Node {
        glm::vec3 low, high;
        uint32_t first =
            0;  ///< leaf: first item; inner node: its right child (the left one is next)
        uint32_t count = 0;  ///< items of a leaf; 0 for inner nodes
    };
    struct Item {
        std::array<glm::vec3, 3> corners;
        uint32_t triangle;
    };
    static constexpr uint32_t kLeafSize = 4;
    static constexpr size_t kMaxDepth = 64;

    void build(uint32_t first, uint32_t last, std::span<std::pair<glm::vec3, uint32_t>> centres);
    static double distance2(const Node& node, const glm::dvec3& p);

    std::vector<Node> nodes_;
    std::vector<Item> items_;
};

template <class Wants, class Visit>
void TriangleBvh::forEach(const Wants& wants, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<uint32_t, kMaxDepth> stack;
    size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const uint32_t index = stack[--depth];
        const Node& node = nodes_[index];
        if (!wants(node.low, node.high)) continue;
        if (node.count == 0) {
            stack[depth++] = node.first;
            stack[depth++] = index + 1;
            continue;
        }
        for (uint32_t i = node.first; i < node.first + node.count; ++i)
            visit(items_[i].triangle, items_[i].corners);
    }
}

inline double TriangleBvh::distance2(const Node& node, const glm::dvec3& p) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double below = node.low[k] - p[k], above = p[k] - node.high[k];
        const double d = below > above ? below : above;
        if (d > 0) sum += d * d;
    }
    return sum;
}

template <class Accept>
ClosestPoint TriangleBvh::closest(const glm::dvec3& point, double maxDistance,
                                  const Accept& accept) const {
    ClosestPoint best;
    if (nodes_.empty()) return best;
    double reach = maxDistance * maxDistance;
    std::array<std::pair<uint32_t, double>, kMaxDepth> stack;
    size_t depth = 0;
    stack[depth++] = {0, distance2(nodes_[0], point)};
    while (depth > 0) {
        const auto [index, nodeDistance] = stack[--depth];
        if (nodeDistance > reach) continue;
        const Node& node = nodes_[index];
        if (node.count == 0) {
            std::pair<uint32_t, double> near{index + 1, distance2(nodes_[index + 1], point)};
            std::pair<uint32_t, double> far{node.first, distance2(nodes_[node.first], point)};
            if (far.second < near.second) std::swap(near, far);
            if (far.second <= reach) stack[depth++] = far;
            if (near.second <= reach) stack[depth++] = near;
            continue;
        }
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Item& item = items_[i];
            if (!accept(item.triangle)) continue;
            const glm::dvec3 q =
                closestOnTriangle(point, glm::dvec3(item.corners[0]), glm::dvec3(item.corners[1]),
                                  glm::dvec3(item.corners[2]));
            const glm::dvec3 d = q - point;
            const double d2 = d.x * d.x + d.y * d.y + d.z * d.z;
            // Equal distances go to the lower index, whatever the shape of the tree.
            if (d2 > reach || (d2 == best.distance2 && item.triangle > best.triangle)) continue;
            best = {q, d2, item.triangle};
            reach = d2;
        }
    }
    return best;
}

}  // namespace sherd
