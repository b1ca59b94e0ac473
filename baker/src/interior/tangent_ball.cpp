// SPDX-License-Identifier: MIT
// J. Ma, S. W. Bae, S. Choi, "3D Medial Axis Point Approximation Using Nearest Neighbors and the
// Normal Field" (2012): shrink the ball until it is empty. We ask triangles, not samples, so that
// coarse and thin meshes are not crossed between two samples; the vertex's own triangles are left
// out, since at a convex crease they would shrink every ball to a point.
#include "interior/tangent_ball.h"

#include <glm/geometric.hpp>

namespace sherd {

double tangentBallRadius(const TriangleBvh& bvh, std::span<const std::array<uint32_t, 3>> triangles,
                         uint32_t vertex, const glm::dvec3& point, const glm::dvec3& normal,
                         double maxRadius) {
    constexpr int kMaxSteps = 30;         // 5 are usual
    constexpr double kTolerance = 0.999;  // of the radius
    const auto notAround = [&](uint32_t t) {
        const auto& v = triangles[t];
        return v[0] != vertex && v[1] != vertex && v[2] != vertex;
    };
    double radius = maxRadius;
    for (int step = 0; step < kMaxSteps; ++step) {
        const glm::dvec3 centre = point - radius * normal;
        const ClosestPoint hit = bvh.closest(centre, radius * kTolerance, notAround);
        if (hit.triangle == ClosestPoint::kNone) break;
        const glm::dvec3 d = point - hit.point;
        const double height = glm::dot(d, normal);
        if (!(height > 0)) return 0;  // the surface comes back to this very point
        const double next = glm::dot(d, d) / (2 * height);
        if (!(next < radius)) break;
        radius = next;
    }
    return radius;
}

}  // namespace sherd
