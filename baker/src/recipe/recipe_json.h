// SPDX-License-Identifier: MIT
// A recipe that is JSON already, wherever it stood. For `.cpp` files: JSON stays out of other
// headers.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "sherd/baker/recipe.h"

namespace sherd {

/// Reads JSON with comments. A key that stands twice in one object is an error: all but the last
/// would be lost unseen. Errors malformed, invalidData.
Result<nlohmann::json> parseJson(std::string_view text, const std::string& file,
                                 const std::string& pointer);

/// `file` and `pointer`: where the JSON stands, for messages. Paths are left as they are written.
Result<Recipe> recipeOf(const nlohmann::json& json, const std::string& file,
                        const std::string& pointer);

/// Files that a recipe names, made relative to a folder.
void resolvePaths(Recipe& recipe, const std::filesystem::path& folder);

}  // namespace sherd
