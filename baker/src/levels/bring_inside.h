// SPDX-License-Identifier: MIT
#pragma once

#include "appearance/hidden_mesh.h"
#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// Hidden points farther than `tolerance` metres outside the object go to the nearest place on its
/// skin: walls of drawn levels may reach out of a solid that is not convex, and cuts through them
/// put vertices there. Points in one place stay in one. Returns how many.
uint32_t bringInside(const SurfaceMesh& object, double tolerance, HiddenMesh& hidden);

}  // namespace sherd
