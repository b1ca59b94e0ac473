// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include "geometry/triangle_bvh.h"

namespace sherd {

struct RayHit {
    static constexpr uint32_t kNone = ClosestPoint::kNone;
    double t = 1e300;           ///< the hit is origin + t * direction
    uint32_t triangle = kNone;  ///< kNone: nothing hit
};

/// The first triangle along a ray, t > 0, other than `except`. In doubles: rays through edges may
/// slip through; of equal hits the lower index counts.
RayHit firstHit(const TriangleBvh& tree, const glm::dvec3& origin, const glm::dvec3& direction,
                uint32_t except = RayHit::kNone);

}  // namespace sherd
