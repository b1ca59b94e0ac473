// SPDX-License-Identifier: MIT
// glTF samplers and KHR_texture_transform: uv' = translation * rotation * scale * uv.
//
// The extension turns texture coordinates counter-clockwise as seen on the picture, v pointing
// down: (1, 0) turned by 90 degrees is (0, -1). The shader listing in its README has the opposite
// sign (KhronosGroup/glTF issue 1563); its words, its worked example (offset [0, 1], rotation pi/2
// and scale 0.5 show the lower left quadrant) and the viewers agree on this one.
#include "import/texture_placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <optional>

#include "import/json_lookup.h"

namespace sherd {
namespace {

using Json = nlohmann::json;

/// Nothing for a mode glTF does not have.
std::optional<Wrap> wrapOf(const Json& mode) {
    if (mode.is_null() || mode == 10497) return Wrap::repeat;
    if (mode == 33648) return Wrap::mirror;
    if (mode == 33071) return Wrap::clamp;
    return std::nullopt;
}

std::optional<double> numberOf(const Json& value, double otherwise) {
    if (value.is_null()) return otherwise;
    if (!value.is_number() || !std::isfinite(value.get<double>())) return std::nullopt;
    return value.get<double>();
}

std::optional<glm::dvec2> pairOf(const Json& value, glm::dvec2 otherwise) {
    if (value.is_null()) return otherwise;
    if (!value.is_array() || value.size() != 2) return std::nullopt;
    const auto x = value[0].is_null() ? std::nullopt : numberOf(value[0], 0);
    const auto y = value[1].is_null() ? std::nullopt : numberOf(value[1], 0);
    return x && y ? std::optional(glm::dvec2(*x, *y)) : std::nullopt;
}

/// Nothing when the numbers are none, or flatten the picture.
std::optional<glm::dmat3> transformOf(const Json& extension) {
    const auto offset = pairOf(at(extension, "offset"), {0, 0});
    const auto rotation = numberOf(at(extension, "rotation"), 0);
    const auto scale = pairOf(at(extension, "scale"), {1, 1});
    if (!offset || !rotation || !scale) return std::nullopt;
    const double c = std::cos(*rotation);
    const double s = std::sin(*rotation);
    const glm::dmat3 out(scale->x * c, scale->x * -s, 0,  //
                         scale->y * s, scale->y * c, 0,   //
                         offset->x, offset->y, 1);
    const double determinant = glm::determinant(out);
    return std::isfinite(determinant) && determinant != 0 ? std::optional(out) : std::nullopt;
}

/// The set a texture lies in: the extension's word goes before the texture's own.
std::optional<uint64_t> uvSetOf(const Json& texture, const Json& extension) {
    const Json& overriding = at(extension, "texCoord");
    const Json& set = overriding.is_null() ? at(texture, "texCoord") : overriding;
    if (set.is_null()) return 0;
    return set.is_number_unsigned() ? std::optional(set.get<uint64_t>()) : std::nullopt;
}

void readPlacement(const Json& document, const Json& info, MaterialPicture& picture) {
    const Json& texture = at(at(document, "textures"), at(info, "index"));
    if (!texture.is_object()) {
        picture.problem = "its base-colour texture does not exist";
        return;
    }
    const Json& extension = at(at(info, "extensions"), "KHR_texture_transform");
    const auto set = uvSetOf(info, extension);
    picture.uvSet = set.value_or(0);
    const Json& samplerIndex = at(texture, "sampler");
    const Json& sampler = at(at(document, "samplers"), samplerIndex);
    const auto wrapU = wrapOf(at(sampler, "wrapS"));
    const auto wrapV = wrapOf(at(sampler, "wrapT"));
    const auto transform = transformOf(extension);
    if (!set) {
        picture.problem = "the texCoord of its base-colour texture is not a whole number";
    } else if ((!samplerIndex.is_null() && !sampler.is_object()) || !wrapU || !wrapV) {
        picture.problem = "the sampler of its base-colour texture has a wrap glTF does not define";
    } else if (!transform || (!extension.is_null() && !extension.is_object())) {
        picture.problem =
            "the KHR_texture_transform of its base-colour texture holds numbers that place it "
            "nowhere";
    } else {
        picture.placement = {*transform, *wrapU, *wrapV};
    }
}

}  // namespace

std::vector<MaterialPicture> readMaterialPictures(const Json& document) {
    std::vector<MaterialPicture> pictures;
    const Json& materials = at(document, "materials");
    if (!materials.is_array()) return pictures;
    for (const Json& material : materials) {
        MaterialPicture& picture = pictures.emplace_back();
        const Json& name = at(material, "name");
        picture.label = name.is_string() ? "material \"" + name.get<std::string>() + "\""
                                         : "material " + std::to_string(pictures.size() - 1);
        const Json& info = at(at(material, "pbrMetallicRoughness"), "baseColorTexture");
        picture.present = info.is_object();
        if (picture.present) readPlacement(document, info, picture);
    }
    return pictures;
}

void placeTextures(const std::vector<MaterialPicture>& pictures, SurfaceMesh& mesh) {
    mesh.placements.clear();
    if (mesh.uvSemantic.empty()) return;
    mesh.placements.resize(mesh.materials.size());
    for (size_t slot = 0; slot < mesh.materials.size(); ++slot) {
        const int32_t material = mesh.materials[slot];
        if (material < 0 || static_cast<size_t>(material) >= pictures.size()) continue;
        const MaterialPicture& picture = pictures[static_cast<size_t>(material)];
        if (!picture.present) continue;
        const std::string set = "TEXCOORD_" + std::to_string(picture.uvSet);
        if (!picture.problem.empty()) {
            mesh.warnings.push_back(picture.label + ": " + picture.problem +
                                    "; it is taken to lie plainly in the UV set, repeating");
        } else if (set != mesh.uvSemantic) {
            mesh.warnings.push_back("lines are drawn in " + mesh.uvSemantic + ", the picture of " +
                                    picture.label + " lies in " + set + "; choose it with --uv " +
                                    std::to_string(picture.uvSet));
        } else {
            mesh.placements[slot] = picture.placement;
        }
    }
    const bool plain =
        std::all_of(mesh.placements.begin(), mesh.placements.end(),
                    [](const TexturePlacement& p) { return p == TexturePlacement(); });
    if (plain) mesh.placements.clear();
}

}  // namespace sherd
