// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "geometry/triangle_bvh.h"

namespace sherd {

/// The radius of the largest ball of at most maxRadius that touches `point` from the inner side
/// (against the unit normal) and no triangle but those around the vertex itself.
double tangentBallRadius(const TriangleBvh& bvh, std::span<const std::array<uint32_t, 3>> triangles,
                         uint32_t vertex, const glm::dvec3& point, const glm::dvec3& normal,
                         double maxRadius);

}  // namespace sherd
