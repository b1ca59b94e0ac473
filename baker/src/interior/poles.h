// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/voronoi.h"

namespace sherd {

/// Unit normals by the angles of the triangles around each point; 0 where there is no direction.
std::vector<glm::dvec3> vertexNormals(std::span<const glm::dvec3> points,
                                      std::span<const std::array<uint32_t, 3>> triangles);

inline constexpr uint32_t kNoPole = 0xffffffffU;

/// Per site: the vertex of its Voronoi cell that lies farthest from it on the inner side (against
/// the normal), but no farther than maxRadius. kNoPole if none.
std::vector<uint32_t> innerPoles(std::span<const glm::dvec3> sites,
                                 std::span<const glm::dvec3> normals,
                                 const VoronoiVertices& voronoi, double maxRadius);

}  // namespace sherd
