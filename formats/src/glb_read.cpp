// SPDX-License-Identifier: MIT
// The layout of formats/spec/SHERD_mesh_fracture, reading side; extension_tables.cpp mirrors it.
#include "sherd/formats/glb_read.h"

#include <exception>
#include <nlohmann/json.hpp>

#include "extension_geometry.h"
#include "extension_name.h"
#include "extension_nodes.h"
#include "extension_reader.h"
#include "file_io.h"
#include "gltf_resources.h"
#include "json_text.h"
#include "sherd/formats/fracture_rules.h"

namespace sherd {
namespace {

using nlohmann::json;

/// An optional array of one word per fragment.
void readFragmentWords(ExtensionReader& in, const json& fragments, const char* key,
                       const std::string& where, std::string Fragment::*word, FractureSet& set) {
    const json* words = ExtensionReader::optional(fragments, key);
    if (words == nullptr) return;
    const std::string at = where + "/" + key;
    if (!words->is_array() || words->size() != set.fragments.size())
        return in.fail(ErrorCode::invalidData, "there must be one string per fragment", at);
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        if (!(*words)[f].is_string())
            return in.fail(ErrorCode::invalidData, "this must be a string",
                           at + "/" + std::to_string(f));
        set.fragments[f].*word = (*words)[f].get<std::string>();
    }
}

void readFragments(ExtensionReader& in, const json& fracture, const std::string& parent,
                   FractureSet& set) {
    const std::string where = parent + "/fragments";
    const json& fragments = in.member(fracture, "fragments", parent);
    const uint64_t count = in.whole(fragments, "count", where);
    const json& from = in.member(fragments, "attributes", where);
    const std::string at = where + "/attributes";
    const size_t primitives = set.geometry.primitives.size();
    const auto parents = in.integers(from, "PARENT", at, count, 1);
    const auto children = ranges(in.integers(from, "CHILDREN", at, count, 2));
    const auto mass = in.floats<1>(from, "MASS", at, count);
    const auto volume = in.floats<1>(from, "VOLUME", at, count);
    const auto center = in.floats<3>(from, "CENTER_OF_MASS", at, count);
    const auto inertia = in.floats<3>(from, "INERTIA_DIAGONAL", at, count);
    const auto axes = in.floats<4>(from, "INERTIA_ORIENTATION", at, count);
    const auto hulls = ranges(in.integers(from, "HULLS", at, count, 2));
    const auto density = in.floats<1>(from, "DENSITY", at, count);
    const auto friction = in.floats<1>(from, "FRICTION", at, count);
    const auto restitution = in.floats<1>(from, "RESTITUTION", at, count);
    const auto strength = in.floats<1>(from, "STRENGTH", at, count);
    const auto toughness = in.floats<1>(from, "TOUGHNESS", at, count);
    if (in.ok())
        set.fragmentRanges = ranges(in.integers(from, "RANGES", at, count * primitives, 2));
    if (!in.ok()) return;
    set.fragments.resize(count);
    for (size_t f = 0; f < count; ++f) {
        Fragment& out = set.fragments[f];
        out.parent = static_cast<int32_t>(parents[f]);
        out.children = children[f];
        out.mass = mass[f];
        out.volume = volume[f];
        out.centerOfMass = vector3(center, f);
        out.inertiaDiagonal = vector3(inertia, f);
        out.inertiaOrientation = quaternion(&axes[4 * f]);
        out.hulls = hulls[f];
        out.density = density[f];
        out.friction = friction[f];
        out.restitution = restitution[f];
        out.strength = strength[f];
        out.toughness = toughness[f];
    }
    readFragmentWords(in, fragments, "names", where, &Fragment::name, set);
    readFragmentWords(in, fragments, "materials", where, &Fragment::material, set);
}

void readHulls(ExtensionReader& in, const json& fracture, const std::string& parent,
               FractureSet& set) {
    const json* hulls = ExtensionReader::optional(fracture, "hulls");
    if (hulls == nullptr) return;
    const std::string where = parent + "/hulls";
    const uint64_t count = in.whole(*hulls, "count", where);
    const json& from = in.member(*hulls, "attributes", where);
    const auto points = ranges(in.integers(from, "POINTS", where + "/attributes", count, 2));
    const auto margin = in.floats<1>(from, "MARGIN", where + "/attributes", count);
    if (!in.ok()) return;
    for (size_t h = 0; h < count; ++h) set.hulls.push_back({points[h], margin[h]});
    const uint64_t pointCount = in.countOf(*hulls, "points", where);
    set.hullPoints = vectors(in.floats<3>(*hulls, "points", where, pointCount));
}

void readBonds(ExtensionReader& in, const json& fracture, const std::string& parent,
               FractureSet& set) {
    const json* bonds = ExtensionReader::optional(fracture, "bonds");
    if (bonds == nullptr) return;
    const std::string where = parent + "/bonds";
    const uint64_t count = in.whole(*bonds, "count", where);
    const json& from = in.member(*bonds, "attributes", where);
    const std::string at = where + "/attributes";
    const auto pairs = in.integers(from, "FRAGMENTS", at, count, 2);
    const auto area = in.floats<1>(from, "AREA", at, count);
    const auto centroid = in.floats<3>(from, "CENTROID", at, count);
    const auto normal = in.floats<3>(from, "NORMAL", at, count);
    const auto strength = in.floats<1>(from, "STRENGTH", at, count);
    const auto toughness = in.floats<1>(from, "TOUGHNESS", at, count);
    if (!in.ok()) return;
    set.bonds.resize(count);
    for (size_t b = 0; b < count; ++b) {
        Bond& out = set.bonds[b];
        out.a = static_cast<int32_t>(pairs[2 * b]);
        out.b = static_cast<int32_t>(pairs[2 * b + 1]);
        out.area = area[b];
        out.centroid = vector3(centroid, b);
        out.normal = vector3(normal, b);
        out.strength = strength[b];
        out.toughness = toughness[b];
    }
}

void readLevels(ExtensionReader& in, const json& fracture, const std::string& parent,
                FractureSet& set) {
    const json& all = in.array(fracture, "levels", parent);
    for (size_t k = 0; in.ok() && k < all.size(); ++k) {
        const std::string where = parent + "/levels/" + std::to_string(k);
        FractureLevel level;
        level.fragments.first = static_cast<uint32_t>(in.whole(all[k], "firstFragment", where));
        level.fragments.count = static_cast<uint32_t>(in.whole(all[k], "fragmentCount", where));
        level.name = in.text(all[k], "name", where);
        set.levels.push_back(std::move(level));
    }
}

void readMaterials(ExtensionReader& in, const json& document, const json& fracture,
                   const std::string& where, FractureSet& set) {
    const json& all = in.array(fracture, "materials", where);
    const json* known = ExtensionReader::optional(document, "materials");
    const uint64_t count = known != nullptr && known->is_array() ? known->size() : 0;
    for (size_t m = 0; in.ok() && m < all.size(); ++m) {
        const std::string at = where + "/materials/" + std::to_string(m);
        const bool isDefault = all[m].is_number_integer() && all[m] == -1;
        const uint64_t index = isDefault ? 0 : in.whole(all[m], at, INT32_MAX);
        if (!isDefault && index >= count)
            in.fail(ErrorCode::invalidData, "there is no such material", at);
        set.materials.push_back(isDefault ? -1 : static_cast<int32_t>(index));
    }
}

void readJoined(ExtensionReader& in, const json& document, const json& fracture,
                const std::string& parent, FractureSet& set) {
    if (ExtensionReader::optional(fracture, "joined") == nullptr) return;
    const json& all = in.array(fracture, "joined", parent);
    const json* nodes = ExtensionReader::optional(document, "nodes");
    const uint64_t count = nodes != nullptr && nodes->is_array() ? nodes->size() : 0;
    for (size_t j = 0; in.ok() && j < all.size(); ++j) {
        const std::string at = parent + "/joined/" + std::to_string(j);
        const uint64_t node = in.whole(all[j], at, INT32_MAX);
        if (in.ok() && node >= count) in.fail(ErrorCode::invalidData, "there is no such node", at);
        set.joinedNodes.push_back(static_cast<int32_t>(node));
    }
}

FractureSet readFracture(ExtensionReader& in, const json& document, const json& fracture,
                         const std::string& where) {
    FractureSet set;
    set.name = in.text(fracture, "name", where);
    set.sourceHash = in.text(fracture, "sourceHash", where);
    set.mesh = static_cast<int32_t>(in.whole(fracture, "mesh", where, INT32_MAX));
    const json* meshes = ExtensionReader::optional(document, "meshes");
    if (in.ok() && (meshes == nullptr || !meshes->is_array() ||
                    static_cast<size_t>(set.mesh) >= meshes->size()))
        in.fail(ErrorCode::invalidData, "there is no such mesh", where + "/mesh");
    if (const json* pose = ExtensionReader::optional(fracture, "restPose")) {
        const auto t = in.numbers<3>(*pose, "translation", where + "/restPose");
        const auto r = in.numbers<4>(*pose, "rotation", where + "/restPose");
        if (in.ok()) set.restPose = {{t[0], t[1], t[2]}, quaternion(r.data())};
    }
    readJoined(in, document, fracture, where, set);
    readMaterials(in, document, fracture, where, set);
    readLevels(in, fracture, where, set);
    readGeometry(in, fracture, where, set);
    if (in.ok()) readFragments(in, fracture, where, set);
    if (in.ok()) readHulls(in, fracture, where, set);
    if (in.ok()) readBonds(in, fracture, where, set);
    if (!in.ok()) return set;
    numberLevels(set);
    if (auto error = brokenFractureRule(set, where))
        in.fail(error->code, std::move(error->message), std::move(error->where));
    return set;
}

Result<std::vector<FractureSet>> readDocument(const GltfDocument& document) {
    if (!jsonDepthIsSafe(document.json))
        return fail(ErrorCode::limitExceeded,
                    "the JSON nests deeper than " + std::to_string(kMaxJsonDepth) + " levels");
    const json root = json::parse(document.json, nullptr, false);
    if (!root.is_object()) return fail(ErrorCode::malformed, "the JSON is not valid");
    const json* extensions = ExtensionReader::optional(root, "extensions");
    const json* ours =
        extensions != nullptr ? ExtensionReader::optional(*extensions, kExtensionName) : nullptr;
    std::vector<FractureSet> sets;
    if (ours == nullptr) return sets;
    const std::string where = "/extensions/" + std::string(kExtensionName);
    ExtensionReader in(root, document.bin);
    if (in.whole(*ours, "version", where) != kExtensionVersion && in.ok())
        return fail(ErrorCode::unsupported,
                    "this version of the extension is not supported; bake the object again",
                    where + "/version");
    const json& fractures = in.array(*ours, "fractures", where);
    for (size_t i = 0; in.ok() && i < fractures.size(); ++i)
        sets.push_back(
            readFracture(in, root, fractures[i], where + "/fractures/" + std::to_string(i)));
    if (in.ok()) readNodes(in, root, sets);
    if (!in.ok()) return tl::unexpected<Error>(in.error());
    return sets;
}

}  // namespace

Result<std::vector<FractureSet>> readFractureSets(std::span<const uint8_t> glb) {
    try {
        const auto document = splitGlb(glb, "");
        if (!document) return tl::unexpected<Error>(document.error());
        return readDocument(*document);
    } catch (const std::exception& e) {
        return fail(ErrorCode::limitExceeded, std::string("the file cannot be held: ") + e.what());
    }
}

Result<std::vector<FractureSet>> readFractureSets(const std::filesystem::path& path) {
    auto bytes = readFileWhole(path);
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    auto sets = readFractureSets(*bytes);
    if (!sets) {
        Error error = sets.error();
        error.where = path.string() + error.where;
        return tl::unexpected<Error>(std::move(error));
    }
    return sets;
}

}  // namespace sherd
