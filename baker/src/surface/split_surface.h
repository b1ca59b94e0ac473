// SPDX-License-Identifier: MIT
// The mesh with fracture lines cut into its triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "geometry/bounds.h"
#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// Where a vertex of the split surface comes from: a weighted sum of up to three mesh vertices.
/// Weights are never negative and add up to 1; unused ones are 0. A vertex on a mesh edge names the
/// edge's ends only, so that both sides of the edge read it alike.
struct VertexOrigin {
    std::array<uint32_t, 3> vertices{};  ///< mesh vertices (welded positions)
    glm::dvec3 weights{1.0, 0.0, 0.0};
};

/// An origin as weights of the three corners of the mesh triangle it lies in.
glm::dvec3 weightsOf(const VertexOrigin& origin, const std::array<uint32_t, 3>& meshTriangle);

/// Half way between two origins in one mesh triangle.
VertexOrigin middleOrigin(const VertexOrigin& a, const VertexOrigin& b,
                          const std::array<uint32_t, 3>& meshTriangle);

struct SplitTriangle {
    std::array<uint32_t, 3> v;     ///< split vertices
    uint32_t source;               ///< triangle of the mesh
    std::array<uint32_t, 3> line;  ///< mark (see LineTable) of edge v[k] v[k + 1]; 0: none
};

/// Vertices [0, meshVertices) are the mesh's; every cut appends its edge points, then its points
/// inside triangles.
struct SplitSurface {
    uint32_t meshVertices = 0;
    std::vector<glm::vec3> positions;
    std::vector<VertexOrigin> origins;
    std::vector<SplitTriangle> triangles;  ///< sorted by source
};

/// The mesh before any cut, index-degenerate triangles included.
SplitSurface uncutSurface(const SurfaceMesh& mesh);

/// The point of a triangle with these weights of its corners, in double.
glm::dvec3 pointOn(const SplitSurface& surface, uint32_t triangle, const glm::dvec3& weights);
glm::dvec3 centroidOf(const SplitSurface& surface, uint32_t triangle);

/// Of a half edge, 3 * triangle + k, in metres.
double edgeLength(const SplitSurface& surface, uint32_t halfEdge);

/// Of the vertices that triangles use.
Bounds boundsOf(const SplitSurface& surface);

/// The triangles' vertex indices alone, for functions that take plain triangles.
std::vector<std::array<uint32_t, 3>> vertexTriangles(const SplitSurface& surface);

}  // namespace sherd
