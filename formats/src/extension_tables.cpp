// SPDX-License-Identifier: MIT
// The layout of formats/spec/SHERD_mesh_fracture, writing side; glb_read.cpp mirrors it.
#include "extension_tables.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

#include "extension_name.h"
#include "quantized_stream.h"

namespace sherd {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 5> kTypes = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};

/// One number or vector per item, gathered from an array of structs.
template <class Items, class Get>
std::vector<float> gather(const Items& items, Get get) {
    std::vector<float> out;
    for (const auto& item : items)
        for (const float value : get(item)) out.push_back(value);
    return out;
}

template <class Items, class Get>
std::vector<uint32_t> gatherIntegers(const Items& items, Get get) {
    std::vector<uint32_t> out;
    for (const auto& item : items)
        for (const uint32_t value : get(item)) out.push_back(value);
    return out;
}

using F1 = std::array<float, 1>;
using F3 = std::array<float, 3>;
using F4 = std::array<float, 4>;
using U1 = std::array<uint32_t, 1>;
using U2 = std::array<uint32_t, 2>;

F3 three(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}
F4 four(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}
U2 two(const Range& r) {
    return {r.first, r.count};
}

Json fragmentsJson(const FractureSet& set, TableWriter& tables) {
    const std::vector<Fragment>& all = set.fragments;
    Json out = {{"count", all.size()}};
    const auto words = [&](const char* key, std::string Fragment::*word) {
        const bool any = std::any_of(all.begin(), all.end(),
                                     [&](const Fragment& f) { return !(f.*word).empty(); });
        if (!any) return;
        for (const Fragment& f : all) out[key].push_back(f.*word);
    };
    words("names", &Fragment::name);
    words("materials", &Fragment::material);
    Json& to = out["attributes"];
    const auto integers = [&](const char* name, uint32_t components, auto get) {
        to[name] = tables.integers(gatherIntegers(all, get), components);
    };
    const auto floats = [&](const char* name, uint32_t components, auto get) {
        to[name] = tables.floats(gather(all, get), components);
    };
    integers("PARENT", 1, [](const Fragment& f) { return U1{static_cast<uint32_t>(f.parent)}; });
    integers("CHILDREN", 2, [](const Fragment& f) { return two(f.children); });
    floats("MASS", 1, [](const Fragment& f) { return F1{f.mass}; });
    floats("VOLUME", 1, [](const Fragment& f) { return F1{f.volume}; });
    floats("CENTER_OF_MASS", 3, [](const Fragment& f) { return three(f.centerOfMass); });
    floats("INERTIA_DIAGONAL", 3, [](const Fragment& f) { return three(f.inertiaDiagonal); });
    floats("INERTIA_ORIENTATION", 4, [](const Fragment& f) { return four(f.inertiaOrientation); });
    integers("HULLS", 2, [](const Fragment& f) { return two(f.hulls); });
    to["RANGES"] = tables.integers(
        gatherIntegers(set.fragmentRanges, [](const Range& r) { return two(r); }), 2);
    floats("DENSITY", 1, [](const Fragment& f) { return F1{f.density}; });
    floats("FRICTION", 1, [](const Fragment& f) { return F1{f.friction}; });
    floats("RESTITUTION", 1, [](const Fragment& f) { return F1{f.restitution}; });
    floats("STRENGTH", 1, [](const Fragment& f) { return F1{f.strength}; });
    floats("TOUGHNESS", 1, [](const Fragment& f) { return F1{f.toughness}; });
    return out;
}

Json hullsJson(const FractureSet& set, TableWriter& tables) {
    Json out = {{"count", set.hulls.size()}};
    Json& to = out["attributes"];
    to["POINTS"] = tables.integers(
        gatherIntegers(set.hulls, [](const ConvexHull& h) { return two(h.points); }), 2);
    to["MARGIN"] =
        tables.floats(gather(set.hulls, [](const ConvexHull& h) { return F1{h.margin}; }), 1);
    out["points"] = tables.floats(gather(set.hullPoints, three), 3);
    return out;
}

Json bondsJson(const FractureSet& set, TableWriter& tables) {
    const std::vector<Bond>& all = set.bonds;
    Json out = {{"count", all.size()}};
    Json& to = out["attributes"];
    const auto floats = [&](const char* name, uint32_t components, auto get) {
        to[name] = tables.floats(gather(all, get), components);
    };
    to["FRAGMENTS"] = tables.integers(
        gatherIntegers(all,
                       [](const Bond& b) {
                           return U2{static_cast<uint32_t>(b.a), static_cast<uint32_t>(b.b)};
                       }),
        2);
    floats("AREA", 1, [](const Bond& b) { return F1{b.area}; });
    floats("CENTROID", 3, [](const Bond& b) { return three(b.centroid); });
    floats("NORMAL", 3, [](const Bond& b) { return three(b.normal); });
    floats("STRENGTH", 1, [](const Bond& b) { return F1{b.strength}; });
    floats("TOUGHNESS", 1, [](const Bond& b) { return F1{b.toughness}; });
    return out;
}

