// SPDX-License-Identifier: MIT
#include "glb_file.h"

#include <array>
#include <cstring>
#include <glm/common.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

namespace sherd::samples {
namespace {

using nlohmann::json;

struct Vertices {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<uint32_t> indices;
};

/// Corners that agree in everything become one vertex.
Vertices gatherVertices(const Mesh& mesh) {
    Vertices out;
    std::map<std::array<float, 6>, uint32_t> known;
    for (const Triangle& triangle : mesh.triangles) {
        for (const Corner& corner : triangle) {
            const std::array<float, 6> key{
                float(corner.position), corner.uv.x,     corner.uv.y,
                corner.normal.x,        corner.normal.y, corner.normal.z};
            const auto [found, added] =
                known.emplace(key, static_cast<uint32_t>(out.positions.size()));
            if (added) {
                out.positions.push_back(mesh.positions[corner.position]);
                out.normals.push_back(corner.normal);
                out.uvs.push_back(corner.uv);
            }
            out.indices.push_back(found->second);
        }
    }
    return out;
}

/// Buffer 0 and the views into it, each aligned to four bytes.
class Buffer {
  public:
    uint32_t addView(const void* data, size_t bytes, int target) {
        bin.resize((bin.size() + 3) / 4 * 4);
        json view{{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes}};
        if (target != 0) view["target"] = target;
        const auto* begin = static_cast<const uint8_t*>(data);
        bin.insert(bin.end(), begin, begin + bytes);
        views.push_back(view);
        return static_cast<uint32_t>(views.size() - 1);
    }

    std::vector<uint8_t> bin;
    json views = json::array();
};

constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;

json accessor(uint32_t view, int type, size_t count, const char* shape) {
    return {{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", shape}};
}

json makeAccessors(const Vertices& v, Buffer& buffer) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (const glm::vec3& p : v.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const size_t n = v.positions.size();
    json position = accessor(
        buffer.addView(v.positions.data(), n * sizeof(glm::vec3), kArrayBuffer), kFloat, n, "VEC3");
    position["min"] = {low.x, low.y, low.z};
    position["max"] = {high.x, high.y, high.z};
    json accessors = json::array();
    accessors.push_back(position);
    accessors.push_back(accessor(
        buffer.addView(v.normals.data(), n * sizeof(glm::vec3), kArrayBuffer), kFloat, n, "VEC3"));
    accessors.push_back(accessor(buffer.addView(v.uvs.data(), n * sizeof(glm::vec2), kArrayBuffer),
                                 kFloat, n, "VEC2"));
    accessors.push_back(accessor(
        buffer.addView(v.indices.data(), v.indices.size() * sizeof(uint32_t), kElementArrayBuffer),
        kUnsignedInt, v.indices.size(), "SCALAR"));
    return accessors;
}

/// The painted skin, and what is seen where the object is broken: the recipe names the second.
json makeMaterials(const SampleObject& object) {
    const json skin{{"name", object.name},
                    {"pbrMetallicRoughness",
                     {{"baseColorTexture", {{"index", 0}}},
                      {"metallicFactor", 0.0},
                      {"roughnessFactor", object.roughness}}}};
    const glm::dvec3& color = object.stuff.color;
    const json inside{{"name", insideMaterialName(object)},
                      {"pbrMetallicRoughness",
                       {{"baseColorFactor", {color.x, color.y, color.z, 1.0}},
                        {"metallicFactor", 0.0},
                        {"roughnessFactor", 0.95}}}};
    return json::array({skin, inside});
}

}  // namespace

std::string insideMaterialName(const SampleObject& object) {
    return std::string(object.name).append(" inside");
}

std::string toRecipe(const SampleObject& object) {
    json recipe;
    for (const int level : {1, 2}) {
        const std::string map =
            std::string(object.name).append("_level").append(std::to_string(level)).append(".svg");
        recipe["levels"].push_back({{"map", map}});
    }
    recipe["interior"] = {{"material", insideMaterialName(object)}};
    recipe["physics"] = {{"density", object.stuff.density}};
    return recipe.dump(2).append("\n");
}

GltfDocument toGltf(const SampleObject& object) {
    Buffer buffer;
    json document;
    document["asset"] = {{"version", "2.0"}, {"generator", "sherd-sample-assets"}};
    document["scene"] = 0;
    document["scenes"] = json::array({{{"nodes", {0}}}});
    document["nodes"] = json::array({{{"name", object.name}, {"mesh", 0}}});
    document["accessors"] = makeAccessors(gatherVertices(object.mesh), buffer);
    const json primitive{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}},
                         {"indices", 3},
                         {"material", 0}};
    document["meshes"] =
        json::array({{{"name", object.name}, {"primitives", json::array({primitive})}}});
    document["materials"] = makeMaterials(object);
    const std::vector<uint8_t> png = encodePng(object.texture);
    document["images"] = json::array({{{"name", object.name},
                                       {"mimeType", "image/png"},
                                       {"bufferView", buffer.addView(png.data(), png.size(), 0)}}});
    // Wrapping would mix opposite rims of the atlas; charts keep clear of both.
    document["samplers"] = json::array(
        {{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33071}}});
    document["textures"] = json::array({{{"source", 0}, {"sampler", 0}}});
    document["bufferViews"] = buffer.views;
    document["buffers"] = json::array({{{"byteLength", buffer.bin.size()}}});
    return {document.dump(), std::move(buffer.bin)};
}

}  // namespace sherd::samples
