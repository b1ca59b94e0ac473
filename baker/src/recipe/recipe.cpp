// SPDX-License-Identifier: MIT
#include "sherd/baker/recipe.h"

#include <fstream>
#include <sstream>

#include "recipe/anchor_reader.h"
#include "recipe/interior_reader.h"
#include "recipe/level_reader.h"
#include "recipe/line_reader.h"
#include "recipe/physics_reader.h"
#include "recipe/recipe_json.h"
#include "recipe/recipe_reader.h"

namespace sherd {
namespace {

using Json = nlohmann::json;

}  // namespace

Result<Recipe> parseRecipe(std::string_view text, const std::string& name) {
    const Result<Json> json = parseJson(text, name, "");
    if (!json) return tl::unexpected(json.error());
    return recipeOf(*json, name, "");
}

Result<Recipe> recipeOf(const Json& json, const std::string& file, const std::string& pointer) {
    Recipe recipe;
    recipe.file = file;
    recipe.pointer = pointer;
    Error error;
    std::string wrap, schema;
    RecipeReader reader(file, error);
    const bool ok = reader.object(
        json, pointer,
        {{"levels",
          [&](const Json& j, const std::string& p) { return readLevels(reader, j, p, recipe); }},
         {"interior",
          [&](const Json& j, const std::string& p) {
              return readInterior(reader, j, p, recipe.interior);
          }},
         {"physics",
          [&](const Json& j, const std::string& p) {
              return readPhysics(reader, j, p, recipe.physics);
          }},
         {"materials",
          [&](const Json& j, const std::string& p) {
              return readMaterials(reader, j, p, recipe.materials);
          }},
         {"anchors",
          [&](const Json& j, const std::string& p) {
              return readAnchors(reader, j, p, recipe.anchors);
          }},
         {"curveTolerance", reader.number(recipe.curveTolerance, 1e-7, 0.1)},
         {"seamJoinShare", reader.number(recipe.seamJoinShare, 0, 0.1)},
         {"minimumComponentShare", reader.number(recipe.minimumComponentShare, 0, 0.5)},
         {"closeGaps", reader.number(recipe.closeGaps, 0, 1)},
         {"snapShare", reader.number(recipe.snapShare, 0, 10)},
         {"wrap", reader.word(wrap, {"texture", "none", "repeat", "mirror", "clamp"})},
         {"modelLines", reader.boolean(recipe.modelLines)},
         {"splitParts", reader.boolean(recipe.splitParts)},
         {"bitmap", [&](const Json& j,
                        const std::string& p) { return readBitmap(reader, j, p, recipe.bitmap); }},
         {"levelColors",
          [&](const Json& j,
              const std::string& p) { return readLevelColors(reader, j, p, recipe); }},
         {"capHoles", reader.boolean(recipe.capHoles)},
         {"allowOpen", reader.boolean(recipe.allowOpen)},
         {"$schema", reader.string(schema)},  // for editors
         {"unitScale", reader.number(recipe.unitScale, 1e-6, 1e6)},
         {"measure", reader.boolean(recipe.measure)}});
    if (!ok) return tl::unexpected(error);
    if (!wrap.empty()) recipe.wrap = parsePageWrap(wrap).value();
    return recipe;
}

Result<Recipe> readRecipe(const std::filesystem::path& path) {
    std::error_code status;
    if (std::filesystem::is_directory(path, status)) {
        return fail(ErrorCode::fileRead, "this is a directory, not a recipe", path.string());
    }
    if (!std::filesystem::exists(path, status)) {
        return fail(ErrorCode::fileNotFound, "the recipe does not exist", path.string());
    }
    std::ifstream in(path, std::ios::binary);
    std::stringstream content;
    content << in.rdbuf();
    if (!in) return fail(ErrorCode::fileRead, "the recipe cannot be read", path.string());
    Result<Recipe> recipe = parseRecipe(content.str(), path.string());
    if (recipe) resolvePaths(*recipe, path.parent_path());
    return recipe;
}

void resolvePaths(Recipe& recipe, const std::filesystem::path& folder) {
    std::filesystem::path& texture = recipe.interior.shell.texture;
    if (!texture.empty()) texture = folder / texture;
    for (RecipeLevel& level : recipe.levels) {
        if (!level.map.empty()) level.map = folder / level.map;
        if (level.cut && !level.cut->map.empty()) level.cut->map = folder / level.cut->map;
        if (!level.pattern || level.pattern->density.empty()) continue;
        std::string& density = level.pattern->density;
        if (density != "color") density = (folder / density).string();
    }
}

}  // namespace sherd
