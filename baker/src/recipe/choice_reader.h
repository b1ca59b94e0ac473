// SPDX-License-Identifier: MIT
#pragma once

#include "recipe/recipe_reader.h"
#include "sherd/baker/volume_cut.h"

namespace sherd {

/// "only" of a level: which pieces of the level before it divides.
bool readChoice(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                PieceChoice& choice);

}  // namespace sherd
