// SPDX-License-Identifier: MIT
// A recipe that a model brings along: `extras.sherd` of a node or mesh, as Blender writes custom
// properties.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "sherd/baker/recipe.h"

namespace sherd {

/// Where a model carries a recipe.
struct RecipePlace {
    std::filesystem::path model;
    std::string pointer;  ///< "/nodes/3/extras/sherd"

    std::string text() const { return model.string() + "#" + pointer; }
};

/// A recipe as an object, as JSON text, or as the path of a recipe beside the model. Whoever sends
/// a model chooses what it names, so it reaches no file outside the model's folder. Errors:
/// invalidData, malformed, limitExceeded, fileNotFound, fileRead.
Result<Recipe> readEmbeddedRecipe(const nlohmann::json& value, const RecipePlace& place);

}  // namespace sherd
