// SPDX-License-Identifier: MIT
// Thesis step 4 (Casella 2013, 4.5): the fracture points of both sides of every mesh edge are put
// into that edge, sorted, each once and none moved; pieces of an edge that a line runs along are
// marked.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "surface/matching.h"
#include "surface/mesh_topology.h"
#include "surface/split_surface.h"

namespace sherd {

/// A point that splits a mesh edge, at `t` from its low to its high vertex.
struct EdgePoint {
    uint32_t edge = 0;
    LineParameter t;
};

/// The mesh edges with their points. Ids: a mesh vertex keeps its index, edge point p is
/// vertexCount + p.
struct ResolvedEdges {
    uint32_t vertexCount = 0;
    std::vector<EdgePoint> points;     ///< sorted by edge, then t
    std::vector<uint32_t> firstPoint;  ///< per edge, and one more: into points
    /// Mark of the line along each piece of each edge, 0: none. Edge e has its points' count + 1
    /// pieces, from low to high, starting at firstPoint[e] + e.
    std::vector<uint32_t> pieceLine;
    /// Per cut: ids of its two ends; kNone for an inner end.
    std::vector<std::array<uint32_t, 2>> cutEnds;

    uint32_t pointCount(uint32_t edge) const { return firstPoint[edge + 1] - firstPoint[edge]; }
    uint32_t firstPiece(uint32_t edge) const { return firstPoint[edge] + edge; }
    void markPiece(uint32_t piece, uint32_t line) {
        if (pieceLine[piece] == 0 || line < pieceLine[piece]) pieceLine[piece] = line;
    }
};

/// The half edge (0..2) a cut runs along, or 3.
uint8_t edgeAlong(const Cut& cut);

/// Lines already along the surface's edges stay along all their pieces.
ResolvedEdges resolveEdges(const MeshTopology& topology, const SplitSurface& surface,
                           std::span<const Cut> cuts);

}  // namespace sherd
