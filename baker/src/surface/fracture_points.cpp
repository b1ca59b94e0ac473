// SPDX-License-Identifier: MIT
#include "surface/fracture_points.h"

#include <utility>

namespace sherd {

std::array<GridPoint, 3> orientedCorners(const UvTriangle& triangle) {
    std::array<GridPoint, 3> corner = triangle.corner;
    if (triangle.kind == UvKind::mirrored) {
        for (GridPoint& p : corner) p.u = -p.u;
    }
    return corner;
}

LineCrossing lineThroughTriangle(const std::array<GridPoint, 3>& corner, GridPoint a, GridPoint b) {
    std::array<int, 3> side{};
    for (size_t k = 0; k < 3; ++k) side[k] = signOf(orientation(a, b, corner[k]));
    LineCrossing result;
    if (side[0] == side[1] && side[1] == side[2])
        return result;  // never all 0: the area is positive

    // At most one of these is filled twice: a line meets the border of a triangle in two places, in
    // one corner, or along one edge.
    std::array<CutEnd, 2> places;
    size_t count = 0;
    bool secondIsExit = true;
    for (uint8_t k = 0; k < 3; ++k) {
        if (side[k] == 0) places[count++] = {CutEnd::Where::corner, k, {}, 0};
        const auto next = static_cast<uint8_t>((k + 1) % 3);
        if (side[k] * side[next] >= 0) continue;
        const LineParameter t = *crossingParameter(corner[k], corner[next], a, b);
        places[count++] = {CutEnd::Where::edge, k, t, 0};
        // The inside is left of every half edge: the line enters where it turns to the left of it.
        const bool enters = crossOf(corner[k], corner[next], a, b) > 0;
        secondIsExit = enters == (count == 1);
    }
    result.crosses = true;
    if (count == 1) {
        result.entry = result.exit = places[0];
        return result;
    }
    if (places[0].where == CutEnd::Where::corner && places[1].where == CutEnd::Where::corner) {
        result.alongEdge = true;
        const GridPoint p = corner[places[0].k];
        const GridPoint q = corner[places[1].k];
        // Collinear and distinct, so the lexicographic order tells the direction.
        secondIsExit = (p < q) == (a < b);
    }
    result.entry = places[0];
    result.exit = places[1];
    if (!secondIsExit) std::swap(result.entry, result.exit);
    return result;
}

}  // namespace sherd
