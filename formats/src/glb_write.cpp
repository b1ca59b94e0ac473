// SPDX-License-Identifier: MIT
#include "sherd/formats/glb_write.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "extension_name.h"
#include "extension_tables.h"
#include "gltf_resources.h"
#include "json_text.h"
#include "packing_check.h"
#include "sherd/formats/glb_read.h"
#include "source_hash.h"

namespace sherd {

namespace {

using Json = nlohmann::ordered_json;

size_t sizeOf(const JsonNode* list) {
    return list != nullptr ? list->size() : 0;
}

const JsonNode* extensionOf(const JsonNode* object) {
    return JsonText::find(JsonText::find(object, "extensions"), kExtensionName);
}

/// Removes one member or, when it is the last one, the object that holds it.
void eraseExtension(JsonText& text, const JsonNode& object) {
    const JsonNode* extensions = JsonText::find(&object, "extensions");
    if (JsonText::find(extensions, kExtensionName) == nullptr) return;
    if (extensions->size() == 1)
        text.eraseMember(object, "extensions");
    else
        text.eraseMember(*extensions, kExtensionName);
}

/// What the document held before the extension was attached, as the extension recorded it.
struct Before {
    uint64_t accessors = 0;
    uint64_t bufferViews = 0;
    uint64_t materials = 0;
    uint64_t byteLength = 0;
};

/// Nothing when the record is missing, damaged, or another tool has added something since.
std::optional<Before> readBefore(const JsonText& text, size_t binSize) {
    const JsonNode& root = text.root();
    const JsonNode* extension = extensionOf(&root);
    const auto pick = [&](const char* when, const char* key) {
        return text.number(JsonText::find(JsonText::find(extension, when), key));
    };
    const auto count = [&](const char* key) -> uint64_t {
        return sizeOf(JsonText::find(&root, key));
    };
    Before before;
    struct Entry {
        const char* key;
        uint64_t* value;
        uint64_t now;
    };
    const JsonNode* buffer = JsonText::at(JsonText::find(&root, "buffers"), 0);
    const auto length = text.number(JsonText::find(buffer, "byteLength"));
    for (const Entry& entry : {Entry{"accessors", &before.accessors, count("accessors")},
                               Entry{"bufferViews", &before.bufferViews, count("bufferViews")},
                               Entry{"materials", &before.materials, count("materials")},
                               Entry{"byteLength", &before.byteLength, length.value_or(0)}}) {
        const auto then = pick("before", entry.key);
        const auto after = pick("after", entry.key);
        if (!then || !after || *after != entry.now || *then > entry.now) return std::nullopt;
        *entry.value = *then;
    }
    if (*length > binSize) return std::nullopt;
    return before;
}

/// Whether anything outside the extension uses an index at or above `limit` under a key like
/// "bufferView" or "material". Keeps removal from breaking what other tools have added.
bool refersBeyond(const nlohmann::json& value, const Before& limit) {
    const auto beyond = [&](const std::string& key, const nlohmann::json& v) {
        if (!v.is_number_unsigned()) return false;
        const uint64_t number = v.get<uint64_t>();
        if (key == "bufferView") return number >= limit.bufferViews;
        if (key == "material") return number >= limit.materials;
        if (key == "indices" || key == "input" || key == "output" || key == "inverseBindMatrices")
            return number >= limit.accessors;
        return false;
    };
    if (value.is_array())
        return std::any_of(value.begin(), value.end(),
                           [&](const nlohmann::json& v) { return refersBeyond(v, limit); });
    if (!value.is_object()) return false;
    for (const auto& [key, member] : value.items()) {
        if (key == kExtensionName) continue;
        if (beyond(key, member) || refersBeyond(member, limit)) return true;
        if (key != "attributes" || !member.is_object()) continue;
        for (const auto& accessor : member)
            if (accessor.is_number_unsigned() && accessor.get<uint64_t>() >= limit.accessors)
                return true;
    }
    return false;
}

bool othersRefer(const JsonText& text, const Before& before) {
    auto json = nlohmann::json::parse(text.raw(text.root()));
    // The accessors that are to go refer to the views that are to go.
    auto& accessors = json["accessors"];
    if (accessors.is_array() && accessors.size() > before.accessors)
        accessors.erase(accessors.begin() + static_cast<std::ptrdiff_t>(before.accessors),
                        accessors.end());
    return refersBeyond(json, before);
}

/// glTF allows no empty lists, so those that the extension had opened go as well. Members of one
/// object are erased one at a time: erasures of neighbours would have to share their comma.
std::string eraseMembers(std::string json, const std::vector<const char*>& keys) {
    for (const char* key : keys) {
        auto text = JsonText::parse(std::move(json), "");
        text->eraseMember(text->root(), key);
        json = text->edited();
    }
    return json;
}

void shorten(JsonText& text, const char* key, size_t count, std::vector<const char*>& emptied) {
    const JsonNode* list = JsonText::find(&text.root(), key);
    if (list == nullptr) return;
    if (count == 0)
        emptied.push_back(key);
    else
        text.truncate(*list, count);
}

void unlistExtension(JsonText& text, std::vector<const char*>& emptied) {
    const JsonNode* used = JsonText::find(&text.root(), "extensionsUsed");
    for (size_t i = 0; i < sizeOf(used); ++i) {
        if (text.string(JsonText::at(used, i)) != kExtensionName) continue;
        if (used->size() == 1)
            emptied.push_back("extensionsUsed");
        else
            text.eraseElement(*used, i);
        return;
    }
}

void trimEnd(std::string& text) {
    // A GLB's JSON chunk is padded with spaces; they would pile up with every bake.
    text.erase(text.find_last_not_of(" \t\r\n") + 1);
}

Result<void> checkShape(const FractureSet& set) {
    const FractureGeometry& g = set.geometry;
    const auto wrong = [&](const std::string& what) {
        return fail(ErrorCode::badArgument, "fracture set: " + what, set.name);
    };
    if (set.fragments.empty() || set.levels.empty()) return wrong("there is no fragment");
    if (g.positions.empty() || g.indices.empty() || g.primitives.empty())
        return wrong("there is no geometry");
    if (set.fragmentRanges.size() != set.fragments.size() * g.primitives.size())
        return wrong("fragmentRanges must have one entry per fragment and primitive");
    for (const Attribute& attribute : g.attributes)
        if (attribute.components < 1 || attribute.components > 4 ||
            attribute.values.size() != g.positions.size() * attribute.components)
            return wrong("attribute " + attribute.semantic + " does not fit the vertex count");
    if (set.hulls.empty() != set.hullPoints.empty()) return wrong("hulls without points");
    return {};
}

/// The shortest decimal that reads back as the same float: 0.6, not 0.60000002384185791.
double shortest(float value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    double result = value;
    std::from_chars(text.data(), end.ptr, result);
    return result;
}

Json materialJson(const NewMaterial& material) {
    Json color = Json::array();
    for (const float channel : material.baseColor) color.push_back(shortest(channel));
    Json out;
    if (!material.name.empty()) out["name"] = material.name;
    out["pbrMetallicRoughness"] = {{"baseColorFactor", color},
                                   {"metallicFactor", shortest(material.metallic)},
                                   {"roughnessFactor", shortest(material.roughness)}};
    return out;
}

/// Adds everything to a document that carries no fracture sets.
class Attacher {
  public:
    Attacher(GltfDocument document, JsonText text)
        : document_(std::move(document)), text_(std::move(text)) {}

