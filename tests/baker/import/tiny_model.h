// SPDX-License-Identifier: MIT
// Tiny glTF documents built in memory. Start from a sound one, then break one thing.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sherd/formats/gltf_document.h"

namespace sherd::test {

using Json = nlohmann::json;

struct TinyModel {
    Json json = {{"asset", {{"version", "2.0"}}},
                 {"scene", 0},
                 {"scenes", Json::array({{{"nodes", {0}}}})},
                 {"nodes", Json::array({{{"mesh", 0}, {"name", "thing"}}})},
                 {"meshes", Json::array({{{"primitives", Json::array()}}})},
                 {"accessors", Json::array()},
                 {"bufferViews", Json::array()}};
    std::vector<uint8_t> bin;

    template <class T>
    int view(const std::vector<T>& values) {
        bin.resize((bin.size() + 3) / 4 * 4);
        const size_t size = values.size() * sizeof(T);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", size}});
        const size_t at = bin.size();
        bin.resize(at + size);
        if (size > 0) std::memcpy(bin.data() + at, values.data(), size);
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }

    template <class T>
    int accessor(const std::vector<T>& values, const std::string& type, int components,
                 int componentType) {
        const int made = view(values);
        json["accessors"].push_back({{"bufferView", made},
                                     {"componentType", componentType},
                                     {"count", values.size() / static_cast<size_t>(components)},
                                     {"type", type}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    int vec3(const std::vector<float>& values) { return accessor(values, "VEC3", 3, 5126); }
    int vec2(const std::vector<float>& values) { return accessor(values, "VEC2", 2, 5126); }
    int vec4(const std::vector<float>& values) { return accessor(values, "VEC4", 4, 5126); }
    int indices(const std::vector<uint16_t>& values) { return accessor(values, "SCALAR", 1, 5123); }

    Json& primitive(const Json& attributes, int indexAccessor = -1) {
        Json made = {{"attributes", attributes}};
        if (indexAccessor >= 0) made["indices"] = indexAccessor;
        json["meshes"][0]["primitives"].push_back(made);
        return json["meshes"][0]["primitives"].back();
    }

    GltfDocument document() const {
        Json whole = json;
        whole["buffers"] = Json::array({{{"byteLength", bin.size()}}});
        return {whole.dump(), bin};
    }
};

/// A closed tetrahedron of four vertices with texture coordinates: accessors 0 (POSITION),
/// 1 (TEXCOORD_0), 2 (indices).
inline TinyModel tetrahedron() {
    TinyModel model;
    const int position = model.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    const int uv = model.vec2({0, 0, 1, 0, 0, 1, 1, 1});
    const int index = model.indices({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
    model.primitive({{"POSITION", position}, {"TEXCOORD_0", uv}}, index);
    return model;
}

}  // namespace sherd::test
