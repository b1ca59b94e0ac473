// SPDX-License-Identifier: MIT
// Which corners of hidden faces share a normal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "appearance/hidden_mesh.h"
#include "sherd/baker/recipe.h"

namespace sherd {

struct ShadingFans {
    std::vector<uint32_t> ofCorner;   ///< per corner 3 * face + k
    std::vector<glm::dvec3> normals;  ///< per fan: the mean of its faces' by area, unit; 0 if the
                                      ///< fan has no area
};

/// A fan is what lies around a vertex between sharp edges.
ShadingFans shadingFans(const HiddenMesh& mesh, std::span<const uint32_t> opposite,
                        const FaceShapes& shapes, const InteriorSettings& settings);

}  // namespace sherd
