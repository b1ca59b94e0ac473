// SPDX-License-Identifier: MIT
// Where the cells of a pattern crowd.
#pragma once

#include "pattern/site_sampling.h"
#include "sherd/baker/fracture_plan.h"
#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// Around places, by a picture in UV (dark: many, repeated outside [0, 1]), or by the vertex colour
/// COLOR_0 (bright: many). A little everywhere, so that no cell is endless. Empty where the pattern
/// asks for nothing. The mesh and the surface must outlive it. Errors: invalidData,
/// noTextureCoordinates where the mesh lacks what is asked for.
Result<Density> densityOf(const SurfaceMesh& mesh, const SplitSurface& surface,
                          const FracturePlan::Grown& grown);

}  // namespace sherd
