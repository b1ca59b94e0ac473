// SPDX-License-Identifier: MIT
// How pieces look inside, as a recipe says.
#pragma once

#include "recipe/recipe_reader.h"
#include "sherd/baker/recipe.h"

namespace sherd {

/// False after a mistake.
bool readInterior(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                  InteriorSettings& interior);

}  // namespace sherd
