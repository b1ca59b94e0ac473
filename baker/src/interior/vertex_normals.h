// SPDX-License-Identifier: MIT
// Normals of vertices and of corners. G. Thuermer, C. A. Wuethrich, "Computing Vertex Normals from
// Polygonal Facets" (1998): weighted by the angle at the vertex, a normal does not depend on how
// flat faces are cut into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/vertex_corners.h"

namespace sherd {

struct Facet {
    glm::dvec3 normal{0.0};          ///< unit; 0 without area
    std::array<double, 3> angles{};  ///< at the corners, radians
};

std::vector<Facet> facetsOf(std::span<const glm::dvec3> points,
                            std::span<const std::array<uint32_t, 3>> triangles, unsigned threads);

/// Unit; 0 for vertices without triangles and where opposite sheets cancel.
std::vector<glm::dvec3> vertexNormals(std::span<const Facet> facets, const VertexCorners& corners,
                                      size_t vertices, unsigned threads);

/// Of each wanted (not 0) triangle's corners, unit: the mean of those triangles around the vertex
/// that turn from this one by less than creaseAngle (radians). 0 for triangles without area, and
/// for those not wanted. vertexNormals as above.
std::vector<std::array<glm::vec3, 3>> cornerNormals(
    std::span<const Facet> facets, std::span<const std::array<uint32_t, 3>> triangles,
    const VertexCorners& corners, std::span<const glm::dvec3> vertexNormals,
    std::span<const uint8_t> wanted, double creaseAngle, unsigned threads);

}  // namespace sherd
