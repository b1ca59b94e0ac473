// SPDX-License-Identifier: MIT
// Edges of a welded triangle mesh and which triangle lies across each half edge.
//
// Half edge h = 3 * triangle + k runs from corner k to corner k + 1 (mod 3).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/no_index.h"

namespace sherd {

struct MeshTopology {
    struct Edge {
        uint32_t low,
            high;  ///< end vertices, low < high; parameters along the edge run low -> high
    };
    std::vector<Edge> edges;             ///< sorted by (low, high)
    std::vector<uint32_t> halfEdgeEdge;  ///< per half edge; kNone in index-degenerate triangles
    std::vector<uint32_t> opposite;  ///< per half edge: the one it is glued to; kNone at a border
    std::vector<uint8_t>
        degenerate;                 ///< per triangle: two corners share a vertex; it takes no part
    uint32_t boundaryEdges = 0;     ///< edges with one triangle
    uint32_t nonManifoldEdges = 0;  ///< edges with unequal uses in the two directions beyond that
    uint32_t pinchedEdges = 0;      ///< edges used twice or more in each direction: glued in pairs
    uint32_t firstBoundaryHalfEdge = kNone;     ///< for messages
    uint32_t firstNonManifoldHalfEdge = kNone;  ///< for messages
};

/// Glues half edges. An edge used n times in each direction (solids touching along an edge) is
/// glued in pairs that close around the least solid angle, so touching solids stay apart. What
/// remains unpaired is a border. Triangles with a repeated vertex are left out.
MeshTopology buildTopology(std::span<const glm::vec3> positions,
                           std::span<const std::array<uint32_t, 3>> triangles);

}  // namespace sherd
