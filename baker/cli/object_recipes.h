// SPDX-License-Identifier: MIT
// Which recipe breaks which object of a scene.
#pragma once

#include <functional>
#include <vector>

#include "sherd/baker/bake.h"

namespace sherd::cli {

/// Orders point into the recipes and plans: to be moved, not copied.
struct ObjectRecipes {
    std::vector<Recipe> recipes;  ///< [0]: for objects that bring none
    std::vector<FracturePlan> plans;
    std::vector<BakeOrder> orders;  ///< per mesh of the model
};

/// What the command line says over a recipe that an object brought.
using Adjustment = std::function<Result<void>(Recipe&)>;

/// `common` breaks the objects that bring no recipe; those that do are broken by theirs, adjusted.
/// Lines modelled on objects are taken out where their recipe does not want them. Errors:
/// badArgument where there is nothing to cut along, and those of reading drawings.
Result<ObjectRecipes> recipesOfObjects(const Recipe& common, Model& model,
                                       const Adjustment& adjust);

}  // namespace sherd::cli
