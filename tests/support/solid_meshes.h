// SPDX-License-Identifier: MIT
// Solids as objects to bake, and what their levels add up to.
#pragma once

#include <vector>

#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/fracture_set.h"
#include "support/random_solids.h"

namespace sherd::test {

/// One material, no texture coordinates.
inline SurfaceMesh meshOf(const Solid& solid) {
    SurfaceMesh mesh;
    mesh.name = "solid";
    mesh.positions = solid.positions;
    mesh.triangles = mesh.corners = solid.triangles;
    mesh.materials = {-1};
    mesh.triangleMaterials.assign(mesh.triangles.size(), 0);
    std::vector<float> normals;
    for (size_t v = 0; v < mesh.positions.size(); ++v)
        normals.insert(normals.end(), {0.0F, 0.0F, 1.0F});
    mesh.attributes = {{"NORMAL", 3, normals}};
    return mesh;
}

inline double volumeAt(const FractureSet& set, uint32_t level) {
    double sum = 0;
    for (const uint32_t f : fragmentsAtLevel(set, level)) sum += set.fragments[f].volume;
    return sum;
}

}  // namespace sherd::test
