// SPDX-License-Identifier: MIT
// Planes that lie in faces of the mesh are moved a little off them.
//
// A face in the very plane of a cut belongs to one of the two cells. Where the solid below it is
// the other's, the first would get skin without anything under it. So the plane moves outwards, by
// 1e-6 of the mesh's extent, by weights as everything: planes of three cells go on meeting in a
// line. Where faces of one plane look both ways, the larger area decides.
#pragma once

#include <cstdint>
#include <vector>

#include "sherd/formats/result.h"
#include "volume/cell_family.h"
#include "volume/triangle_cells.h"

namespace sherd {

/// Part of a triangle that lies between two members of a family: `inner` has the solid below it.
struct CoplanarFace {
    size_t family;
    uint32_t inner, outer;
    double area;
};

/// How near a plane a face counts as in it, and how far that is moved, of the mesh's extent.
inline constexpr double kCoplanarBand = 0.5e-6;
inline constexpr double kCoplanarShift = 1e-6;

/// What a part of a triangle says.
void addCoplanarFaces(const CutInput& input, uint32_t triangle, const TriangleCells::Polygon& part,
                      const CutVertices& vertices, std::vector<CoplanarFace>& faces);

struct MovedPlanes {
    std::vector<CellFamily> families;
    uint32_t moved = 0;    ///< planes
    uint32_t opposed = 0;  ///< of these, with faces that wanted it the other way, or not moved
};
MovedPlanes movePlanes(const CellFunctions& functions, const std::vector<CoplanarFace>& faces,
                       double extentInSteps);

}  // namespace sherd
