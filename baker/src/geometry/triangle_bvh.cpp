// SPDX-License-Identifier: MIT
#include "geometry/triangle_bvh.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace sherd {
namespace {

/// The point of segment ab nearest to p.
glm::dvec3 closestOnSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 ab = b - a;
    const double length2 = glm::dot(ab, ab);
    if (!(length2 > 0)) return a;
    return a + ab * std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0);
}

glm::dvec3 closestOnEdges(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c) {
    glm::dvec3 best = a;
    double bestDistance = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& q :
         {closestOnSegment(p, a, b), closestOnSegment(p, b, c), closestOnSegment(p, c, a)}) {
        const double distance = glm::dot(q - p, q - p);
        if (distance < bestDistance) {
            bestDistance = distance;
            best = q;
        }
    }
    return best;
}

}  // namespace

// C. Ericson, "Real-Time Collision Detection" (2005), 5.1.5: the Voronoi regions of a triangle, by
// barycentric signs. Above the face the foot of the perpendicular is taken, not the corners
// weighed: on a needle, whose height is a rounding error, weights have two right digits, and the
// place along it would. Slivers whose normal vanishes are treated as their three edges.
glm::dvec3 closestOnTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                             const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const glm::dvec3 bp = p - b;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const glm::dvec3 cp = p - c;
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    const double sum = va + vb + vc;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double flat = 1e-24 * glm::dot(ab, ab) * glm::dot(ac, ac);
    if (va <= 0 || vb <= 0 || vc <= 0 || !(sum > 0) || glm::dot(normal, normal) <= flat) {
        return closestOnEdges(p, a, b, c);
    }
    return p - normal * (glm::dot(ap, normal) / glm::dot(normal, normal));
}

TriangleBvh::TriangleBvh(std::span<const glm::vec3> positions,
                         std::span<const std::array<uint32_t, 3>> triangles) {
    if (triangles.empty()) return;
    std::vector<std::pair<glm::vec3, uint32_t>> centres;
    std::vector<Item> source;
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        const auto& t = triangles[i];
        source.push_back({{positions[t[0]], positions[t[1]], positions[t[2]]}, i});
        centres.emplace_back(
            positions[t[0]] / 3.0F + positions[t[1]] / 3.0F + positions[t[2]] / 3.0F, i);
    }
    items_ = std::move(source);
    nodes_.reserve(items_.size());
    build(0, static_cast<uint32_t>(items_.size()), centres);
    std::vector<Item> ordered;
    ordered.reserve(items_.size());
    for (const auto& centre : centres) ordered.push_back(items_[centre.second]);
    items_ = std::move(ordered);
}

/// Builds the subtree over centres[first, last); items_ are still in input order.
void TriangleBvh::build(uint32_t first, uint32_t last,
                        std::span<std::pair<glm::vec3, uint32_t>> centres) {
    const auto self = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    if (last - first <= kLeafSize) {
        Node leaf{items_[centres[first].second].corners[0],
                  items_[centres[first].second].corners[0], first, last - first};
        for (uint32_t i = first; i < last; ++i) {
            for (const glm::vec3& p : items_[centres[i].second].corners) {
                leaf.low = glm::min(leaf.low, p);
                leaf.high = glm::max(leaf.high, p);
            }
        }
        nodes_[self] = leaf;
        return;
    }
    glm::vec3 low = centres[first].first, high = low;
    for (uint32_t i = first; i < last; ++i) {
        low = glm::min(low, centres[i].first);
        high = glm::max(high, centres[i].first);
    }
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const uint32_t middle = first + (last - first) / 2;
    std::nth_element(centres.begin() + first, centres.begin() + middle, centres.begin() + last,
                     [axis](const auto& a, const auto& b) {
                         return a.first[axis] != b.first[axis] ? a.first[axis] < b.first[axis]
                                                               : a.second < b.second;
                     });
    build(first, middle, centres);
    const auto right = static_cast<uint32_t>(nodes_.size());
    build(middle, last, centres);
    const Node &l = nodes_[self + 1], &r = nodes_[right];
    nodes_[self] = {glm::min(l.low, r.low), glm::max(l.high, r.high), right, 0};
}

}  // namespace sherd
