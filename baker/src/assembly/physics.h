// SPDX-License-Identifier: MIT
// Masses, colliders and bonds of a fracture set whose geometry and hierarchy are in place.
#pragma once

#include "assembly/bond_strengths.h"
#include "assembly/hierarchy.h"
#include "sherd/baker/recipe.h"
#include "sherd/formats/fracture_set.h"

namespace sherd {

/// Fragments' places in the hierarchy and their material numbers, and the levels.
void assembleFragments(const Hierarchy& hierarchy, const PhysicsSettings& settings,
                       FractureSet& set);

/// Leaves' masses come from their meshes, every coarser fragment's are the sums over its leaves, so
/// nothing changes at a swap. A leaf whose mesh overlaps itself so much that its inertia is not
/// that of any body gets that of its bounding box; returns how many.
uint32_t assembleMasses(const Hierarchy& hierarchy, unsigned threads, FractureSet& set);

/// Between leaves: walls they share, and sheets that face each other within `sheetTolerance`
/// metres.
void assembleBonds(const Hierarchy& hierarchy, const BondStrengths& strengths,
                   double sheetTolerance, unsigned threads, FractureSet& set);

}  // namespace sherd