Json plainGeometry(const FractureGeometry& geometry, TableWriter& tables) {
    Json out = {{"encoding", "none"},
                {"vertexCount", geometry.positions.size()},
                {"indexCount", geometry.indices.size()}};
    tables.beginView();
    Json& to = out["attributes"];
    to["POSITION"] = tables.floats(gather(geometry.positions, three), 3);
    for (const Attribute& attribute : geometry.attributes)
        to[attribute.semantic] = tables.floats(attribute.values, attribute.components);
    out["indices"] = tables.integers(geometry.indices, 1);
    tables.endView();
    return out;
}

Result<Json> dracoGeometry(const FractureGeometry& geometry, TableWriter& tables,
                           const GeometryPacking& packing) {
    const auto mesh = quantize(geometry, packing);
    if (!mesh) return tl::unexpected<Error>(mesh.error());
    const auto stream = encodeDraco(*mesh);
    if (!stream) return tl::unexpected<Error>(stream.error());
    Json out = {{"encoding", "draco"},
                {"vertexCount", mesh->vertexCount},
                {"indexCount", mesh->indices.size()}};
    for (size_t a = 0; a < mesh->attributes.size(); ++a) {
        const QuantizedAttribute& attribute = mesh->attributes[a];
        out["attributes"][attribute.semantic] = {{"id", a},
                                                 {"components", attribute.components},
                                                 {"origin", attribute.origin},
                                                 {"step", attribute.step}};
    }
    out["stream"] = tables.bytes(*stream);
    return out;
}

Result<Json> geometryJson(const FractureGeometry& geometry, TableWriter& tables,
                          const GeometryPacking& packing) {
    Result<Json> out = packing.encoding == GeometryPacking::Encoding::draco
                           ? dracoGeometry(geometry, tables, packing)
                           : plainGeometry(geometry, tables);
    if (!out) return out;
    for (const Primitive& p : geometry.primitives) {
        Json entry = {{"material", p.material}, {"exposedFrom", p.exposedFrom}};
        if (p.sheet) entry["sheet"] = true;
        entry["indices"] = {{"first", p.indices.first}, {"count", p.indices.count}};
        (*out)["primitives"].push_back(std::move(entry));
    }
    return out;
}

}  // namespace

void TableWriter::beginView() {
    bin_.resize((bin_.size() + 7) / 8 * 8);
    viewBegin_ = bin_.size();
}

void TableWriter::endView() {
    views_.push_back(
        Json{{"buffer", 0}, {"byteOffset", viewBegin_}, {"byteLength", bin_.size() - viewBegin_}}
            .dump());
    ++viewCount_;
}

size_t TableWriter::bytes(std::span<const uint8_t> bytes) {
    beginView();
    bin_.insert(bin_.end(), bytes.begin(), bytes.end());
    endView();
    return viewCount_ - 1;
}

size_t TableWriter::floats(std::span<const float> values, uint32_t components) {
    return add({reinterpret_cast<const uint8_t*>(values.data()), values.size_bytes()}, kFloat,
               components);
}

size_t TableWriter::integers(std::span<const uint32_t> values, uint32_t components) {
    return add({reinterpret_cast<const uint8_t*>(values.data()), values.size_bytes()}, kUnsignedInt,
               components);
}

size_t TableWriter::add(std::span<const uint8_t> bytes, uint32_t componentType,
                        uint32_t components) {
    accessors_.push_back(Json{
        {"bufferView", viewCount_},
        {"byteOffset", bin_.size() - viewBegin_},
        {"componentType", componentType},
        {"count", bytes.size() / (4 * components)},
        {"type",
         kTypes[components]}}.dump());
    bin_.insert(bin_.end(), bytes.begin(), bytes.end());
    return accessorCount_++;
}

Result<Json> fractureJson(const FractureSet& set, TableWriter& tables,
                          const GeometryPacking& packing) {
    Json out;
    if (!set.name.empty()) out["name"] = set.name;
    out["mesh"] = set.mesh;
    if (!set.joinedNodes.empty()) out["joined"] = set.joinedNodes;
    out["sourceHash"] = set.sourceHash;
    out["restPose"] = {{"translation", three(set.restPose.translation)},
                       {"rotation", four(set.restPose.rotation)}};
    out["materials"] = set.materials;
    for (const FractureLevel& level : set.levels) {
        Json entry = {{"firstFragment", level.fragments.first},
                      {"fragmentCount", level.fragments.count}};
        if (!level.name.empty()) entry["name"] = level.name;
        out["levels"].push_back(entry);
    }
    tables.beginView();
    out["fragments"] = fragmentsJson(set, tables);
    if (!set.hulls.empty()) out["hulls"] = hullsJson(set, tables);
    if (!set.bonds.empty()) out["bonds"] = bondsJson(set, tables);
    tables.endView();
    Result<Json> geometry = geometryJson(set.geometry, tables, packing);
    if (!geometry) return geometry;
    out["geometry"] = std::move(*geometry);
    return out;
}

}  // namespace sherd
