// SPDX-License-Identifier: MIT
// Thesis step 1 (Casella 2013, 4.2): the half-edge fracture points of one triangle, that is where
// the endless line under a map edge enters and leaves it. Decided exactly.
#pragma once

#include <array>
#include <cstdint>

#include "map/planar_map.h"
#include "surface/uv_triangle.h"

namespace sherd {

/// A place of a triangle: one of its corners, a point on one of its half edges, or a map node
/// inside.
struct CutEnd {
    enum class Where : uint8_t { corner, edge, inside };
    Where where = Where::corner;
    uint8_t k = 0;      ///< corner k, or half edge k (corner k -> k + 1)
    LineParameter t;    ///< along half edge k, strictly between 0 and 1
    uint32_t node = 0;  ///< map node, for `inside`

    friend bool operator==(const CutEnd& x, const CutEnd& y) {
        if (x.where != y.where) return false;
        if (x.where == Where::inside) return x.node == y.node;
        return x.k == y.k && (x.where == Where::corner || x.t == y.t);
    }
};

/// The line a -> b through a regular triangle: from entry to exit (equal: it touches one corner).
struct LineCrossing {
    bool crosses = false;
    bool alongEdge = false;  ///< it contains half edge entry.k/exit.k: both ends are corners
    CutEnd entry, exit;
};

/// The corners of a regular triangle counter-clockwise (u right, v up): mirrored ones reflected.
std::array<GridPoint, 3> orientedCorners(const UvTriangle& triangle);

/// Precondition: corners are counter-clockwise; a != b.
LineCrossing lineThroughTriangle(const std::array<GridPoint, 3>& corner, GridPoint a, GridPoint b);

}  // namespace sherd
