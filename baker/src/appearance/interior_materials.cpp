// SPDX-License-Identifier: MIT
#include "appearance/interior_materials.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "recipe/recipe_reader.h"

namespace sherd {
namespace {

/// The names of the document's materials; "" for those without one.
std::vector<std::string> materialNames(const GltfDocument& document) {
    const auto json = nlohmann::json::parse(document.json, nullptr, false);
    std::vector<std::string> names;
    if (!json.is_object() || !json.contains("materials") || !json["materials"].is_array())
        return names;
    for (const auto& material : json["materials"]) {
        const bool named =
            material.is_object() && material.contains("name") && material["name"].is_string();
        names.push_back(named ? material["name"].get<std::string>() : "");
    }
    return names;
}

std::string quotedList(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) {
        if (name.empty()) continue;
        list += list.empty() ? "\"" : ", \"";
        list += name;
        list += '"';
    }
    return list.empty() ? "none with a name" : list;
}

class Chooser {
  public:
    Chooser(const GltfDocument& document, const Recipe& recipe)
        : recipe_(recipe), names_(materialNames(document)) {}

    Result<ChosenMaterials> run(std::span<const SurfaceMesh* const> meshes) {
        ChosenMaterials chosen;
        for (size_t i = 0; i < names_.size(); ++i)
            if (!names_[i].empty()) chosen.materials.names[static_cast<int32_t>(i)] = names_[i];
        for (const auto& [outer, inner] : recipe_.interior.materials) {
            const std::string pointer = RecipeReader::below("/interior/materials", outer);
            if (std::find(names_.begin(), names_.end(), outer) == names_.end() || outer.empty())
                return unknown(outer, "on its surface", pointer);
            const auto index = indexOf(inner);
            if (!index) return unknown(inner, "for hidden faces", pointer);
            for (size_t i = 0; i < names_.size(); ++i)
                if (names_[i] == outer) chosen.materials.below[static_cast<int32_t>(i)] = *index;
        }
        if (!recipe_.interior.material.empty()) {
            const auto index = indexOf(recipe_.interior.material);
            if (!index)
                return unknown(recipe_.interior.material, "for hidden faces", "/interior/material");
            chosen.materials.other = *index;
        } else if (needsOther(chosen.materials, meshes)) {
            chosen.materials.other = static_cast<int32_t>(names_.size());
            chosen.added.emplace().name = "sherd interior";
        }
        return chosen;
    }

  private:
    std::optional<int32_t> indexOf(const std::string& name) const {
        const auto it = std::find(names_.begin(), names_.end(), name);
        if (it == names_.end() || name.empty()) return std::nullopt;
        return static_cast<int32_t>(it - names_.begin());
    }

    tl::unexpected<Error> unknown(const std::string& name, const std::string& what,
                                  const std::string& pointer) const {
        return tl::unexpected(Error{ErrorCode::badArgument,
                                    "the model has no material named \"" + name + "\" " + what +
                                        "; it has " + quotedList(names_),
                                    recipe_.place(pointer)});
    }

    static bool needsOther(const InteriorMaterials& materials,
                           std::span<const SurfaceMesh* const> meshes) {
        for (const SurfaceMesh* mesh : meshes)
            for (const int32_t material : mesh->materials)
                if (!materials.below.contains(material)) return true;
        return false;
    }

    const Recipe& recipe_;
    std::vector<std::string> names_;
};

}  // namespace

Result<ChosenMaterials> chooseInteriorMaterials(const GltfDocument& document,
                                                std::span<const SurfaceMesh* const> meshes,
                                                const Recipe& recipe) {
    return Chooser(document, recipe).run(meshes);
}

}  // namespace sherd
