// SPDX-License-Identifier: MIT
#include "sherd/baker/recipe.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

namespace sherd {
namespace {

using Json = nlohmann::json;

/// Reads one JSON object field by field; every key must be known. The first error stops it.
class Reader {
  public:
    Reader(std::string file, Error& error) : file_(std::move(file)), error_(error) {}

    using Field = std::function<bool(const Json&, const std::string& pointer)>;

    bool object(const Json& json, const std::string& pointer,
                const std::map<std::string, Field>& fields) {
        if (!json.is_object()) return wrong(pointer, "must be an object");
        for (const auto& [key, value] : json.items()) {
            const std::string here = std::string(pointer).append("/").append(key);
            const auto it = fields.find(key);
            if (it == fields.end()) {
                std::string known;
                for (const auto& [name, field] : fields) {
                    known += known.empty() ? "" : ", ";
                    known += name;
                }
                return wrong(here, "is not a known key here; known are " + known);
            }
            if (!it->second(value, here)) return false;
        }
        return true;
    }

    Field number(double& target, double low, double high) {
        return [this, &target, low, high](const Json& json, const std::string& pointer) {
            const bool ok =
                json.is_number() && json.get<double>() >= low && json.get<double>() <= high;
            if (!ok)
                return wrong(pointer, "must be a number from " + text(low) + " to " + text(high));
            target = json.get<double>();
            return true;
        };
    }
    template <class Integer>
    Field integer(Integer& target, int low, int high) {
        return [this, &target, low, high](const Json& json, const std::string& pointer) {
            const bool ok =
                json.is_number_integer() && json.get<double>() >= low && json.get<double>() <= high;
            if (!ok) {
                return wrong(pointer, "must be a whole number from " + std::to_string(low) +
                                          " to " + std::to_string(high));
            }
            target = json.get<Integer>();
            return true;
        };
    }
    Field boolean(bool& target) {
        return [this, &target](const Json& json, const std::string& pointer) {
            if (!json.is_boolean()) return wrong(pointer, "must be true or false");
            target = json.get<bool>();
            return true;
        };
    }
    Field boolean(std::optional<bool>& target) {
        return [this, &target](const Json& json, const std::string& pointer) {
            target.emplace();
            return boolean(*target)(json, pointer);
        };
    }
    Field string(std::string& target) {
        return [this, &target](const Json& json, const std::string& pointer) {
            if (!json.is_string()) return wrong(pointer, "must be a string");
            target = json.get<std::string>();
            return true;
        };
    }

    /// One of two words; the second one is true.
    Field choice(bool& target, const std::string& no, const std::string& yes) {
        return [this, &target, no, yes](const Json& json, const std::string& pointer) {
            if (json != no && json != yes)
                return wrong(pointer, "must be \"" + no + "\" or \"" + yes + "\"");
            target = json == yes;
            return true;
        };
    }

    std::string place(const std::string& pointer) const { return file_ + "#" + pointer; }

    bool wrong(const std::string& pointer, const std::string& what) {
        error_ = {ErrorCode::invalidData,
                  (pointer.empty() ? std::string("the recipe ")
                                   : "\"" + pointer.substr(pointer.rfind('/') + 1) + "\" ") +
                      what,
                  file_ + "#" + pointer};
        return false;
    }

  private:
    static std::string text(double value) {
        std::ostringstream out;
        out << value;
        return out.str();
    }

