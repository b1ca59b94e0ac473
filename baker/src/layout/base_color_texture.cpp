// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>

#include "import/json_lookup.h"
#include "sherd/baker/layout.h"

namespace sherd {

namespace {

using Json = nlohmann::json;

std::string base64(std::span<const uint8_t> bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = uint32_t{bytes[i]} << 16U;
        if (i + 1 < bytes.size()) group |= uint32_t{bytes[i + 1]} << 8U;
        if (i + 2 < bytes.size()) group |= bytes[i + 2];
        for (unsigned k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : kDigits[group >> (18U - 6U * k) & 63U];
    }
    return out;
}

/// The bytes an image's buffer view names, if they are all there.
std::optional<std::span<const uint8_t>> viewBytes(const GltfDocument& document, const Json& view) {
    const Json& offset = at(view, "byteOffset");
    const Json& length = at(view, "byteLength");
    if (!length.is_number_unsigned() || (!offset.is_null() && !offset.is_number_unsigned()))
        return std::nullopt;
    const size_t begin = offset.is_null() ? 0 : offset.get<size_t>();
    const size_t size = length.get<size_t>();
    if (begin > document.bin.size() || size > document.bin.size() - begin) return std::nullopt;
    return std::span(document.bin).subspan(begin, size);
}

/// The material indices of the mesh, the one with most triangles first.
std::vector<int32_t> materialsByUse(const SurfaceMesh& mesh) {
    std::vector<std::pair<size_t, size_t>> uses;  // count, slot
    for (size_t i = 0; i < mesh.materials.size(); ++i) uses.emplace_back(0, i);
    for (const uint32_t slot : mesh.triangleMaterials)
        if (slot < uses.size()) ++uses[slot].first;
    std::stable_sort(uses.begin(), uses.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<int32_t> order;
    order.reserve(uses.size());
    for (const auto& [count, slot] : uses) order.push_back(mesh.materials[slot]);
    return order;
}

std::string imageUri(const GltfDocument& document, const Json& json, const Json& image,
                     std::vector<std::string>& warnings) {
    const Json& uri = at(image, "uri");
    if (uri.is_string()) {
        const auto& text = uri.get_ref<const std::string&>();
        if (text.rfind("data:image/", 0) == 0) return text;
        warnings.emplace_back("the texture is not part of the file and left out");
        return {};
    }
    const Json& mime = at(image, "mimeType");
    const bool known = mime == "image/png" || mime == "image/jpeg" || mime == "image/webp";
    const auto bytes = viewBytes(document, at(at(json, "bufferViews"), at(image, "bufferView")));
    if (!known || !bytes) {
        warnings.emplace_back("the texture cannot be read and is left out");
        return {};
    }
    return "data:" + mime.get<std::string>() + ";base64," + base64(*bytes);
}

}  // namespace

std::string baseColorTexture(const GltfDocument& document, const SurfaceMesh& mesh,
                             std::vector<std::string>& warnings) {
    const Json json = Json::parse(document.json, nullptr, /*allow_exceptions=*/false);
    for (const int32_t material : materialsByUse(mesh)) {
        if (material < 0) continue;
        const Json& info = at(at(at(at(json, "materials"), Json(static_cast<uint32_t>(material))),
                                 "pbrMetallicRoughness"),
                              "baseColorTexture");
        const Json& texture = at(at(json, "textures"), at(info, "index"));
        const Json& image = at(at(json, "images"), at(texture, "source"));
        if (image.is_null()) continue;
        const Json& overriding =
            at(at(at(info, "extensions"), "KHR_texture_transform"), "texCoord");
        const Json& set = overriding.is_null() ? at(info, "texCoord") : overriding;
        const uint64_t uvSet = set.is_number_unsigned() ? set.get<uint64_t>() : 0;
        if (mesh.uvSemantic == "TEXCOORD_" + std::to_string(uvSet))
            return imageUri(document, json, image, warnings);
        warnings.emplace_back("the texture uses another UV set than the lines and is left out");
        return {};
    }
    return {};
}

}  // namespace sherd
