// SPDX-License-Identifier: MIT
// The thesis' own way over seams (Casella 2013, 4.5): the fracture points of the two sides of a
// seam edge are paired in order and both moved to their average. Only where the sides have equally
// many, and only pairs within 1 % of the edge: pairing by order alone joins unrelated lines.
#pragma once

#include "surface/matching.h"
#include "surface/mesh_topology.h"
#include "surface/split_surface.h"

namespace sherd {

/// Moves ends of cuts on seam edges, before anything is built on them. Returns how many pairs
/// moved.
uint32_t averageSeamPairs(const MeshTopology& topology, std::span<const SplitTriangle> triangles,
                          std::span<const UvTriangle> uv, std::span<Cut> cuts);

}  // namespace sherd
