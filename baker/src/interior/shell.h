// SPDX-License-Identifier: MIT
#pragma once

#include "interior/medial.h"
#include "interior/sheet_refinement.h"
#include "sherd/baker/recipe.h"
#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Metres at a place: a triangle of the mesh and weights of its corners.
using Thickness = std::function<double(uint32_t triangle, const glm::dvec3& weights)>;

/// The same everywhere, or scaled from place to place by an attribute or a picture. The mesh must
/// outlive it. Errors: invalidData, noTextureCoordinates, badArgument where the mesh or the
/// settings lack what is asked for.
Result<Thickness> thicknessOf(const SurfaceMesh& mesh, const ShellSettings& settings,
                              double diagonal);

/// The sheet of a shell: towards the medial surface as far as the shell is thick, never past it.
/// All must outlive it.
HiddenMap shellMap(const SurfaceMesh& mesh, const MedialSurface& medial, Thickness thickness);

}  // namespace sherd
