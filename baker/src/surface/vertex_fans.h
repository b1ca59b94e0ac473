// SPDX-License-Identifier: MIT
// Solids that touch at a vertex or along an edge share vertices there; each needs one of its own,
// for the inside below it lies elsewhere.
#pragma once

#include "sherd/baker/surface_mesh.h"
#include "surface/mesh_topology.h"

namespace sherd {

/// Gives every vertex one fan of triangles: all fans but the first get a copy of the position.
/// Returns how many copies were made; when any were, the topology must be built anew.
uint32_t separateFans(const MeshTopology& topology, SurfaceMesh& mesh);

}  // namespace sherd
