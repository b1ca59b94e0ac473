// SPDX-License-Identifier: MIT
// Where the world holds the object, as a recipe says.
#pragma once

#include "recipe/recipe_reader.h"
#include "sherd/baker/recipe.h"

namespace sherd {

/// False after a mistake.
bool readAnchors(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                 std::vector<RecipeAnchor>& anchors);

}  // namespace sherd
