// SPDX-License-Identifier: MIT
#include "layout/drawn_places.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "geometry/triangle.h"

namespace sherd {

namespace {

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
        const std::optional<glm::dvec3> found = weightsIn(*place.uv, moved.placed);
        if (!found || !(std::min({found->x, found->y, found->z}) >= kOnBorder)) continue;
        const glm::dvec3& weights = *found;
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
