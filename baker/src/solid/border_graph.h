// SPDX-License-Identifier: MIT
// The lines that part pieces, as a graph over the surface: nodes where three or more pieces meet,
// and arcs between them with one piece on each side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/mesh_topology.h"
#include "surface/split_surface.h"

namespace sherd {

/// A chain of half edges in the lower piece, which lies on its left.
struct BorderArc {
    std::vector<uint32_t> halfEdges;
    uint32_t low = 0, high = 0;         ///< the pieces on its left and right, low < high
    uint32_t from = kNone, to = kNone;  ///< nodes; kNone: a ring without any
};

struct BorderNode {
    /// An arc's end, seen from the node outwards.
    struct Spoke {
        uint32_t arc = kNone;
        bool leaves = false;  ///< the arc starts here
        uint32_t before = 0;  ///< the piece on its clockwise side
        uint32_t after = 0;   ///< on its counter-clockwise side
    };
    uint32_t vertex = 0;
    std::vector<Spoke> spokes;  ///< counter-clockwise, seen from outside
    /// No border of the mesh here, and no piece comes twice.
    bool plain = true;
};

struct BorderGraph {
    std::vector<BorderNode> nodes;
    std::vector<BorderArc> arcs;
    std::vector<uint8_t> open;           ///< per piece: touches a border of the mesh
    std::vector<uint32_t> nodeOfVertex;  ///< kNone where there is none
};

/// piece: per triangle, below pieceCount.
BorderGraph borderGraph(const SplitSurface& surface, const MeshTopology& topology,
                        std::span<const uint32_t> piece, uint32_t pieceCount);

}  // namespace sherd
