// SPDX-License-Identifier: MIT
#include "model_view.h"

#include <stb/stb_image.h>

#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <optional>

namespace sherd::samples {
namespace {

using nlohmann::json;

/// The value at the path, or null: the file may leave out what it likes.
const json* find(const json& from, const std::vector<const char*>& path) {
    const json* at = &from;
    for (const char* key : path) {
        if (!at->is_object() || !at->contains(key)) return nullptr;
        at = &(*at)[key];
    }
    return at;
}

const json* element(const json& document, const char* array, int64_t index) {
    const json* list = find(document, {array});
    if (list == nullptr || !list->is_array() || index < 0 ||
        index >= static_cast<int64_t>(list->size())) {
        return nullptr;
    }
    return &(*list)[static_cast<size_t>(index)];
}

double number(const json* value, double otherwise) {
    return value != nullptr && value->is_number() ? value->get<double>() : otherwise;
}

int64_t integer(const json* value, int64_t otherwise) {
    return value != nullptr && value->is_number_integer() ? value->get<int64_t>() : otherwise;
}

std::optional<Picture> decodeImage(const GltfDocument& document, const json& root,
                                   int64_t texture) {
    const json* entry = element(root, "textures", texture);
    if (entry == nullptr) return std::nullopt;
    const json* image = element(root, "images", integer(find(*entry, {"source"}), -1));
    if (image == nullptr) return std::nullopt;
    const json* view = element(root, "bufferViews", integer(find(*image, {"bufferView"}), -1));
    if (view == nullptr) return std::nullopt;
    const int64_t offset = integer(find(*view, {"byteOffset"}), 0);
    const int64_t length = integer(find(*view, {"byteLength"}), 0);
    const auto size = static_cast<int64_t>(document.bin.size());
    if (offset < 0 || length <= 0 || length > INT32_MAX || offset > size - length)
        return std::nullopt;
    int width = 0;
    int height = 0;
    int channels = 0;
    stbi_uc* pixels = stbi_load_from_memory(document.bin.data() + offset, static_cast<int>(length),
                                            &width, &height, &channels, 3);
    if (pixels == nullptr) return std::nullopt;
    Picture picture{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
    picture.pixels.assign(pixels, pixels + size_t{3} * picture.width * picture.height);
    stbi_image_free(pixels);
    return picture;
}

RenderMaterial readMaterial(const GltfDocument& document, const json& root, int32_t index,
                            SceneRenderer& renderer) {
    RenderMaterial out;
    const json* material = element(root, "materials", index);
    if (material == nullptr) return out;
    const json* surface = find(*material, {"pbrMetallicRoughness"});
    if (surface == nullptr) return out;
    out.roughness = static_cast<float>(number(find(*surface, {"roughnessFactor"}), 1));
    out.metallic = static_cast<float>(number(find(*surface, {"metallicFactor"}), 1));
    const json* factor = find(*surface, {"baseColorFactor"});
    if (factor != nullptr && factor->is_array() && factor->size() == 4) {
        for (int c = 0; c < 3; ++c) {
            out.color[c] = static_cast<float>(number(&(*factor)[static_cast<size_t>(c)], 1));
        }
    }
    const std::optional<Picture> image =
        decodeImage(document, root, integer(find(*surface, {"baseColorTexture", "index"}), -1));
    if (image) out.texture = renderer.addTexture(*image);
    return out;
}

std::vector<RenderVertex> gatherVertices(const FractureGeometry& geometry) {
    std::vector<RenderVertex> vertices(geometry.positions.size());
    for (size_t v = 0; v < vertices.size(); ++v) vertices[v].position = geometry.positions[v];
    for (const Attribute& attribute : geometry.attributes) {
        const bool normal = attribute.semantic == "NORMAL" && attribute.components == 3;
        const bool uv = attribute.semantic == "TEXCOORD_0" && attribute.components == 2;
        for (size_t v = 0; v < vertices.size() && (normal || uv); ++v) {
            const float* value = &attribute.values[v * attribute.components];
            if (normal) vertices[v].normal = {value[0], value[1], value[2]};
            if (uv) vertices[v].uv = {value[0], value[1]};
        }
    }
    return vertices;
}

}  // namespace

std::vector<uint32_t> addMaterials(const GltfDocument& document, std::span<const int32_t> indices,
                                   float diagonal, SceneRenderer& renderer) {
    const json root = json::parse(document.json, nullptr, false);
    std::vector<uint32_t> materials;
    for (const int32_t index : indices) {
        RenderMaterial material = readMaterial(document, root, index, renderer);
        if (material.texture < 0) material.grain = 45 / diagonal;
        materials.push_back(renderer.addMaterial(material));
    }
    return materials;
}

ModelView::ModelView(std::shared_ptr<const Asset> asset, const GltfDocument& document,
                     SceneRenderer& renderer)
    : asset_(std::move(asset)) {
    mesh_ = renderer.addMesh(gatherVertices(asset_->geometry()), asset_->geometry().indices);
    materials_ = addMaterials(document, asset_->set().materials, asset_->diagonal(), renderer);
}

void ModelView::append(const FragmentPose& pose, std::vector<DrawItem>& items) const {
    const glm::mat4 model = glm::scale(toMatrix(pose.pose), glm::vec3(pose.scale));
    for (const DrawRange& range : asset_->drawRanges(pose.fragment)) {
        items.push_back(
            {mesh_, materials_[range.material], range.indices.first, range.indices.count, model});
    }
}

glm::mat4 toMatrix(const RigidPose& pose) {
    return glm::translate(glm::mat4(1.0F), pose.translation) * glm::mat4_cast(pose.rotation);
}

}  // namespace sherd::samples
