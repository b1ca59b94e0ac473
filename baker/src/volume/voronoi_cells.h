// SPDX-License-Identifier: MIT
// Voronoi cells of points, as a family of linear functions.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "volume/cell_family.h"
#include "volume/cut_grid.h"

namespace sherd {

inline constexpr double kMostStretch = 64;

/// One cell per site, everything nearer to it than to any other; of equal sites the first has all.
///
/// sites: in the mesh's coordinates, within twice its extent of its middle. stretch: cells are that
/// much longer along the axes, 1 to 64; other than 1, sites are rounded to 2^-11 of the extent or
/// finer. Errors: badArgument.
Result<CellFamily> voronoiCells(std::span<const glm::dvec3> sites, const CutGrid& grid,
                                const glm::dvec3& stretch = glm::dvec3(1));

}  // namespace sherd
