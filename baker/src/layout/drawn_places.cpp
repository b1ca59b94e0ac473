// SPDX-License-Identifier: MIT
#include "layout/drawn_places.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sherd {

namespace {

/// Barycentric coordinates; no numbers for a triangle without area.
glm::dvec3 weightsAt(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& p) {
    const auto area = [](glm::dvec2 x, glm::dvec2 y) { return x.x * y.y - x.y * y.x; };
    const glm::dvec2 ab = corners[1] - corners[0];
    const glm::dvec2 ac = corners[2] - corners[0];
    const double whole = area(ab, ac);
    const double b = area(p - corners[0], ac) / whole;
    const double c = area(ab, p - corners[0]) / whole;
    return {1 - b - c, b, c};
}

template <class Points>
auto blend(const Points& points, const glm::dvec3& weights) {
    return points[0] * weights.x + points[1] * weights.y + points[2] * weights.z;
}

}  // namespace

DrawnPlaces::DrawnPlaces(const SurfaceMesh& mesh, double nearness)
    : mesh_(mesh), nearness_(nearness) {
    const DrawnMesh drawn(mesh);
    for (size_t t = 0; t < drawn.size(); ++t) {
        const DrawnTriangle triangle = drawn[t];
        if (triangle.where != DrawnWhere::anotherTile) continue;
        moved_.push_back({static_cast<uint32_t>(t), drawn.placed(t), triangle.points});
    }
}

glm::dvec2 DrawnPlaces::drawn(const BakePlace& place) const {
    constexpr double kOnBorder = -1e-6;  // places lie on edges as rounding leaves them
    for (const Moved& moved : moved_) {
        const glm::dvec3 weights = weightsAt(moved.placed, *place.uv);
        if (!(std::min({weights.x, weights.y, weights.z}) >= kOnBorder)) continue;
        if (place.position) {
            const auto& v = mesh_.triangles[moved.triangle];
            const std::array<glm::dvec3, 3> corners = {mesh_.positions[v[0]], mesh_.positions[v[1]],
                                                       mesh_.positions[v[2]]};
            if (glm::distance(blend(corners, weights), *place.position) > nearness_) continue;
        }
        const std::array<glm::dvec2, 3> drawn = {moved.drawn[0], moved.drawn[1], moved.drawn[2]};
        return blend(drawn, weights);
    }
    return *place.uv;
}

}  // namespace sherd
