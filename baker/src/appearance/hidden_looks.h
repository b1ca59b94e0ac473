// SPDX-License-Identifier: MIT
// Everything a renderer needs of hidden faces. Corners that agree in place, normal and chart share
// a vertex, whatever the level that shows them: a face looks the same at every level.
#pragma once

#include <glm/vec2.hpp>

#include "appearance/hidden_mesh.h"
#include "sherd/baker/recipe.h"
#include "sherd/baker/report.h"

namespace sherd {

struct HiddenLooks {
    struct Vertex {
        uint32_t position;        ///< in the mesh
        glm::vec3 normal;         ///< unit
        glm::vec2 uv;             ///< tiles
        glm::vec3 tangent{0.0F};  ///< unit, along u; the handedness is 1 everywhere
    };
    HiddenMesh mesh;
    std::vector<Vertex> vertices;
    std::vector<uint32_t> ofCorner;  ///< per corner 3 * face + k
    std::vector<float> depths;  ///< per position of the mesh: the share of the deepest one; empty
                                ///< if nobody asks
    std::vector<BakeFinding> findings;
};

struct LooksInput {
    const SurfaceMesh& object;  ///< before cutting
    const SplitSurface& surface;
    const Components& components;
    const InteriorSettings& settings;
    double diagonal;  ///< of the object, metres
};

HiddenLooks hiddenLooks(const LooksInput& input, HiddenMesh mesh);

}  // namespace sherd
