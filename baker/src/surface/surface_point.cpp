// SPDX-License-Identifier: MIT
#include "surface/surface_point.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/triangle.h"
#include "surface/chords.h"

namespace sherd {
namespace {

/// The weights of the point of triangle abc nearest to p, p being that point up to rounding.
glm::dvec3 weightsAt(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                     const glm::dvec3& c) {
    if (const std::optional<glm::dvec3> weights = weightsIn(p, a, b, c)) {
        const double wb = std::clamp(weights->y, 0.0, 1.0);
        const double wc = std::clamp(weights->z, 0.0, 1.0);
        const double sum = std::max(1.0, wb + wc);
        return {std::max(0.0, 1 - wb - wc), wb / sum, wc / sum};
    }
    // A needle: along its longest side.
    const double ab = glm::distance(a, b);
    const double ac = glm::distance(a, c);
    const double bc = glm::distance(b, c);
    const auto along = [](const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& x) {
        const double length = glm::dot(to - from, to - from);
        return length > 0 ? std::clamp(glm::dot(x - from, to - from) / length, 0.0, 1.0) : 0.0;
    };
    if (ab >= ac && ab >= bc) return {1 - along(a, b, p), along(a, b, p), 0};
    if (ac >= bc) return {1 - along(a, c, p), 0, along(a, c, p)};
    return {0, 1 - along(b, c, p), along(b, c, p)};
}

bool holds(const UvTriangle& triangle, GridPoint p) {
    const int flip = triangle.kind == UvKind::mirrored ? -1 : 1;
    for (size_t k = 0; k < 3; ++k) {
        const auto& c = triangle.corner;
        if (flip * signOf(orientation(c[k], c[(k + 1) % 3], p)) < 0) return false;
    }
    return true;
}

}  // namespace

glm::dvec3 positionOf(const SplitSurface& surface, const SurfacePoint& point) {
    return pointOn(surface, point.triangle, weightsOf(point.frame));
}

PlaceFinder::PlaceFinder(const SurfaceMesh& mesh, const SplitSurface& surface,
                         std::span<const uint8_t> skip, std::span<const UvTriangle> uv)
    : mesh_(mesh),
      surface_(surface),
      skip_(skip),
      uv_(uv),
      tree_(surface.positions, vertexTriangles(surface)) {}

std::optional<SurfacePoint> PlaceFinder::nearest(const glm::dvec3& position) const {
    // No distance compares with what is not a number.
    for (int k = 0; k < 3; ++k)
        if (!std::isfinite(position[k])) return std::nullopt;
    const ClosestPoint hit =
        tree_.closest(position, std::numeric_limits<double>::infinity(),
                      [this](uint32_t triangle) { return skip_[triangle] == 0; });
    if (hit.triangle == ClosestPoint::kNone) return std::nullopt;
    const auto& v = surface_.triangles[hit.triangle].v;
    const glm::dvec3 weights = weightsAt(hit.point, surface_.positions[v[0]],
                                         surface_.positions[v[1]], surface_.positions[v[2]]);
    SurfacePoint point{hit.triangle, onFrame(weights), 0};
    point.distance = glm::distance(position, positionOf(surface_, point));
    return point;
}

std::optional<SurfacePoint> PlaceFinder::find(const SurfacePlace& place) const {
    if (place.in3d) {
        return nearest(toObjectFrame(mesh_.restPose, place.point));
    }
    const std::optional<GridPoint> p = snapToGrid(place.point.x, place.point.y);
    if (!p) return std::nullopt;
    for (size_t t = 0; t < uv_.size(); ++t) {
        const UvTriangle& triangle = uv_[t];
        if (triangle.kind != UvKind::regular && triangle.kind != UvKind::mirrored) continue;
        if (!holds(triangle, *p)) continue;
        const auto& c = triangle.corner;
        const auto whole = static_cast<double>(orientation(c[0], c[1], c[2]));
        const double wb = static_cast<double>(orientation(c[0], *p, c[2])) / whole;
        const double wc = static_cast<double>(orientation(c[0], c[1], *p)) / whole;
        const auto& v = mesh_.triangles[t];
        // Found anew on the surface as cut so far: the mesh triangle may be in pieces.
        std::optional<SurfacePoint> point = nearest(
            glm::dvec3(mesh_.positions[v[0]]) * (1 - wb - wc) +
            glm::dvec3(mesh_.positions[v[1]]) * wb + glm::dvec3(mesh_.positions[v[2]]) * wc);
        if (point) point->distance = 0;
        return point;
    }
    return std::nullopt;
}

}  // namespace sherd
