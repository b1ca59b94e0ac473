// SPDX-License-Identifier: MIT
// Cells between planes, as families of linear functions.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "volume/cell_family.h"
#include "volume/cut_grid.h"

namespace sherd {

struct CutPlane {
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0};  ///< any length but 0
};

/// The slabs between planes whose normals point from each to the next: cell k is beyond k of them.
/// Where planes k and k + 1 cross, cells k - 1 and k + 1 meet beyond the crossing. A normal is kept
/// within 2^-19 of its direction (exactly along an axis), finer the fewer planes there are. Planes
/// beyond twice the mesh's extent from its middle, and normals that are none: badArgument.
Result<CellFamily> slabCells(std::span<const CutPlane> planes, const CutGrid& grid);

/// Every plane a family of its own: all cells of the planes' arrangement. Planes in the same place
/// count once. At most 16, of which 8 may meet in one point: limitExceeded.
Result<std::vector<CellFamily>> planeCells(std::span<const CutPlane> planes, const CutGrid& grid);

struct SliceOptions {
    std::array<uint32_t, 3> counts{2, 2, 2};  ///< slabs along x, y, z; 1 to 1,000 each
    double offsetJitter = 0;  ///< 0 to 1: planes move by up to half this share of their distance
    double angleJitter = 0;   ///< 0 to 1: planes tilt by up to 45 degrees times this
    uint64_t seed = 1;        ///< the same seed gives the same planes
};

/// Slabs in three directions over a box (that of the mesh). Errors: badArgument.
Result<std::vector<CellFamily>> sliceCells(const SliceOptions& options, const glm::dvec3& low,
                                           const glm::dvec3& high, const CutGrid& grid);

}  // namespace sherd
