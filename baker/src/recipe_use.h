// SPDX-License-Identifier: MIT
// Whether what a recipe names is there: anchors that hold something, materials of the model.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "sherd/baker/bake.h"

namespace sherd {

/// A mesh of the model and what breaks it.
struct MeshUse {
    const SurfaceMesh* mesh;
    const FracturePlan* plan;
};

/// Before anything is baked: an anchor at a place must hold one of the meshes, and a material must
/// be one of theirs or of a drawing's label. Errors badArgument with the pointer in the recipe.
Result<void> judgeRecipe(const Recipe& recipe, std::span<const MeshUse> meshes,
                         const std::map<int32_t, std::string>& materialNames);

/// Tells which anchors (`holds`: whether each does) hold nothing of one object.
void reportAnchors(const SurfaceMesh& mesh, const std::vector<RecipeAnchor>& anchors,
                   const std::vector<bool>& holds, BakedObject& object);

/// After baking: every anchor must hold something of one of the objects. Error badArgument.
Result<void> judgeAnchors(const Recipe& recipe, std::span<const BakedObjectReport* const> objects);

}  // namespace sherd
