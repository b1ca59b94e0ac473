// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/mesh_topology.h"

namespace sherd {

/// A hole: the half edges around it, each beginning at a vertex of its own, in the order in which
/// the surface has them. What closes the hole has them the other way round.
using BoundaryLoop = std::vector<uint32_t>;

/// All holes, in the order of their first half edge. Where holes touch in a vertex, or one is
/// pinched there to a figure of eight, each loop is told apart.
std::vector<BoundaryLoop> boundaryLoops(const MeshTopology& topology,
                                        std::span<const std::array<uint32_t, 3>> triangles);

}  // namespace sherd
