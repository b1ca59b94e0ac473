// SPDX-License-Identifier: MIT
// Voronoi cells of points, and cells between planes, as families of linear functions.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "volume/cell_family.h"
#include "volume/cut_grid.h"

namespace sherd {

/// One cell per site, everything nearer to it than to any other; of equal sites the first has all.
/// sites: in the mesh's coordinates, within twice its extent of its middle. Errors: badArgument.
Result<CellFamily> voronoiCells(std::span<const glm::dvec3> sites, const CutGrid& grid);

}  // namespace sherd
