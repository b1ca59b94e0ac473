// SPDX-License-Identifier: MIT
// Masses, colliders and bonds of a fracture set whose geometry and hierarchy are in place.
#pragma once

#include "assembly/hierarchy.h"
#include "sherd/baker/recipe.h"
#include "sherd/formats/fracture_set.h"

namespace sherd {

/// Leaves' masses come from their meshes, every coarser fragment's are the sums over its leaves, so
/// nothing changes at a swap. Fills Fragment, hulls and bonds.
void assemblePhysics(const Hierarchy& hierarchy, const PhysicsSettings& settings,
                     double sheetTolerance, unsigned threads, FractureSet& set);

}  // namespace sherd
