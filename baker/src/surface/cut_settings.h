// SPDX-License-Identifier: MIT
// A recipe's shares of the object's size as the lengths that cutting takes.
#pragma once

#include "sherd/baker/recipe.h"
#include "sherd/baker/surface_mesh.h"
#include "surface/cut_surface.h"

namespace sherd {

/// The bounding box diagonal of the vertices that triangles use.
double diagonalOf(const SurfaceMesh& mesh);

CutOptions cutOptionsOf(const Recipe& recipe, double diagonal);

}  // namespace sherd
