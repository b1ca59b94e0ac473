// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/voronoi.h"

namespace sherd {

inline constexpr uint32_t kNoPole = 0xffffffffU;

/// Per site: the vertex of its Voronoi cell that lies farthest from it on the inner side (against
/// the normal), but no farther than maxRadius. kNoPole if none.
std::vector<uint32_t> innerPoles(std::span<const glm::dvec3> sites,
                                 std::span<const glm::dvec3> normals,
                                 const VoronoiVertices& voronoi, double maxRadius);

}  // namespace sherd
