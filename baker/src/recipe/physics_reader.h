// SPDX-License-Identifier: MIT
// Masses, strengths and colliders, as a recipe says.
#pragma once

#include "recipe/recipe_reader.h"
#include "sherd/baker/recipe.h"

namespace sherd {

/// False after a mistake.
bool readPhysics(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                 PhysicsSettings& physics);

/// By name. False after a mistake.
bool readMaterials(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                   std::map<std::string, PhysicalMaterial>& materials);

}  // namespace sherd