    Result<GltfDocument> run(std::span<const FractureSet> sets,
                             std::span<const NewMaterial> newMaterials, size_t materialCountGiven,
                             const GeometryPacking& packing) {
        const auto parsed = nlohmann::json::parse(text_.raw(text_.root()));
        const size_t firstMaterial = sizeOf(list("materials"));
        const size_t firstView = sizeOf(list("bufferViews"));
        const size_t firstAccessor = sizeOf(list("accessors"));
        const size_t lengthBefore = ownBytes();
        const size_t sourceSize = document_.bin.size();
        TableWriter tables(document_.bin, firstView, firstAccessor);
        Json fractures = Json::array();
        for (const FractureSet& given : sets) {
            FractureSet set = given;
            if (auto placed = place(set, fractures.size()); !placed)
                return tl::unexpected<Error>(placed.error());
            set.sourceHash = sourceHash(parsed, std::span(document_.bin).first(sourceSize),
                                        meshesOf(parsed, set));
            for (int32_t& material : set.materials)
                if (material >= static_cast<int32_t>(materialCountGiven))
                    material += static_cast<int32_t>(firstMaterial) -
                                static_cast<int32_t>(materialCountGiven);
            auto fracture = fractureJson(set, tables, packing);
            if (!fracture) return tl::unexpected<Error>(fracture.error());
            fractures.push_back(std::move(*fracture));
        }
        document_.bin.resize((document_.bin.size() + 3) / 4 * 4);
        std::vector<std::string> materials;
        for (const NewMaterial& material : newMaterials)
            materials.push_back(dump(materialJson(material)));
        Json root = {{"version", kExtensionVersion}, {"generator", "Sherd"}};
        root["before"] = {{"accessors", firstAccessor},
                          {"bufferViews", firstView},
                          {"materials", firstMaterial},
                          {"byteLength", lengthBefore}};
        root["after"] = {{"accessors", firstAccessor + tables.accessors().size()},
                         {"bufferViews", firstView + tables.views().size()},
                         {"materials", firstMaterial + materials.size()},
                         {"byteLength", document_.bin.size()}};
        root["fractures"] = std::move(fractures);
        extend("bufferViews", tables.views());
        extend("accessors", tables.accessors());
        extend("materials", materials);
        extend("extensionsUsed", {jsonQuoted(kExtensionName)});
        extendExtensions(text_.root(), dump(root));
        setLength();
        document_.json = text_.edited();
        trimEnd(document_.json);
        return std::move(document_);
    }

