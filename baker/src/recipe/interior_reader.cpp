// SPDX-License-Identifier: MIT
#include "recipe/interior_reader.h"

namespace sherd {
namespace {

using Json = nlohmann::json;

bool readNames(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
               std::map<std::string, std::string>& names) {
    if (!json.is_object())
        return reader.wrong(pointer, "must be an object {\"outer material\": \"inner material\"}");
    for (const auto& [key, value] : json.items()) {
        if (!value.is_string())
            return reader.wrong(RecipeReader::below(pointer, key), "must be a string");
        names[key] = value.get<std::string>();
    }
    return true;
}

/// true, false, or the name of an attribute.
bool readDepthColor(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
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

bool readShell(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
               ShellSettings& shell) {
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

}  // namespace

bool readInterior(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                  InteriorSettings& interior) {
    std::string type;
    bool flat = false;
    if (!reader.object(json, pointer,
                       {{"type", reader.word(type, {"medial", "shell", "solid"})},
                        {"shell",
                         [&](const nlohmann::json& j, const std::string& p) {
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
                         [&](const nlohmann::json& j, const std::string& p) {
                             return readNames(reader, j, p, interior.materials);
                         }},
                        {"normals", reader.choice(flat, "smooth", "flat")},
                        {"depthColor",
                         [&](const nlohmann::json& j, const std::string& p) {
                             return readDepthColor(reader, j, p, interior.depthColor);
                         }},
                        {"roughness",
                         [&](const nlohmann::json& j, const std::string& p) {
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
    interior.type = parseInteriorType(type).value();
    return true;
}

}  // namespace sherd
