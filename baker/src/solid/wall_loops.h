// SPDX-License-Identifier: MIT
// The outlines of the walls between pieces.
#pragma once

#include "solid/cell_space.h"
#include "solid/skeleton.h"

namespace sherd {

/// A corner of a wall or of its outline: a vertex of the surface, or a hub. A hub stands for the
/// vertex in a piece that comes there with no part of the surface.
struct OutlineVertex {
    uint32_t vertex = kNone;  ///< of the split surface
    uint32_t hub = kNone;
    uint32_t lowCorner = kNone;   ///< at the vertex, in the lower piece
    uint32_t highCorner = kNone;  ///< likewise in the higher
    bool onRing = false;          ///< of an arc without nodes
    uint32_t arc = kNone;         ///< on the surface

    uint32_t cornerIn(bool low) const { return low ? lowCorner : highCorner; }
};

/// The outline of a wall, a closed polygon: along arcs with the lower piece on the left, and
/// through the solid from node to node. The wall's triangles turn the outline's way as the higher
/// piece shows them, and the other way as the lower does.
struct WallOutline {
    uint32_t low = 0, high = 0;
    std::vector<OutlineVertex> vertices;
};

struct WallOutlines {
    std::vector<WallOutline> walls;
    std::vector<uint8_t> broken;  ///< per piece: has a border that no outline closes over
};

/// space: tells the sides of walls that touch the surface nowhere; null: there are none.
WallOutlines wallOutlines(const SplitSurface& surface, const MeshTopology& topology,
                          const BorderGraph& graph, const Skeleton& skeleton,
                          const CellSpace* space);

}  // namespace sherd
