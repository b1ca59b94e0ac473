// SPDX-License-Identifier: MIT
// Which connected parts of an object make one solid: those that touch, overlap, or lie in one
// another.
#pragma once

#include <cstdint>
#include <vector>

#include "sherd/baker/surface_mesh.h"
#include "surface/mesh_topology.h"

namespace sherd {

struct PartGroups {
    std::vector<uint32_t> part;   ///< per mesh triangle: its connected part
    std::vector<uint32_t> group;  ///< per mesh triangle: the group of its part
    uint32_t parts = 0;
    uint32_t groups = 0;
};

/// Touching is decided exactly, and so is lying inside a closed part.
PartGroups groupParts(const SurfaceMesh& mesh, const MeshTopology& topology);

}  // namespace sherd