  private:
    const JsonNode* list(const char* key) const { return JsonText::find(&text_.root(), key); }

    static std::string dump(const Json& json) {
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    size_t ownBytes() const {
        const JsonNode* buffer = JsonText::at(list("buffers"), 0);
        return text_.number(JsonText::find(buffer, "byteLength")).value_or(0);
    }

    /// Takes a node with a mesh for one set; its mesh.
    Result<uint64_t> use(int32_t node) {
        const std::string where = "/nodes/" + std::to_string(node);
        const auto mesh = text_.number(JsonText::find(nodeAt(node), "mesh"));
        if (!mesh || *mesh >= sizeOf(list("meshes")))
            return fail(ErrorCode::badArgument, "a fracture set needs a node with a mesh", where);
        if (!usedNodes_.insert(node).second)
            return fail(ErrorCode::badArgument, "a node can be part of one fracture set only",
                        where);
        return *mesh;
    }

    const JsonNode* nodeAt(int32_t node) const {
        return node < 0 ? nullptr : JsonText::at(list("nodes"), static_cast<size_t>(node));
    }

    /// Hangs the set on its nodes and finds its mesh.
    Result<void> place(FractureSet& set, size_t index) {
        if (auto shape = checkShape(set); !shape) return shape;
        const auto mesh = use(set.node);
        if (!mesh) return tl::unexpected<Error>(mesh.error());
        set.mesh = static_cast<int32_t>(*mesh);
        const std::string carried = "{\"fracture\":" + std::to_string(index) + "}";
        extendExtensions(*nodeAt(set.node), carried);
        for (const int32_t node : set.sameNodes) {
            const auto same = use(node);
            if (!same) return tl::unexpected<Error>(same.error());
            // Readers take the lowest node that carries a set for the one whose pose it gives.
            if (*same != *mesh || node < set.node || !set.joinedNodes.empty())
                return fail(ErrorCode::badArgument,
                            "further nodes of a fracture set show the same mesh, lie behind the "
                            "first and stand for objects of one node",
                            "/nodes/" + std::to_string(node));
            extendExtensions(*nodeAt(node), carried);
        }
        for (const int32_t node : set.joinedNodes)
            if (const auto joined = use(node); !joined)
                return tl::unexpected<Error>(joined.error());
        return {};
    }

    void extendExtensions(const JsonNode& object, const std::string& value) {
        const JsonNode* extensions = JsonText::find(&object, "extensions");
        if (extensions != nullptr && extensions->isObject())
            return text_.setMember(*extensions, kExtensionName, value);
        text_.setMember(object, "extensions", "{" + jsonQuoted(kExtensionName) + ":" + value + "}");
    }

    void extend(const char* key, const std::vector<std::string>& elements) {
        if (elements.empty()) return;
        if (const JsonNode* old = list(key); old != nullptr && old->isArray())
            return text_.append(*old, elements);
        text_.setMember(text_.root(), key, jsonArray(elements));
    }

    void setLength() {
        const std::string length = std::to_string(document_.bin.size());
        if (const JsonNode* buffer = JsonText::at(list("buffers"), 0))
            return text_.setMember(*buffer, "byteLength", length);
        text_.setMember(text_.root(), "buffers", "[{\"byteLength\":" + length + "}]");
    }

    GltfDocument document_;
    JsonText text_;
    std::set<int32_t> usedNodes_;
};

/// `wantedMaterial`: the highest material of the document that new sets still use, or -1.
Result<GltfDocument> strip(const GltfDocument& document, int32_t wantedMaterial) {
    auto text = JsonText::parse(document.json, "");
    if (!text) return tl::unexpected<Error>(text.error());
    if (extensionOf(&text->root()) == nullptr) return document;
    GltfDocument out = document;
    std::vector<const char*> emptied;
    const JsonNode& root = text->root();
    auto before = readBefore(*text, document.bin.size());
    if (before && wantedMaterial >= static_cast<int32_t>(before->materials)) before.reset();
    if (before && !othersRefer(*text, *before)) {
        shorten(*text, "accessors", before->accessors, emptied);
        shorten(*text, "bufferViews", before->bufferViews, emptied);
        shorten(*text, "materials", before->materials, emptied);
        if (before->byteLength == 0)
            emptied.push_back("buffers");
        else
            text->setMember(*JsonText::at(JsonText::find(&root, "buffers"), 0), "byteLength",
                            std::to_string(before->byteLength));
        out.bin.resize((before->byteLength + 3) / 4 * 4);
    }
    unlistExtension(*text, emptied);
    if (const JsonNode* nodes = JsonText::find(&root, "nodes"))
        for (const JsonMember& node : nodes->members) eraseExtension(*text, node.value);
    if (JsonText::find(&root, "extensions")->size() == 1)
        emptied.push_back("extensions");
    else
        eraseExtension(*text, root);
    out.json = eraseMembers(text->edited(), emptied);
    trimEnd(out.json);
    return out;
}

}  // namespace

Result<GltfDocument> withoutFractureSets(const GltfDocument& document) {
    return strip(document, -1);
}

Result<std::vector<uint8_t>> attachFractureSets(const GltfDocument& document,
                                                std::span<const FractureSet> sets,
                                                std::span<const NewMaterial> newMaterials,
                                                const GeometryPacking& packing) {
    const auto given = JsonText::parse(document.json, "");
    if (!given) return tl::unexpected<Error>(given.error());
    const size_t materialCount = sizeOf(JsonText::find(&given->root(), "materials"));
    int32_t wantedMaterial = -1;
    for (const FractureSet& set : sets)
        for (const int32_t material : set.materials) {
            if (material >= static_cast<int32_t>(materialCount + newMaterials.size()))
                return fail(ErrorCode::badArgument,
                            "material " + std::to_string(material) + " does not exist", set.name);
            if (material < static_cast<int32_t>(materialCount))
                wantedMaterial = std::max(wantedMaterial, material);
        }
    auto source = strip(document, wantedMaterial);
    if (!source) return tl::unexpected<Error>(source.error());
    if (sets.empty()) return toGlb(*source);
    auto text = JsonText::parse(source->json, "");
    if (!text) return tl::unexpected<Error>(text.error());
    auto out = Attacher(std::move(*source), std::move(*text))
                   .run(sets, newMaterials, materialCount, packing);
    if (!out) return tl::unexpected<Error>(out.error());
    if (out->bin.size() + out->json.size() > std::numeric_limits<uint32_t>::max() - 64U)
        return fail(ErrorCode::limitExceeded,
                    "the file would exceed the 4 GiB that a GLB can hold");
    std::vector<uint8_t> glb = toGlb(*out);
    // Nothing leaves this function that the reader would refuse.
    auto readBack = readFractureSets(glb);
    if (!readBack)
        return fail(ErrorCode::invalidData,
                    "the fracture set is not valid: " + readBack.error().message,
                    readBack.error().where);
    for (size_t i = 0; packing.encoding != GeometryPacking::Encoding::none && i < sets.size(); ++i)
        if (auto closed = checkPacked(sets[i], (*readBack)[i]); !closed)
            return tl::unexpected<Error>(closed.error());
    return glb;
}

}  // namespace sherd
