// SPDX-License-Identifier: MIT
#include "recipe/physics_reader.h"

namespace sherd {
namespace {

constexpr double kLeastDensity = 1e-6;  // kg/m^3; nothing has no mass

}  // namespace

bool readPhysics(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                 PhysicsSettings& physics) {
    return reader.object(json, pointer,
                         {{"density", reader.number(physics.density, kLeastDensity, 1e9)},
                          {"friction", reader.number(physics.friction, 0, 100)},
                          {"restitution", reader.number(physics.restitution, 0, 1)},
                          {"strength", reader.number(physics.strength, 0, 1e15)},
                          {"toughness", reader.number(physics.toughness, 0, 1e15)},
                          {"convexParts", reader.integer(physics.convexParts, 1, 8)},
                          {"hullVertices", reader.integer(physics.hullVertices, 4, 255)},
                          {"hullMargin", reader.number(physics.hullMargin, 0, 1e6)}});
}

bool readMaterials(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                   std::map<std::string, PhysicalMaterial>& materials) {
    if (!json.is_object())
        return reader.wrong(pointer, "must be an object {\"brick\": {\"density\": 1900}}");
    for (const auto& [name, value] : json.items()) {
        PhysicalMaterial& material = materials[name];
        if (!reader.object(value, RecipeReader::below(pointer, name),
                           {{"density", reader.number(material.density, kLeastDensity, 1e9)},
                            {"friction", reader.number(material.friction, 0, 100)},
                            {"restitution", reader.number(material.restitution, 0, 1)},
                            {"strength", reader.number(material.strength, 0, 1e15)},
                            {"toughness", reader.number(material.toughness, 0, 1e15)}}))
            return false;
    }
    return true;
}

}  // namespace sherd
