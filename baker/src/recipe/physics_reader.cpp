// SPDX-License-Identifier: MIT
#include "recipe/physics_reader.h"

namespace sherd {

bool readPhysics(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                 PhysicsSettings& physics) {
    return reader.object(json, pointer,
                         {{"density", reader.number(physics.density, 1e-6, 1e9)},
                          {"friction", reader.number(physics.friction, 0, 100)},
                          {"restitution", reader.number(physics.restitution, 0, 1)},
                          {"strength", reader.number(physics.strength, 0, 1e15)},
                          {"toughness", reader.number(physics.toughness, 0, 1e15)},
                          {"hullVertices", reader.integer(physics.hullVertices, 4, 255)},
                          {"hullMargin", reader.number(physics.hullMargin, 0, 1e6)}});
}

}  // namespace sherd
