// SPDX-License-Identifier: MIT
#include "import/obj_document.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

namespace sherd {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;

class DocumentMaker {
  public:
    DocumentMaker(const SurfaceMesh& mesh, const std::vector<ObjMaterial>& materials)
        : mesh_(mesh), materials_(materials) {}

    GltfDocument make() {
        json_["asset"] = {{"version", "2.0"}, {"generator", "Sherd"}};
        json_["scene"] = 0;
        json_["scenes"] = OrderedJson::array({{{"nodes", {0}}}});
        json_["nodes"] = OrderedJson::array({{{"name", mesh_.name}, {"mesh", 0}}});
        json_["meshes"] =
            OrderedJson::array({{{"name", mesh_.name}, {"primitives", primitives()}}});
        if (!materials_.empty()) addMaterials();
        json_["accessors"] = accessors_;
        json_["bufferViews"] = views_;
        json_["buffers"] = OrderedJson::array({{{"byteLength", bin_.size()}}});
        return {json_.dump(-1, ' ', false, OrderedJson::error_handler_t::replace), std::move(bin_)};
    }

  private:
    size_t addView(const void* data, size_t size, int target) {
        bin_.resize((bin_.size() + 3) / 4 * 4, 0);
        OrderedJson view = {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", size}};
        if (target != 0) view["target"] = target;
        views_.push_back(std::move(view));
        const auto* bytes = static_cast<const uint8_t*>(data);
        bin_.insert(bin_.end(), bytes, bytes + size);
        return views_.size() - 1;
    }

    size_t addAttribute(const std::vector<float>& values, uint32_t components) {
        static const char* const kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        const size_t view = addView(values.data(), values.size() * sizeof(float), kArrayBuffer);
        accessors_.push_back({{"bufferView", view},
                              {"componentType", kFloat},
                              {"count", values.size() / components},
                              {"type", kTypes[components]}});
        return accessors_.size() - 1;
    }

    /// Positions per attribute vertex: the inverse of welding.
    size_t addPositions(size_t vertexCount) {
        std::vector<float> values(vertexCount * 3);
        glm::vec3 low(mesh_.positions.front());
        glm::vec3 high = low;
        for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (size_t k = 0; k < 3; ++k) {
                const glm::vec3& p = mesh_.positions[mesh_.triangles[t][k]];
                std::memcpy(&values[size_t{mesh_.corners[t][k]} * 3], &p.x, sizeof(p));
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
        const size_t accessor = addAttribute(values, 3);
        accessors_[accessor]["min"] = {low.x, low.y, low.z};
        accessors_[accessor]["max"] = {high.x, high.y, high.z};
        return accessor;
    }

    size_t addIndices(uint32_t slot) {
        std::vector<uint32_t> indices;
        for (size_t t = 0; t < mesh_.corners.size(); ++t) {
            if (mesh_.triangleMaterials[t] != slot) continue;
            indices.insert(indices.end(), mesh_.corners[t].begin(), mesh_.corners[t].end());
        }
        const size_t view =
            addView(indices.data(), indices.size() * sizeof(uint32_t), kElementArrayBuffer);
        accessors_.push_back({{"bufferView", view},
                              {"componentType", kUnsignedInt},
                              {"count", indices.size()},
                              {"type", "SCALAR"}});
        return accessors_.size() - 1;
    }

    OrderedJson primitives() {
        const Attribute& first = mesh_.attributes.front();
        OrderedJson attributes;
        attributes["POSITION"] = addPositions(first.values.size() / first.components);
        for (const Attribute& attribute : mesh_.attributes) {
            attributes[attribute.semantic] = addAttribute(attribute.values, attribute.components);
        }
        OrderedJson out = OrderedJson::array();
        for (uint32_t slot = 0; slot < mesh_.materials.size(); ++slot) {
            OrderedJson primitive = {{"attributes", attributes}, {"indices", addIndices(slot)}};
            if (mesh_.materials[slot] >= 0) primitive["material"] = mesh_.materials[slot];
            out.push_back(std::move(primitive));
        }
        return out;
    }

    void addMaterials() {
        OrderedJson materials = OrderedJson::array();
        OrderedJson images = OrderedJson::array();
        OrderedJson textures = OrderedJson::array();
        for (const ObjMaterial& material : materials_) {
            OrderedJson pbr = {{"baseColorFactor", material.baseColor},
                               {"metallicFactor", 0.0},
                               {"roughnessFactor", 0.9}};
            if (!material.image.empty()) {
                pbr["baseColorTexture"] = {{"index", textures.size()}};
                textures.push_back({{"source", images.size()}});
                images.push_back(
                    {{"bufferView", addView(material.image.data(), material.image.size(), 0)},
                     {"mimeType", material.imageType}});
            }
            OrderedJson entry = {{"name", material.name}, {"pbrMetallicRoughness", std::move(pbr)}};
            if (material.baseColor[3] < 1) entry["alphaMode"] = "BLEND";
            materials.push_back(std::move(entry));
        }
        json_["materials"] = std::move(materials);
        if (images.empty()) return;
        json_["textures"] = std::move(textures);
        json_["images"] = std::move(images);
    }

    const SurfaceMesh& mesh_;
    const std::vector<ObjMaterial>& materials_;
    OrderedJson json_;
    OrderedJson accessors_ = OrderedJson::array();
    OrderedJson views_ = OrderedJson::array();
    std::vector<uint8_t> bin_;
};

}  // namespace

GltfDocument makeDocument(const SurfaceMesh& mesh, const std::vector<ObjMaterial>& materials) {
    return DocumentMaker(mesh, materials).make();
}

}  // namespace sherd
