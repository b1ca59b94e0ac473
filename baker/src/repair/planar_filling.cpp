// SPDX-License-Identifier: MIT
// A constrained Delaunay triangulation of the polygon's corners inside a large triangle, of which
// what lies within the polygon is kept.
#include "repair/planar_filling.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "geometry/constrained_triangulation.h"
#include "geometry/predicates.h"

namespace sherd {
namespace {

constexpr uint32_t kCorners = 3;  ///< of the large triangle, before the polygon's

/// Twice the area of the polygon's shadows, as a vector (M. E. Newell).
glm::dvec3 areaVector(std::span<const glm::vec3> polygon) {
    const glm::dvec3 origin(polygon[0]);
    glm::dvec3 sum(0);
    for (size_t i = 0; i < polygon.size(); ++i)
        sum += glm::cross(glm::dvec3(polygon[i]) - origin,
                          glm::dvec3(polygon[(i + 1) % polygon.size()]) - origin);
    return sum;
}

/// A coordinate is left out, so that points stay what they are to the bit; seen so that the polygon
/// turns left.
std::vector<glm::dvec2> flattened(std::span<const glm::vec3> polygon) {
    const glm::dvec3 normal = areaVector(polygon);
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u, v);
    std::vector<glm::dvec2> flat;
    flat.reserve(polygon.size());
    for (const glm::vec3& p : polygon) flat.emplace_back(p[u], p[v]);
    return flat;
}

TriangulationInput inputOf(std::span<const glm::vec3> polygon, std::vector<glm::dvec2>& points) {
    const std::vector<glm::dvec2> flat = flattened(polygon);
    glm::dvec2 low = flat[0], high = flat[0];
    for (const glm::dvec2& p : flat) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec2 size = high - low;
    const double reach = 4 * std::max(size.x, size.y);
    points = {
        low - reach, {high.x + 4 * reach, low.y - reach}, {low.x - reach, high.y + 4 * reach}};
    points.insert(points.end(), flat.begin(), flat.end());
    TriangulationInput input;
    for (const glm::dvec2& p : points) {
        ExactPoint point;
        point.ax = p.x;
        point.ay = p.y;
        input.points.push_back(point);
    }
    input.shape = points;
    input.turn = [&points](uint32_t a, uint32_t b, uint32_t c) {
        return orient2d(points[a], points[b], points[c]);
    };
    const auto count = static_cast<uint32_t>(flat.size());
    for (uint32_t i = 0; i < count; ++i)
        input.constraints.push_back({kCorners + i, kCorners + (i + 1) % count, 1});
    return input;
}

}  // namespace

std::vector<std::array<uint32_t, 3>> fillInPlane(std::span<const glm::vec3> polygon) {
    std::vector<std::array<uint32_t, 3>> filling;
    if (polygon.size() < 3) return filling;
    std::vector<glm::dvec2> points;
    const TriangulationInput input = inputOf(polygon, points);
    if (points[0] == points[1]) return filling;  // all corners in one place
    const TriangulationResult result = triangulate(input);
    if (!result.valid || !result.same.empty() || !result.passages.empty()) return filling;
    // What can be reached from the large triangle's corners without crossing the polygon is
    // outside.
    std::vector<uint8_t> outside(result.triangles.size(), 0);
    std::vector<uint32_t> stack;
    for (uint32_t t = 0; t < result.triangles.size(); ++t) {
        const auto& v = result.triangles[t].v;
        if (std::any_of(v.begin(), v.end(), [](uint32_t x) { return x < kCorners; }))
            stack.push_back(t);
    }
    while (!stack.empty()) {
        const uint32_t t = stack.back();
        stack.pop_back();
        if (outside[t] != 0) continue;
        outside[t] = 1;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t next = result.triangles[t].neighbor[k];
            if (next != TriangulationResult::kNone && result.triangles[t].mark[k] == 0)
                stack.push_back(next);
        }
    }
    for (size_t t = 0; t < result.triangles.size(); ++t) {
        const auto& v = result.triangles[t].v;
        if (outside[t] == 0) filling.push_back({v[0] - kCorners, v[1] - kCorners, v[2] - kCorners});
    }
    if (filling.size() + 2 != polygon.size()) filling.clear();
    return filling;
}

}  // namespace sherd
