// SPDX-License-Identifier: MIT
// The mesh with every fracture line cut into its triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sherd {

/// Where a vertex of the split surface comes from: a weighted sum of up to three mesh vertices.
/// Weights are never negative and add up to 1; unused ones are 0.
struct VertexOrigin {
    std::array<uint32_t, 3> vertices{};  ///< mesh vertices (welded positions)
    glm::dvec3 weights{1.0, 0.0, 0.0};
};

struct SplitTriangle {
    std::array<uint32_t, 3> v;      ///< split vertices
    uint32_t source;                ///< triangle of the mesh
    std::array<uint32_t, 3> level;  ///< of the fracture line along edge v[k] v[k + 1]; 0: none
};

/// Vertices [0, meshVertices) are the mesh's, then the edge points, then the points inside
/// triangles.
struct SplitSurface {
    uint32_t meshVertices = 0;
    std::vector<glm::vec3> positions;
    std::vector<VertexOrigin> origins;
    std::vector<SplitTriangle> triangles;  ///< sorted by source
};

}  // namespace sherd
