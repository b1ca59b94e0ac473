// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// What a file holds for one material: vertices with attributes, triangles into them.
struct MeshPart {
    int32_t material = -1;  ///< glTF material, -1: default
    std::vector<glm::vec3> positions;
    std::vector<Attribute> attributes;  ///< one value per position; NORMAL may be missing
    std::vector<std::array<uint32_t, 3>> triangles;
    glm::dmat3 linear{1.0};  ///< into the object's frame: linear * x + offset
    glm::dvec3 offset{0.0};
};

/// Fills positions, triangles, corners, materials and attributes of `mesh` from the parts: unused
/// vertices are dropped, bit-equal positions welded, attributes a part lacks filled with defaults,
/// flat normals made where there are none. Each part is brought into the object's frame first, its
/// directions too; what mirrors it also turns its triangles round.
void joinParts(std::vector<MeshPart> parts, SurfaceMesh& mesh);

}  // namespace sherd
