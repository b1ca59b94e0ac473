// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "recipe/recipe_reader.h"
#include "sherd/baker/volume_cut.h"

namespace sherd {

/// [x, y, z], or a list of such, metres.
bool readPlaces(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                std::vector<glm::dvec3>& places);

/// "only" of a level: which pieces of the level before it divides.
bool readChoice(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                PieceChoice& choice);

}  // namespace sherd
