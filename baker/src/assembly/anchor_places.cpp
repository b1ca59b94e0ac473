// SPDX-License-Identifier: MIT
// Convex polygons are clipped by one half-space after the other (Sutherland and Hodgman, Reentrant
// Polygon Clipping, 1974); what each cuts off is kept, for the anchors behind. Floating point is
// good enough: no piece's shape depends on it, and places near a border count as on it.
#include "assembly/anchor_places.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sherd/baker/surface_mesh.h"

namespace sherd {
namespace {

/// The part of a polygon where `distances` (per corner) are at most 0, or with sign -1 at least.
AnchorPlace::Polygon clipped(const AnchorPlace::Polygon& polygon,
                             const std::vector<double>& distances, double sign) {
    AnchorPlace::Polygon out;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const size_t j = (i + 1) % polygon.size();
        const double a = sign * distances[i];
        const double b = sign * distances[j];
        if (a <= 0) out.push_back(polygon[i]);
        if ((a < 0 && b > 0) || (a > 0 && b < 0))
            out.push_back(polygon[i] + (polygon[j] - polygon[i]) * (a / (a - b)));
    }
    return out;
}

}  // namespace

void SurfacePart::add(const SurfacePart& other) {
    area += other.area;
    moment += other.moment;
    normal += other.normal;
}

SurfacePart partOf(std::span<const glm::dvec3> polygon) {
    SurfacePart part;
    for (size_t k = 2; k < polygon.size(); ++k) {
        const glm::dvec3& a = polygon[0];
        const glm::dvec3& b = polygon[k - 1];
        const glm::dvec3& c = polygon[k];
        const glm::dvec3 normal = 0.5 * glm::cross(b - a, c - a);
        const double area = glm::length(normal);
        part.add({area, (a + b + c) * (area / 3), normal});
    }
    return part;
}

AnchorPlace::AnchorPlace(const RecipeAnchor& anchor, const RigidPose& restPose, double slack)
    : slack_(slack) {
    const glm::dvec3 origin = toObjectFrame(restPose, glm::dvec3(0.0));
    const auto border = [&](const glm::dvec3& point, const glm::dvec3& outwards) {
        const glm::dvec3 normal = glm::normalize(toObjectFrame(restPose, outwards) - origin);
        borders_.push_back({normal, glm::dot(normal, toObjectFrame(restPose, point))});
    };
    if (anchor.kind == RecipeAnchor::Kind::below) {
        border(anchor.point, glm::normalize(anchor.normal));
        return;
    }
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 axis(0.0);
        axis[k] = 1;
        border(anchor.high, axis);
        border(anchor.low, -axis);
    }
}

void AnchorPlace::take(const Polygon& polygon, SurfacePart& inside,
                       std::vector<Polygon>& rest) const {
    Polygon left = polygon;
    std::vector<double> distances;
    for (const HalfSpace& border : borders_) {
        distances.clear();
        bool out = false;
        bool in = false;
        for (const glm::dvec3& p : left) {
            const double distance = glm::dot(border.normal, p) - border.offset;
            distances.push_back(std::abs(distance) <= slack_ ? 0 : distance);
            out = out || distances.back() > 0;
            in = in || distances.back() < 0;
        }
        if (!out) continue;
        if (!in) {
            rest.push_back(std::move(left));
            return;
        }
        rest.push_back(clipped(left, distances, -1));
        left = clipped(left, distances, 1);
    }
    inside.add(partOf(left));
}

}  // namespace sherd
