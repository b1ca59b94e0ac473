// SPDX-License-Identifier: MIT
// Lines that no drawing holds (over the surface, patterns): straight pieces in the frame of each
// triangle, with ends on an exact grid that the triangles beside an edge share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "map/planar_map.h"
#include "surface/matching.h"
#include "surface/mesh_topology.h"

namespace sherd {

/// A triangle's own frame: its corners 0, 1, 2 lie at (0, 0), (1, 0) and (0, 1) of the grid, so a
/// point with weights w is (w1, w2). A point on an edge is a whole number of 2^24 steps along it,
/// counted alike from both sides: neighbours agree to the bit, and so no line ever has a gap.
const UvTriangle& unitFrame();

/// The point `steps` of 2^24 along half edge k (corner k -> k + 1).
GridPoint onHalfEdge(uint32_t k, int32_t steps);

/// The grid point nearest to weights (not negative, adding up to 1), inside the frame.
GridPoint onFrame(const glm::dvec3& weights);

/// The weights of a frame point.
glm::dvec3 weightsOf(GridPoint point);

struct Chord {
    uint32_t triangle = 0;
    GridPoint a, b;     ///< in the triangle's frame; equal ends are passed over
    uint32_t line = 1;  ///< mark
};

struct ChordCuts {
    PlanarMap map;  ///< of all triangles; nodes in the frame of their triangle
    std::vector<Cut> cuts;
};

/// Chords split at their crossings, exactly, triangle by triangle.
Result<ChordCuts> cutsOfChords(std::span<const Chord> chords);

}  // namespace sherd
