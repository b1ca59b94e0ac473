// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "recipe/recipe_reader.h"
#include "sherd/baker/volume_cut.h"

namespace sherd {

/// "cut" of a level: the text of a cut as `parseVolumeCut` reads it, or an object for one straight
/// through along a drawing: a "map" and what else its text may say, key by key.
bool readCut(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
             std::optional<VolumeCut>& cut);

}  // namespace sherd
