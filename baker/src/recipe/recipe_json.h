// SPDX-License-Identifier: MIT
// A recipe that is JSON already, wherever it stood. For `.cpp` files: JSON stays out of other
// headers.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "sherd/baker/recipe.h"

namespace sherd {

/// `file` and `pointer`: where the JSON stands, for messages. Paths are left as they are written.
Result<Recipe> recipeOf(const nlohmann::json& json, const std::string& file,
                        const std::string& pointer);

/// Files that a recipe names, made relative to a folder.
void resolvePaths(Recipe& recipe, const std::filesystem::path& folder);

}  // namespace sherd
