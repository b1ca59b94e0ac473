// SPDX-License-Identifier: MIT
// Colliders of all fragments of a set: convex parts that do not overlap those of other fragments.
#pragma once

#include "sherd/baker/recipe.h"
#include "sherd/formats/fracture_set.h"

namespace sherd {

/// Fills the set's hulls from its geometry: at most `convexParts` for each fragment. The result
/// does not depend on the number of threads.
void assembleColliders(const PhysicsSettings& settings, unsigned threads, FractureSet& set);

}  // namespace sherd
