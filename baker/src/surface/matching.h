// SPDX-License-Identifier: MIT
// Thesis steps 2 and 3 (Casella 2013, 4.3-4.4): within one triangle, fracture points are matched
// along the lines that connect them. Joins and branches of any degree and dead ends inside the
// triangle become inner ends; a line along an edge becomes a cut between two places of that edge.
#pragma once

#include <vector>

#include "surface/fracture_points.h"
#include "surface/map_index.h"

namespace sherd {

/// A straight piece of a fracture line inside one triangle. Cuts meet at their ends only.
struct Cut {
    uint32_t triangle = 0;
    CutEnd from, to;
    uint32_t line = 1;     ///< mark of the coarsest line it belongs to
    uint32_t mapEdge = 0;  ///< for reports
};

/// The cuts of one triangle, `line` not filled in. Triangles of collinear UV conduct crossing lines
/// from edge to edge; those collapsed to a point have none.
void matchInTriangle(const PlanarMap& map, std::span<const uint32_t> candidates, uint32_t index,
                     const UvTriangle& triangle, std::vector<Cut>& cuts);

/// The cuts of all triangles, in the order of triangles. `marks`: of the map's lines.
std::vector<Cut> matchAll(const PlanarMap& map, std::span<const uint32_t> marks,
                          std::span<const UvTriangle> triangles, std::span<const uint8_t> skip);

}  // namespace sherd
