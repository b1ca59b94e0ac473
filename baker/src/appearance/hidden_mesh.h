// SPDX-License-Identifier: MIT
// The hidden faces of all leaves as one indexed mesh: what their appearance is worked out on.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "interior/stitching.h"
#include "sherd/baker/surface_mesh.h"

namespace sherd {

struct HiddenMesh {
    struct Face {
        std::array<uint32_t, 3> v;  ///< into positions
        uint32_t leaf;
        uint32_t exposedFrom;  ///< level
        uint32_t fragment;  ///< the leaf's component at that level: the largest piece that shows it
        uint32_t material;  ///< of the outer surface it lies under, into SurfaceMesh::materials
        bool wall;
    };
    std::vector<glm::vec3> positions;
    uint32_t skinVertices = 0;  ///< positions below lie on the outer surface; they never move
    std::vector<Face> faces;
};

/// Vertices [0, split vertices) are the split surface's, the sheet's hidden points follow. Edges
/// without length are one vertex, and faces that have one are left out: what lies beside them then
/// lies side by side.
HiddenMesh hiddenMesh(const SurfaceMesh& mesh, const SplitSurface& surface,
                      const Components& components, const HiddenSheet& sheet,
                      std::span<const HiddenFace> faces);

/// The caps of holes (SurfaceMesh::capTriangles) belong to the surface that is cut, but nobody is
/// to see them before it breaks: they become hidden faces, too, the last.
void addHoleCaps(const SurfaceMesh& mesh, const SplitSurface& surface, const Components& components,
                 HiddenMesh& hidden);

/// The shapes of its faces.
struct FaceShapes {
    std::vector<glm::dvec3> normals;  ///< unit; 0 for faces without area
    std::vector<double> areas;        ///< square metres
};
FaceShapes faceShapes(const HiddenMesh& mesh);

}  // namespace sherd
