// SPDX-License-Identifier: MIT
// Where the cells of a pattern crowd.
#pragma once

#include "pattern/site_sampling.h"
#include "sherd/baker/fracture_plan.h"
#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// By a picture in UV (dark: many, repeated outside [0, 1]) or the vertex colour COLOR_0 (bright:
/// many). triangle, weights: of the mesh. A little everywhere, so that no cell is endless. Empty
/// where the pattern asks for nothing; error invalidData where the mesh lacks what it asks for.
Result<Density> densityOf(const SurfaceMesh& mesh, const FracturePlan::Grown& grown);

}  // namespace sherd
