// SPDX-License-Identifier: MIT
// Broken faces that are not smooth: hidden points moved by one random field of the place.
#pragma once

#include <glm/mat3x3.hpp>

#include "appearance/hidden_mesh.h"
#include "sherd/baker/recipe.h"
#include "sherd/baker/report.h"

namespace sherd {

struct RoughShape {
    std::vector<glm::vec3> positions;    ///< of the mesh, moved
    std::vector<glm::dmat3> normalMaps;  ///< per position: takes normals of the smooth faces to
                                         ///< those of the rough ones, apart from their length
    std::vector<BakeFinding> findings;   ///< what was asked for and could not be had
};

/// Refines the faces and moves every hidden point once, so that neighbours stay together. The field
/// fades out towards the skin, where nothing moves; it is so gentle (|d(p) - d(q)| < |p - q| / 2)
/// that it cannot fold, and its points stay inside. The mesh itself is refined and stays smooth.
RoughShape roughen(const SurfaceMesh& object, const SplitSurface& surface,
                   const Components& components, const Roughness& settings, HiddenMesh& mesh);

}  // namespace sherd
