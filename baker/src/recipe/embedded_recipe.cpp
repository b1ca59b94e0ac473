// SPDX-License-Identifier: MIT
#include "recipe/embedded_recipe.h"

#include <vector>

#include "recipe/recipe_json.h"

namespace sherd {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr size_t kLongestText = 1 << 20;
constexpr size_t kLongestPath = 1024;

bool leavesItsFolder(const fs::path& path) {
    const fs::path plain = path.lexically_normal();
    return path.has_root_path() || (!plain.empty() && *plain.begin() == "..");
}

/// The files a recipe names.
std::vector<fs::path> filesOf(const Recipe& recipe) {
    std::vector<fs::path> files{recipe.interior.shell.texture};
    for (const RecipeLevel& level : recipe.levels) {
        files.push_back(level.map);
        if (level.cut) files.push_back(level.cut->map);
        if (level.pattern && level.pattern->density != "color")
            files.emplace_back(level.pattern->density);
    }
    return files;
}

Result<Recipe> written(const Json& json, const RecipePlace& place) {
    Result<Recipe> recipe = recipeOf(json, place.model.string(), place.pointer);
    if (!recipe) return recipe;
    for (const fs::path& file : filesOf(*recipe)) {
        if (!leavesItsFolder(file)) continue;
        return fail(ErrorCode::invalidData,
                    "the recipe names \"" + file.string() +
                        "\", which is not in the model's folder; put it there, or keep the recipe "
                        "in a file of its own and give it with --recipe",
                    place.text());
    }
    resolvePaths(*recipe, place.model.parent_path());
    return recipe;
}

/// JSON starts with a brace, or with a comment before it.
bool isJsonText(const std::string& text) {
    const size_t start = text.find_first_not_of(" \t\r\n");
    if (start == std::string::npos) return false;
    return text[start] == '{' || text.compare(start, 2, "//") == 0 ||
           text.compare(start, 2, "/*") == 0;
}

Result<Recipe> fromText(const std::string& text, const RecipePlace& place) {
    if (text.size() > kLongestText)
        return fail(ErrorCode::limitExceeded, "the recipe is longer than 1 MiB", place.text());
    const Result<Json> json = parseJson(text, place.model.string(), place.pointer);
    if (!json) return tl::unexpected(json.error());
    return written(*json, place);
}

Result<Recipe> fromFile(const std::string& text, const RecipePlace& place) {
    if (text.size() > kLongestPath)
        return fail(ErrorCode::limitExceeded,
                    "a string of " + std::to_string(text.size()) +
                        " characters is no path of a recipe; JSON text begins with {",
                    place.text());
    const fs::path path = text;
    if (leavesItsFolder(path) || text.find('\0') != std::string::npos)
        return fail(ErrorCode::invalidData,
                    "the recipe \"" + text +
                        "\" is not in the model's folder or below; put it "
                        "there, or give it with --recipe",
                    place.text());
    const fs::path file = place.model.parent_path() / path;
    std::error_code status;
    if (fs::exists(file, status) && !fs::is_regular_file(file, status))
        return fail(ErrorCode::fileRead, "\"" + text + "\" is not a file, so no recipe",
                    place.text());
    Result<Recipe> recipe = readRecipe(file);
    if (!recipe) {
        Error error = recipe.error();
        error.where += ", which " + place.text() + " names";
        return tl::unexpected(std::move(error));
    }
    return recipe;
}

}  // namespace

Result<Recipe> readEmbeddedRecipe(const Json& value, const RecipePlace& place) {
    if (value.is_object()) return written(value, place);
    if (!value.is_string() || value.get_ref<const std::string&>().empty())
        return fail(ErrorCode::invalidData,
                    "must be a recipe as an object, a recipe as JSON text, or the path of a recipe "
                    "relative to the model",
                    place.text());
    const auto& text = value.get_ref<const std::string&>();
    return isJsonText(text) ? fromText(text, place) : fromFile(text, place);
}

}  // namespace sherd
