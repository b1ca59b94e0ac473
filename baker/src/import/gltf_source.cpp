// SPDX-License-Identifier: MIT
// tinygltf 2.7 crashes on hostile documents (image views out of range, empty buffers), wraps
// integers beyond 31 bits, and drops primitives it dislikes, which shifts the indices of the
// others. So it is given a copy reduced to what importing needs, with every number checked before,
// and neither images nor buffer bytes: accessors are read from the document itself
// (gltf_accessor.h).
#include "import/gltf_source.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace sherd {
namespace {

using Json = nlohmann::json;

/// Extensions that touch only materials, textures, lights and metadata, and quantized vertex data,
/// which the accessor reader handles as a matter of course.
bool isHarmless(std::string_view extension) {
    constexpr std::array<std::string_view, 7> kPrefixes = {
        "KHR_materials_", "KHR_texture_",  "KHR_lights_", "KHR_xmp",
        "EXT_texture_",   "MSFT_texture_", "EXT_lights_"};
    if (extension == "KHR_mesh_quantization") return true;
    for (const std::string_view prefix : kPrefixes) {
        if (extension.substr(0, prefix.size()) == prefix) return true;
    }
    return false;
}

class Reducer {
  public:
    Reducer(const Json& full, std::string name) : full_(full), name_(std::move(name)) {}

    Result<Json> reduce() {
        if (auto ok = checkRequired(); !ok) return tl::unexpected(ok.error());
        Json out = {{"asset", {{"version", "2.0"}}}};
        if (full_.contains("scene")) out["scene"] = full_["scene"];
        for (const char* key : {"bufferViews", "accessors", "meshes", "nodes", "scenes"}) {
            if (!full_.contains(key)) continue;
            auto section = reduceSection(key);
            if (!section) return tl::unexpected(section.error());
            out[key] = std::move(*section);
        }
        if (auto ok = checkIntegers(out, ""); !ok) return tl::unexpected(ok.error());
        if (auto ok = checkTransforms(); !ok) return tl::unexpected(ok.error());
        addTransforms(out);
        return out;
    }

  private:
    tl::unexpected<Error> bad(const std::string& message, const std::string& pointer) const {
        return fail(ErrorCode::invalidData, message, name_ + "#" + pointer);
    }

    Result<void> checkRequired() const {
        if (!full_.contains("extensionsRequired")) return {};
        const Json& required = full_["extensionsRequired"];
        if (!required.is_array()) {
            return bad("extensionsRequired must be an array", "/extensionsRequired");
        }
        for (size_t i = 0; i < required.size(); ++i) {
            const std::string pointer = "/extensionsRequired/" + std::to_string(i);
            if (!required[i].is_string()) return bad("expected a string", pointer);
            const auto extension = required[i].get<std::string>();
            if (isHarmless(extension)) continue;
            return fail(ErrorCode::unsupportedExtension,
                        "the file requires the extension " + extension +
                            ", which Sherd cannot read; export the model without it "
                            "(compression is Sherd's own last step)",
                        name_ + "#" + pointer);
        }
        return {};
    }

    /// One top-level array with only the members the importer reads.
    Result<Json> reduceSection(const std::string& key) const {
        static const std::array<std::string_view, 16> kKept = {
            "buffer",     "byteOffset", "byteLength", "byteStride", "bufferView", "componentType",
            "normalized", "count",      "type",       "sparse",     "primitives", "nodes",
            "mesh",       "skin",       "children",   "name"};
        const Json& section = full_[key];
        if (!section.is_array()) return bad("expected an array", "/" + key);
        Json out = Json::array();
        for (size_t i = 0; i < section.size(); ++i) {
            const std::string pointer = "/" + key + "/" + std::to_string(i);
            const Json& item = section[i];
            if (!item.is_object()) return bad("expected an object", pointer);
            Json kept = Json::object();
            for (const std::string_view member : kKept) {
                const auto it = item.find(std::string(member));
                if (it != item.end()) kept[std::string(member)] = *it;
            }
            if (key == "meshes") {
                auto primitives = reducePrimitives(item, pointer);
                if (!primitives) return primitives;
                kept["primitives"] = std::move(*primitives);
            } else if (key == "bufferViews") {
                if (auto ok = checkView(item, pointer); !ok) return tl::unexpected(ok.error());
            }
            out.push_back(std::move(kept));
        }
        return out;
    }

    Result<void> checkView(const Json& view, const std::string& pointer) const {
        if (view.contains("buffer") && view["buffer"] == 0) return {};
        const auto extensions = view.find("extensions");
        if (extensions != view.end() && extensions->is_object() &&
            extensions->contains("EXT_meshopt_compression")) {
            return fail(ErrorCode::unsupportedExtension,
                        "the data exists only compressed with EXT_meshopt_compression; export the "
                        "model uncompressed",
                        name_ + "#" + pointer);
        }
        return bad("the bufferView refers to a buffer that does not exist", pointer + "/buffer");
    }

