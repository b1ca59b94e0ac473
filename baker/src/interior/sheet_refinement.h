// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "interior/hidden_sheet.h"
#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// The hidden point below a place: a triangle of the mesh and weights of its corners.
using HiddenMap = std::function<glm::dvec3(uint32_t triangle, const glm::dvec3& weights)>;

struct SheetRefinement {
    double shortest = 0;   ///< metres: edges on the surface up to this are not cut
    double tolerance = 0;  ///< metres: how far hidden edges may be off the map in their middle
    double ofDepth = 0.1;  ///< nor by more than this share of the depth below the surface there
    unsigned threads = 2;  ///< at most; the result does not depend on it
};

/// Cuts the sheet's edges until it follows the map.
void refineSheet(const SurfaceMesh& mesh, const SplitSurface& surface, const HiddenMap& map,
                 const SheetRefinement& options, HiddenSheet& sheet);

}  // namespace sherd
