// SPDX-License-Identifier: MIT
// The levels of a recipe.
#pragma once

#include "recipe/recipe_reader.h"
#include "sherd/baker/recipe.h"

namespace sherd {

/// Appends to the recipe's levels. False after a mistake.
bool readLevels(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                Recipe& recipe);

}  // namespace sherd
