// SPDX-License-Identifier: MIT
// Bonds to the world.
#pragma once

#include <string>
#include <vector>

#include "assembly/hierarchy.h"
#include "assembly/labels.h"
#include "sherd/baker/recipe.h"

namespace sherd {

struct AnchorInput {
    const SplitSurface& surface;
    const Components& components;
    const Hierarchy& hierarchy;
    const std::vector<PlacedLabel>& labels;
    const std::vector<RecipeAnchor>& anchors;
    double diagonal;  ///< of the object, metres
};

/// What holds a leaf there becomes a bond of it to the world, appended to the set's: where a place
/// holds, of the outer surface there; where a piece is held by its name or by a label of a drawing,
/// of half its outer surface that no place holds. What several hold belongs to the first of the
/// recipe's; labels of drawings come last. Returns per anchor of the recipe whether it holds
/// anything. The set has its fragments' names and strengths.
std::vector<bool> assembleAnchors(const AnchorInput& input, FractureSet& set);

/// Whether an anchor that is a place holds anything of a mesh before it is cut.
bool holdsAnything(const RecipeAnchor& anchor, const SurfaceMesh& mesh);

/// "reaches from (0, 0, 0) to (1, 2, 1) in the scene", for messages.
std::string extentsInScene(const SurfaceMesh& mesh);

}  // namespace sherd