    std::string file_;
    Error& error_;
};

bool readLevels(Reader& reader, const Json& json, const std::string& pointer, Recipe& recipe) {
    if (!json.is_array() || json.empty())
        return reader.wrong(pointer, "must be a list with at least one level");
    for (size_t i = 0; i < json.size(); ++i) {
        RecipeLevel level;
        std::string map, pattern, cut, projection;
        const std::string here = pointer + "/" + std::to_string(i);
        if (!reader.object(json[i], here,
                           {{"map", reader.string(map)},
                            {"pattern", reader.string(pattern)},
                            {"cut", reader.string(cut)},
                            {"projection", reader.string(projection)},
                            {"name", reader.string(level.name)}}))
            return false;
        if ((map.empty() ? 0 : 1) + (pattern.empty() ? 0 : 1) + (cut.empty() ? 0 : 1) != 1)
            return reader.wrong(
                here,
                "needs one of a \"map\", the path of a drawing (SVG, JSON, PNG, "
                "JPEG), a \"pattern\" like \"voronoi:12\", and a \"cut\" through the "
                "volume like \"voronoi:12\"");
        if (cut.empty() && !recipe.levels.empty() && recipe.levels.back().cut)
            return reader.wrong(here, "comes too late: levels of lines come before those of cuts");
        level.map = map;
        if (!pattern.empty()) {
            Result<Pattern> parsed = parsePattern(pattern);
            if (!parsed) return reader.wrong(here + "/pattern", ": " + parsed.error().message);
            level.pattern = std::move(*parsed);
        }
        if (!cut.empty()) {
            Result<VolumeCut> parsed = parseVolumeCut(cut);
            if (!parsed) return reader.wrong(here + "/cut", ": " + parsed.error().message);
            level.cut = std::move(*parsed);
            level.cut->where = reader.place(here + "/cut");
        }
        if (!projection.empty()) {
            const Result<Projection> parsed = parseProjection(projection);
            if (!parsed) return reader.wrong(here + "/projection", ": " + parsed.error().message);
            level.projection = *parsed;
        }
        recipe.levels.push_back(level);
    }
    return true;
}

bool readBitmap(Reader& reader, const Json& json, const std::string& pointer,
                BitmapOptions& bitmap) {
    double threshold = -1;
    if (!reader.object(json, pointer,
                       {{"threshold", reader.number(threshold, 0, 1)},
                        {"tolerance", reader.number(bitmap.tolerance, 0, 1000)},
                        {"spur", reader.number(bitmap.spur, 0, 1000)},
                        {"curves", reader.boolean(bitmap.curves)}}))
        return false;
    if (threshold >= 0) bitmap.threshold = threshold;
    return true;
}

bool readLevelColors(Reader& reader, const Json& json, const std::string& pointer, Recipe& recipe) {
    if (!json.is_object()) return reader.wrong(pointer, "must be an object {\"#ff0000\": 2}");
    for (const auto& [color, level] : json.items()) {
        if (!level.is_number_unsigned() || level < 1 || level > 64)
            return reader.wrong((pointer + "/").append(color), "must be a level from 1 to 64");
        recipe.levelOfColor.emplace_back(color, level.get<uint32_t>());
    }
    return true;
}

bool readNames(Reader& reader, const Json& json, const std::string& pointer,
               std::map<std::string, std::string>& names) {
    if (!json.is_object())
        return reader.wrong(pointer, "must be an object {\"outer material\": \"inner material\"}");
    for (const auto& [key, value] : json.items()) {
        if (!value.is_string())
            return reader.wrong(std::string(pointer).append("/").append(key), "must be a string");
        names[key] = value.get<std::string>();
    }
    return true;
}

/// true, false, or the name of an attribute.
bool readDepthColor(Reader& reader, const Json& json, const std::string& pointer,
                    std::string& semantic) {
    if (json.is_boolean()) {
        semantic = json.get<bool>() ? "COLOR_0" : "";
        return true;
    }
    const std::string name = json.is_string() ? json.get<std::string>() : "";
    const bool color =
        name.size() == 7 && name.starts_with("COLOR_") && name[6] >= '0' && name[6] <= '9';
    const bool custom =
        name.size() > 1 && name[0] == '_' &&
        name.find_first_not_of("_ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789") == std::string::npos;
    if (!color && !custom) {
        return reader.wrong(pointer,
                            "must be true, false, \"COLOR_0\" to \"COLOR_9\", or the name of an "
                            "attribute like \"_DEPTH\"");
    }
    semantic = name;
    return true;
}

bool readShell(Reader& reader, const Json& json, const std::string& pointer, ShellSettings& shell) {
    std::string texture;
    if (!reader.object(json, pointer,
                       {{"thickness", reader.number(shell.thickness, 0, 1e9)},
                        {"attribute", reader.string(shell.attribute)},
                        {"channel", reader.integer(shell.channel, 0, 3)},
                        {"texture", reader.string(texture)}})) {
        return false;
    }
    if (!texture.empty() && !shell.attribute.empty())
        return reader.wrong(pointer, "may have an \"attribute\" or a \"texture\", not both");
    shell.texture = texture;
    return true;
}

bool readInterior(Reader& reader, const Json& json, const std::string& pointer,
                  InteriorSettings& interior) {
    std::string type;
    bool flat = false;
    if (!reader.object(json, pointer,
                       {{"type", reader.string(type)},
                        {"shell",
                         [&](const Json& j, const std::string& p) {
                             return readShell(reader, j, p, interior.shell);
                         }},
                        {"thesis", reader.boolean(interior.thesis)},
                        {"preSmoothing", reader.integer(interior.preSmoothing, 0, 1000)},
                        {"postSmoothing", reader.integer(interior.postSmoothing, 0, 1000)},
                        {"separationAngle", reader.number(interior.separationAngle, 0, 180)},
                        {"scaleAxis", reader.number(interior.scaleAxis, 1, 10)},
                        {"smallestRadius", reader.number(interior.smallestRadius, 0, 1)},
                        {"material", reader.string(interior.material)},
                        {"materials",
                         [&](const Json& j, const std::string& p) {
                             return readNames(reader, j, p, interior.materials);
                         }},
                        {"normals", reader.choice(flat, "smooth", "flat")},
                        {"depthColor",
                         [&](const Json& j, const std::string& p) {
                             return readDepthColor(reader, j, p, interior.depthColor);
                         }},
                        {"roughness",
                         [&](const Json& j, const std::string& p) {
                             Roughness& r = interior.roughness;
                             return reader.object(
                                 j, p,
                                 {{"amplitude", reader.number(r.amplitude, 0, 1e6)},
                                  {"size", reader.number(r.size, 0, 1e6)},
                                  {"seed", reader.integer(r.seed, 0, 1'000'000'000)}});
                         }},
                        {"creaseAngle", reader.number(interior.creaseAngle, 0, 180)},
                        {"uvMetresPerTile", reader.number(interior.uvMetresPerTile, 0, 1e9)}})) {
        return false;
    }
    interior.normals = flat ? InteriorNormals::flat : InteriorNormals::smooth;
    if (type.empty()) return true;
    const Result<InteriorType> parsed = parseInteriorType(type);
    if (!parsed) return reader.wrong(pointer + "/type", ": " + parsed.error().message);
    interior.type = *parsed;
    return true;
}

bool readPhysics(Reader& reader, const Json& json, const std::string& pointer,
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

}  // namespace

Result<Recipe> parseRecipe(std::string_view text, const std::string& name) {
    Json json;
    try {
        json = Json::parse(text, nullptr, true, true);
    } catch (const Json::exception& e) {
        return fail(ErrorCode::malformed, std::string("the recipe is not valid JSON: ") + e.what(),
                    name);
    }
    Recipe recipe;
    recipe.file = name;
    Error error;
    std::string wrap;
    Reader reader(name, error);
    const bool ok = reader.object(
        json, "",
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
         {"curveTolerance", reader.number(recipe.curveTolerance, 1e-7, 0.1)},
         {"seamJoinShare", reader.number(recipe.seamJoinShare, 0, 0.1)},
         {"minimumComponentShare", reader.number(recipe.minimumComponentShare, 0, 0.5)},
         {"closeGaps", reader.number(recipe.closeGaps, 0, 1)},
         {"snapShare", reader.number(recipe.snapShare, 0, 10)},
         {"wrap", reader.string(wrap)},
         {"modelLines", reader.boolean(recipe.modelLines)},
         {"splitParts", reader.boolean(recipe.splitParts)},
         {"bitmap", [&](const Json& j,
                        const std::string& p) { return readBitmap(reader, j, p, recipe.bitmap); }},
         {"levelColors",
          [&](const Json& j, const std::string& p) {
              return readLevelColors(reader, j, p, recipe);
          }},
         {"capHoles", reader.boolean(recipe.capHoles)},
         {"allowOpen", reader.boolean(recipe.allowOpen)},
         {"measure", reader.boolean(recipe.measure)}});
    if (!ok) return tl::unexpected(error);
    if (!wrap.empty()) {
        const Result<PageWrap> parsed = parsePageWrap(wrap);
        if (!parsed) return fail(ErrorCode::invalidData, parsed.error().message, name + "#/wrap");
        recipe.wrap = *parsed;
    }
    return recipe;
}

Result<InteriorType> parseInteriorType(std::string_view text) {
    if (text == "medial") return InteriorType::medial;
    if (text == "shell") return InteriorType::shell;
    if (text == "solid") return InteriorType::solid;
    return fail(ErrorCode::badArgument,
                "\"" + std::string(text) + "\" is no way to close pieces: medial or solid");
}

Result<PageWrap> parsePageWrap(std::string_view text) {
    if (text == "texture") return PageWrap::texture;
    if (text == "none") return PageWrap::none;
    if (text == "repeat") return PageWrap::repeat;
    if (text == "mirror") return PageWrap::mirror;
    if (text == "clamp") return PageWrap::clamp;
    return fail(ErrorCode::badArgument, "\"" + std::string(text) +
                                            "\" is no way to wrap a page: texture, none, repeat, "
                                            "mirror or clamp");
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
    if (recipe) {
        std::filesystem::path& texture = recipe->interior.shell.texture;
        if (!texture.empty()) texture = path.parent_path() / texture;
        for (RecipeLevel& level : recipe->levels) {
            if (!level.map.empty()) level.map = path.parent_path() / level.map;
            if (!level.pattern || level.pattern->density.empty()) continue;
            std::string& density = level.pattern->density;
            if (density != "color") density = (path.parent_path() / density).string();
        }
    }
    return recipe;
}

}  // namespace sherd
