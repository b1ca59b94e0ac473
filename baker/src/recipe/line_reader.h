// SPDX-License-Identifier: MIT
// How lines are taken from drawings, as a recipe says.
#pragma once

#include "recipe/recipe_reader.h"
#include "sherd/baker/recipe.h"

namespace sherd {

/// False after a mistake.
bool readBitmap(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                BitmapOptions& bitmap);

/// Which stroke colour means which level. False after a mistake.
bool readLevelColors(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                     Recipe& recipe);

}  // namespace sherd