    Result<Json> reducePrimitives(const Json& mesh, const std::string& meshPointer) const {
        Json out = Json::array();
        const auto primitives = mesh.find("primitives");
        if (primitives == mesh.end() || !primitives->is_array()) {
            return bad("the mesh has no primitives", meshPointer);
        }
        for (size_t i = 0; i < primitives->size(); ++i) {
            const std::string pointer = meshPointer + "/primitives/" + std::to_string(i);
            const Json& item = (*primitives)[i];
            if (!item.is_object() || !item.contains("attributes") ||
                !item["attributes"].is_object()) {
                return bad("a primitive needs an object of attributes", pointer);
            }
            if (auto ok = checkDraco(item, pointer); !ok) return tl::unexpected(ok.error());
            Json kept = Json::object();
            for (const char* member : {"attributes", "indices", "material", "mode"}) {
                if (item.contains(member)) kept[member] = item[member];
            }
            // Their presence is all the importer asks.
            const auto targets = item.find("targets");
            if (targets != item.end() && targets->is_array() && !targets->empty()) {
                kept["targets"] = Json::array({Json::object()});
            }
            out.push_back(std::move(kept));
        }
        return out;
    }

    Result<void> checkDraco(const Json& primitive, const std::string& pointer) const {
        const auto extensions = primitive.find("extensions");
        if (extensions == primitive.end() || !extensions->is_object() ||
            !extensions->contains("KHR_draco_mesh_compression")) {
            return {};
        }
        const Json& attributes = primitive["attributes"];
        if (attributes.contains("POSITION") && attributes["POSITION"].is_number_unsigned() &&
            full_.contains("accessors") && full_["accessors"].is_array()) {
            const auto index = attributes["POSITION"].get<size_t>();
            const Json& accessors = full_["accessors"];
            if (index < accessors.size() && accessors[index].is_object() &&
                accessors[index].contains("bufferView")) {
                return {};
            }
        }
        return fail(ErrorCode::unsupportedExtension,
                    "the primitive exists only compressed with KHR_draco_mesh_compression; export "
                    "the model uncompressed",
                    name_ + "#" + pointer);
    }

    /// tinygltf reads most numbers as int: what does not fit would wrap to something plausible.
    Result<void> checkIntegers(const Json& value, const std::string& pointer) const {
        if (value.is_number()) {
            const bool isSize = pointer.ends_with("/count") || pointer.ends_with("/byteOffset") ||
                                pointer.ends_with("/byteLength");
            const uint64_t limit = isSize ? UINT32_MAX : INT32_MAX;
            if (!value.is_number_unsigned() || value.get<uint64_t>() > limit) {
                return bad("expected an integer from 0 to " + std::to_string(limit), pointer);
            }
        } else if (value.is_structured()) {
            for (auto it = value.begin(); it != value.end(); ++it) {
                std::string inner = pointer;
                inner += '/';
                inner += value.is_array() ? std::to_string(it - value.begin()) : it.key();
                auto ok = checkIntegers(*it, inner);
                if (!ok) return ok;
            }
        }
        return {};
    }

    static constexpr std::array<std::pair<const char*, size_t>, 4> kTransforms = {
        {{"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}};

    Result<void> checkTransforms() const {
        if (!full_.contains("nodes")) return {};
        const Json& nodes = full_["nodes"];
        for (size_t i = 0; i < nodes.size(); ++i) {
            for (const auto& [key, size] : kTransforms) {
                if (!nodes[i].contains(key)) continue;
                const std::string pointer = "/nodes/" + std::to_string(i) + "/" + key;
                const Json& values = nodes[i][key];
                if (!values.is_array() || values.size() != size) {
                    return bad("expected " + std::to_string(size) + " numbers", pointer);
                }
                for (const Json& value : values) {
                    if (!value.is_number() || !std::isfinite(value.get<double>())) {
                        return bad("expected finite numbers", pointer);
                    }
                }
            }
        }
        return {};
    }

    void addTransforms(Json& out) const {
        if (!full_.contains("nodes")) return;
        for (size_t i = 0; i < full_["nodes"].size(); ++i) {
            for (const auto& [key, size] : kTransforms) {
                if (full_["nodes"][i].contains(key)) out["nodes"][i][key] = full_["nodes"][i][key];
            }
        }
    }

    const Json& full_;
    std::string name_;
};

}  // namespace

Result<GltfSource> parseGltfSource(const GltfDocument& document, const std::string& name) {
    const Json full = Json::parse(document.json, nullptr, false);
    if (full.is_discarded() || !full.is_object()) {
        return fail(ErrorCode::malformed, "the glTF document is not a JSON object", name);
    }
    auto reduced = Reducer(full, name).reduce();
    if (!reduced) return tl::unexpected(reduced.error());

    GltfSource source;
    source.document = &document;
    source.name = name;
    if (full.contains("materials")) source.materialCount = full["materials"].size();
    source.pictures = readMaterialPictures(full);
    std::string error;
    std::string warning;
    try {
        const std::string text =
            reduced->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        tinygltf::TinyGLTF loader;
        if (!loader.LoadASCIIFromString(&source.model, &error, &warning, text.c_str(),
                                        static_cast<unsigned int>(text.size()), "",
                                        tinygltf::NO_REQUIRE)) {
            return fail(ErrorCode::malformed, "tinygltf cannot read the document: " + error, name);
        }
    } catch (const std::exception& exception) {
        return fail(ErrorCode::malformed,
                    std::string("tinygltf cannot read the document: ") + exception.what(), name);
    }
    return source;
}

}  // namespace sherd
