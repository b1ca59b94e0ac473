// SPDX-License-Identifier: MIT
#include "import/node_recipes.h"

#include <nlohmann/json.hpp>

#include "import/json_lookup.h"
#include "import/node_choice.h"
#include "import/node_transforms.h"
#include "recipe/embedded_recipe.h"

namespace sherd {
namespace {

using Json = nlohmann::json;

const Json& recipeIn(const Json& item) {
    return at(at(item, "extras"), "sherd");
}

class RecipeFinder {
  public:
    RecipeFinder(const Json& json, const GltfSource& source, std::filesystem::path path)
        : json_(json), source_(source), path_(std::move(path)) {}

    Result<NodeRecipes> run(const std::vector<int>& chosen, bool join) {
        for (const int node : chosen)
            if (auto ok = take(node); !ok) return tl::unexpected(ok.error());
        if (join && found_.recipes.size() > 1)
            return contradiction("nodes that are joined carry different recipes",
                                 found_.recipes[1].place(""));
        if (join && !found_.recipes.empty())
            for (const int node : chosen) found_.ofNode[node] = 0;
        if (auto ok = agreeOnUnit(); !ok) return tl::unexpected(ok.error());
        warnOfOthers();
        return std::move(found_);
    }

  private:
    tl::unexpected<Error> contradiction(const std::string& what, const std::string& where) const {
        return fail(ErrorCode::invalidData,
                    what + " (the first is " + found_.recipes[0].place("") + "); make them alike",
                    where);
    }

    Result<void> take(int node) {
        const Json& own = recipeIn(at(at(json_, "nodes"), Json(static_cast<size_t>(node))));
        const int mesh = source_.model.nodes[static_cast<size_t>(node)].mesh;
        const Json& shared = recipeIn(at(at(json_, "meshes"), Json(static_cast<size_t>(mesh))));
        if (own.is_null() && shared.is_null()) return {};
        const Json& value = own.is_null() ? shared : own;
        const std::string pointer =
            (own.is_null() ? "/meshes/" + std::to_string(mesh) : "/nodes/" + std::to_string(node)) +
            "/extras/sherd";
        Result<Recipe> recipe = readEmbeddedRecipe(value, {path_, pointer});
        if (!recipe) return tl::unexpected(recipe.error());
        // What was read as a recipe is not nested deeply.
        const auto [it, isNew] =
            byText_.try_emplace(value.dump(), static_cast<int32_t>(found_.recipes.size()));
        if (isNew) found_.recipes.push_back(std::move(*recipe));
        found_.ofNode[node] = it->second;
        return {};
    }

    Result<void> agreeOnUnit() {
        for (const Recipe& recipe : found_.recipes) {
            if (!recipe.unitScale) continue;
            if (found_.unitScale && *found_.unitScale != *recipe.unitScale)
                return contradiction("a scene has one unit, but its recipes name several",
                                     recipe.place("/unitScale"));
            found_.unitScale = recipe.unitScale;
        }
        return {};
    }

    void warnOfOthers() {
        for (size_t i = 0; i < source_.model.nodes.size(); ++i) {
            if (source_.model.nodes[i].mesh >= 0) continue;
            if (recipeIn(at(at(json_, "nodes"), Json(i))).is_null()) continue;
            found_.warnings.push_back(labelOfNode(source_, static_cast<int>(i)) +
                                      " carries a recipe but shows no mesh; put it on the object "
                                      "that it breaks");
        }
    }

    const Json& json_;
    const GltfSource& source_;
    std::filesystem::path path_;
    NodeRecipes found_;
    std::map<std::string, int32_t> byText_;
};

/// Most documents carry none, and need not be looked through.
bool mayCarry(const GltfDocument& document) {
    return document.json.find("\"sherd\"") != std::string::npos;
}

}  // namespace

int32_t NodeRecipes::of(int node) const {
    const auto found = ofNode.find(node);
    return found == ofNode.end() ? -1 : found->second;
}

Result<NodeRecipes> readNodeRecipes(const GltfDocument& document, const std::filesystem::path& path,
                                    const ImportOptions& options) {
    if (!mayCarry(document)) return NodeRecipes();
    auto source = parseGltfSource(document, path.filename().string());
    if (!source) return tl::unexpected(source.error());
    const auto parents = nodeParents(*source);
    if (!parents) return tl::unexpected(parents.error());
    const auto chosen = chooseNodes(*source, *parents, options);
    if (!chosen) return tl::unexpected(chosen.error());
    const Json json = Json::parse(document.json, nullptr, false);
    return RecipeFinder(json, *source, path).run(*chosen, options.join);
}

size_t countNodeRecipes(const GltfDocument& document) {
    if (!mayCarry(document)) return 0;
    const Json json = Json::parse(document.json, nullptr, false);
    size_t count = 0;
    for (const char* key : {"nodes", "meshes"})
        for (const Json& item : at(json, key)) count += recipeIn(item).is_null() ? 0 : 1;
    return count;
}

}  // namespace sherd
