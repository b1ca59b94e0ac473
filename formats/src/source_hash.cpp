// SPDX-License-Identifier: MIT
// FNV-1a, 64 bit (Fowler, Noll, Vo 1991): no defence against forgery, none is needed.
#include "source_hash.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace sherd {

namespace {

using nlohmann::json;

const json& member(const json& object, const char* key) {
    static const json kNull;
    if (!object.is_object()) return kNull;
    const auto found = object.find(key);
    return found == object.end() ? kNull : *found;
}

const json& element(const json& document, const char* list, const json& index) {
    static const json kNull;
    const json& all = member(document, list);
    if (!all.is_array() || !index.is_number_unsigned()) return kNull;
    const uint64_t i = index.get<uint64_t>();
    return i < all.size() ? all[i] : kNull;
}

uint64_t whole(const json& value, uint64_t otherwise = 0) {
    return value.is_number_unsigned() ? value.get<uint64_t>() : otherwise;
}

class Hasher {
  public:
    Hasher(const json& document, std::span<const uint8_t> bin) : document_(document), bin_(bin) {}

    void primitive(const json& value) {
        mix(whole(member(value, "mode"), 4));
        const json& attributes = member(value, "attributes");
        if (attributes.is_object()) {  // in the order of their names
            for (const auto& [name, index] : attributes.items())
                accessor(element(document_, "accessors", index));
        }
        accessor(element(document_, "accessors", member(value, "indices")));
        const json& draco = member(member(value, "extensions"), "KHR_draco_mesh_compression");
        wholeView(element(document_, "bufferViews", member(draco, "bufferView")));
    }

    uint64_t value() const { return hash_; }

  private:
    void mix(uint64_t number) {
        std::array<uint8_t, 8> bytes{};
        for (int i = 0; i < 8; ++i) bytes[i] = static_cast<uint8_t>(number >> 8 * i);
        mix(bytes);
    }

    void mix(std::span<const uint8_t> bytes) {
        for (const uint8_t byte : bytes) hash_ = (hash_ ^ byte) * 0x100000001B3ULL;
    }

    /// The part of the buffer that exists; nothing for placeholders without bytes.
    std::span<const uint8_t> bytesOf(const json& view) const {
        if (whole(member(view, "buffer"), 1) != 0) return {};
        const uint64_t offset = std::min<uint64_t>(whole(member(view, "byteOffset")), bin_.size());
        return bin_.subspan(offset,
                            std::min(whole(member(view, "byteLength")), bin_.size() - offset));
    }

    void wholeView(const json& view) {
        mix(bytesOf(view));
        for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
            mix(bytesOf(member(member(view, "extensions"), name)));
    }

    static uint64_t elementSize(const json& accessor) {
        const uint64_t component = whole(member(accessor, "componentType"));
        const uint64_t bytes = component >= 5125 ? 4 : component >= 5122 ? 2 : 1;
        const json& type = member(accessor, "type");
        if (type == "VEC2") return 2 * bytes;
        if (type == "VEC3") return 3 * bytes;
        return type == "VEC4" ? 4 * bytes : bytes;
    }

    void accessor(const json& value) {
        const uint64_t count = whole(member(value, "count"));
        mix(count);
        mix(whole(member(value, "componentType")));
        const json& view = element(document_, "bufferViews", member(value, "bufferView"));
        const json& sparse = member(value, "sparse");
        for (const char* part : {"indices", "values"})
            wholeView(
                element(document_, "bufferViews", member(member(sparse, part), "bufferView")));
        if (!member(view, "extensions").is_null()) return wholeView(view);
        const std::span<const uint8_t> bytes = bytesOf(view);
        const uint64_t size = elementSize(value);
        const uint64_t stride = std::max<uint64_t>(whole(member(view, "byteStride"), size), 1);
        uint64_t at = whole(member(value, "byteOffset"));
        for (uint64_t i = 0; i < count && at <= bytes.size() && size <= bytes.size() - at; ++i) {
            mix(bytes.subspan(at, size));
            if (stride > bytes.size()) break;
            at += stride;
        }
    }

    const json& document_;
    std::span<const uint8_t> bin_;
    uint64_t hash_ = 0xCBF29CE484222325ULL;
};

}  // namespace

std::vector<size_t> meshesOf(const json& document, const FractureSet& set) {
    std::vector<size_t> meshes{static_cast<size_t>(set.mesh)};
    for (const int32_t node : set.joinedNodes) {
        const json& shown =
            member(element(document, "nodes", json(static_cast<uint64_t>(node))), "mesh");
        meshes.push_back(static_cast<size_t>(whole(shown, UINT32_MAX)));
    }
    return meshes;
}

std::string sourceHash(const json& document, std::span<const uint8_t> bin,
                       std::span<const size_t> meshes) {
    Hasher hasher(document, bin);
    for (const size_t mesh : meshes) {
        const json& primitives =
            member(element(document, "meshes", json(uint64_t{mesh})), "primitives");
        if (!primitives.is_array()) continue;
        for (const json& primitive : primitives) hasher.primitive(primitive);
    }
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx",
                  static_cast<unsigned long long>(hasher.value()));
    return text.data();
}

}  // namespace sherd
