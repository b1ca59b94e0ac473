// SPDX-License-Identifier: MIT
#include "triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace sherd {

namespace {

double squaredToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 ab = b - a;
    const double length = glm::dot(ab, ab);
    const double t = length > 0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
    const glm::dvec3 d = p - (a + t * ab);
    return glm::dot(d, d);
}

/// Either the foot of the perpendicular lies in the triangle, or an edge is nearest.
double squaredToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                         const glm::dvec3& c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double nn = glm::dot(n, n);
    const bool above = nn > 0 && glm::dot(glm::cross(b - a, p - a), n) >= 0 &&
                       glm::dot(glm::cross(c - b, p - b), n) >= 0 &&
                       glm::dot(glm::cross(a - c, p - c), n) >= 0;
    if (above) {
        const double height = glm::dot(p - a, n);
        return height * height / nn;
    }
    return std::min(
        {squaredToSegment(p, a, b), squaredToSegment(p, b, c), squaredToSegment(p, c, a)});
}

double squaredToBox(const glm::dvec3& p, const glm::vec3& low, const glm::vec3& high) {
    const glm::dvec3 d =
        glm::max(glm::max(glm::dvec3(low) - p, p - glm::dvec3(high)), glm::dvec3(0.0));
    return glm::dot(d, d);
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<glm::vec3>& positions,
                           const std::vector<std::array<uint32_t, 3>>& triangles)
    : positions_(positions), triangles_(triangles) {
    nodes_.reserve(triangles.size());
    if (!triangles_.empty()) build(0, static_cast<uint32_t>(triangles_.size()));
}

uint32_t TriangleTree::build(uint32_t begin, uint32_t end) {
    const auto index = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(-std::numeric_limits<float>::max());
    for (uint32_t t = begin; t < end; ++t)
        for (const uint32_t v : triangles_[t]) {
            low = glm::min(low, positions_[v]);
            high = glm::max(high, positions_[v]);
        }
    nodes_[index].low = low;
    nodes_[index].high = high;
    if (end - begin <= 4) {
        nodes_[index].first = begin;
        nodes_[index].count = end - begin;
        return index;
    }
    const glm::vec3 size = high - low;
    int axis = size.y > size.x ? 1 : 0;
    if (size.z > size[axis]) axis = 2;
    const auto key = [&](const std::array<uint32_t, 3>& t) {
        return positions_[t[0]][axis] + positions_[t[1]][axis] + positions_[t[2]][axis];
    };
    const uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle,
                     triangles_.begin() + end,
                     [&](const auto& a, const auto& b) { return key(a) < key(b); });
    build(begin, middle);
    const uint32_t second = build(middle, end);
    nodes_[index].first = second;
    return index;
}

TriangleTree::Node TriangleTree::boxOf(const std::array<uint32_t, 3>& triangle) const {
    const glm::vec3 &a = positions_[triangle[0]], &b = positions_[triangle[1]],
                    &c = positions_[triangle[2]];
    return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), 0, 0};
}

bool TriangleTree::meet(const Node& a, const Node& b) {
    for (int k = 0; k < 3; ++k)
        if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
    return true;
}

/// Lengths of `along` after which the ray is in the box; infinite if it passes by.
double TriangleTree::reached(const Node& box, const glm::dvec3& from, const glm::dvec3& along) {
    double begin = 0;
    double end = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const double toLow = box.low[k] - from[k], toHigh = box.high[k] - from[k];
        if (along[k] == 0) {
            if (toLow > 0 || toHigh < 0) return std::numeric_limits<double>::infinity();
            continue;
        }
        begin = std::max(begin, std::min(toLow / along[k], toHigh / along[k]));
        end = std::min(end, std::max(toLow / along[k], toHigh / along[k]));
    }
    return begin <= end ? begin : std::numeric_limits<double>::infinity();
}

double TriangleTree::distance(const glm::dvec3& point, double enough) const {
    double best = std::numeric_limits<double>::max();
    std::array<uint32_t, 64> stack{};  // the tree is balanced: 2^32 triangles are 32 deep
    size_t depth = nodes_.empty() ? 0 : 1;
    while (depth > 0 && best > enough * enough) {
        const Node& node = nodes_[stack[--depth]];
        if (squaredToBox(point, node.low, node.high) >= best) continue;
        if (node.count > 0) {
            for (uint32_t t = node.first; t < node.first + node.count; ++t)
                best = std::min(best, squaredToTriangle(point, positions_[triangles_[t][0]],
                                                        positions_[triangles_[t][1]],
                                                        positions_[triangles_[t][2]]));
            continue;
        }
        const auto left = static_cast<uint32_t>(&node - nodes_.data()) + 1;
        const uint32_t right = node.first;
        const bool leftFirst = squaredToBox(point, nodes_[left].low, nodes_[left].high) <=
                               squaredToBox(point, nodes_[right].low, nodes_[right].high);
        stack[depth++] = leftFirst ? right : left;
        stack[depth++] = leftFirst ? left : right;
    }
    return std::sqrt(best);
}

}  // namespace sherd
