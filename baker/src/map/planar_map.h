// SPDX-License-Identifier: MIT
// The planarised fracture map: lines that meet at nodes only, decided exactly (geometry of the
// arrangement on an integer grid; crossings stay implicit).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/exact_grid.h"
#include "sherd/baker/fracture_map.h"

namespace sherd {

// UV is snapped to 2^-24: see GridPoint. UV beyond +-8 is an error that says so.

/// A straight line through two grid points; edges lie on it.
struct Support {
    GridPoint a, b;  ///< a < b, distinct
};

/// A node is a grid point, or the crossing of two supports that is not known to be one.
struct MapNode {
    GridPoint point;     ///< used when `first` < 0
    int32_t first = -1;  ///< supports whose crossing this is
    int32_t second = -1;
};

/// A piece of a support between two nodes, free of other nodes. Ordered along the support: from ->
/// to runs in the direction a -> b.
struct MapEdge {
    uint32_t from = 0, to = 0;  ///< nodes
    uint32_t support = 0;
    uint32_t level = 1;  ///< the coarsest level of the lines that cover it
    uint32_t line = 0;   ///< index of that line in the input
};

struct PlanarMap {
    std::vector<Support> supports;
    std::vector<MapNode> nodes;
    std::vector<MapEdge> edges;
    std::vector<std::string> warnings;  ///< zero-length lines dropped and so on
};

/// The node's position rounded to double UV (for reports and pictures, never for decisions).
glm::dvec2 nodeUv(const PlanarMap& map, uint32_t node);

/// Splits all lines of all maps at their crossings, touches and overlaps, exactly; removes
/// duplicates. Crossings that fall on a grid point become grid nodes. Equal points are one node.
/// Error limitExceeded: a coordinate beyond +-8, with its place.
Result<PlanarMap> planarise(const FractureMap& map);

}  // namespace sherd
