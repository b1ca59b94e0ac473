// SPDX-License-Identifier: MIT
// The layout of formats/spec/SHERD_mesh_fracture, reading side; extension_tables.cpp mirrors it.
#include "sherd/formats/glb_read.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <exception>
#include <nlohmann/json.hpp>

#include "extension_name.h"
#include "file_io.h"
#include "gltf_resources.h"
#include "json_text.h"
#include "quantized_stream.h"
#include "sherd/formats/fracture_rules.h"

namespace sherd {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

namespace {

using nlohmann::json;

constexpr uint64_t kMaxWhole = 0xFFFFFFFF;

/// Remembers the first failure; later reads return empty values, so callers check once per stage.
class Reader {
  public:
    Reader(const json& document, std::span<const uint8_t> bin)
        : document_(document), bin_(bin), budget_(4 * bin.size() + 4096) {}

    bool ok() const { return !error_.has_value(); }
    const Error& error() const { return *error_; }

    void fail(ErrorCode code, std::string message, std::string where) {
        if (!error_) error_ = Error{code, std::move(message), std::move(where)};
    }

    const json& member(const json& object, const char* key, const std::string& where) {
        static const json kNull;
        const auto found = object.is_object() ? object.find(key) : object.end();
        if (object.is_object() && found != object.end()) return *found;
        fail(ErrorCode::invalidData, "this is missing", where + "/" + key);
        return kNull;
    }

    static const json* optional(const json& object, const char* key) {
        if (!object.is_object()) return nullptr;
        const auto found = object.find(key);
        return found == object.end() ? nullptr : &*found;
    }

    uint64_t whole(const json& value, const std::string& where, uint64_t max = kMaxWhole) {
        if (value.is_number_unsigned() && value.get<uint64_t>() <= max)
            return value.get<uint64_t>();
        // Other tools may print whole numbers as 12.0.
        if (value.is_number_float()) {
            const double number = value.get<double>();
            if (number >= 0 && number <= static_cast<double>(max) && std::floor(number) == number)
                return static_cast<uint64_t>(number);
        }
        fail(ErrorCode::invalidData, "this must be a whole number up to " + std::to_string(max),
             where);
        return 0;
    }

    uint64_t whole(const json& object, const char* key, const std::string& where,
                   uint64_t max = kMaxWhole) {
        const json& value = member(object, key, where);
        return ok() ? whole(value, where + "/" + key, max) : 0;
    }

    uint64_t wholeOr(const json& object, const char* key, const std::string& where,
                     uint64_t otherwise) {
        const json* value = optional(object, key);
        return value == nullptr ? otherwise : whole(*value, where + "/" + key);
    }

    const json& array(const json& object, const char* key, const std::string& where) {
        const json& value = member(object, key, where);
        if (ok() && (!value.is_array() || value.empty()))
            fail(ErrorCode::invalidData, "this must be an array with elements", where + "/" + key);
        return value;
    }

    std::string text(const json& object, const char* key, const std::string& where) {
        const json* value = optional(object, key);
        if (value == nullptr) return {};
        if (!value->is_string())
            fail(ErrorCode::invalidData, "this must be a string", where + "/" + key);
        return value->is_string() ? value->get<std::string>() : std::string();
    }

    bool flag(const json& object, const char* key, const std::string& where) {
        const json* value = optional(object, key);
        if (value == nullptr) return false;
        if (!value->is_boolean())
            fail(ErrorCode::invalidData, "this must be true or false", where + "/" + key);
        return value->is_boolean() && value->get<bool>();
    }

    template <size_t N>
    std::array<float, N> numbers(const json& object, const char* key, const std::string& where) {
        std::array<float, N> out{};
        const json& value = member(object, key, where);
        if (!ok()) return out;
        for (size_t i = 0; i < N; ++i) {
            const bool present = value.is_array() && value.size() == N && value[i].is_number();
            out[i] = present ? static_cast<float>(value[i].get<double>()) : NAN;
            if (!std::isfinite(out[i])) {
                fail(ErrorCode::invalidData, "this must be " + std::to_string(N) + " numbers",
                     where + "/" + key);
                return {};
            }
        }
        return out;
    }

    /// The bytes of the accessor `object[key]`: tightly packed, of the type asked for.
    /// `count`: as many elements as there must be.
    std::span<const uint8_t> table(const json& object, const char* key, const std::string& where,
                                   uint32_t componentType, uint32_t components, uint64_t count) {
        const uint64_t index = whole(object, key, where);
        if (!ok()) return {};
        const std::string at = where + "/" + key;
        return accessor(index, at, componentType, components, count);
    }

    template <size_t Components>
    std::vector<float> floats(const json& object, const char* key, const std::string& where,
                              uint64_t count) {
        return floats(object, key, where, count, Components);
    }

    std::vector<float> floats(const json& object, const char* key, const std::string& where,
                              uint64_t count, uint32_t components) {
        const auto bytes = table(object, key, where, kFloat, components, count);
        std::vector<float> out(bytes.size() / 4);
        if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
        bool finite = true;
        for (const float value : out) finite = finite && std::abs(value) <= 3.4028234e38F;
        if (!finite)
            fail(ErrorCode::invalidData, "there are numbers that are not finite",
                 where + "/" + key);
        return finite ? out : std::vector<float>();
    }

    std::vector<uint32_t> integers(const json& object, const char* key, const std::string& where,
                                   uint64_t count, uint32_t components) {
        const auto bytes = table(object, key, where, kUnsignedInt, components, count);
        std::vector<uint32_t> out(bytes.size() / 4);
        if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
        return out;
    }

    /// The bytes of the bufferView `object[key]`.
    std::span<const uint8_t> stream(const json& object, const char* key, const std::string& where) {
        const uint64_t index = whole(object, key, where);
        if (!ok()) return {};
        const auto view = bufferView(index, where + "/" + key);
        if (ok() && view.size() > budget_)
            fail(ErrorCode::limitExceeded, "too many fractures share the same stream", where);
        if (!ok()) return {};
        budget_ -= view.size();
        return view;
    }

    /// How many components the accessor has, 1 to 4.
    uint32_t componentsOf(const json& index, const std::string& where) {
        const json& entry = element("accessors", whole(index, where), where);
        const json* type = optional(entry, "type");
        for (uint32_t components = 1; type != nullptr && components <= 4; ++components)
            if (*type == typeName(components)) return components;
        fail(ErrorCode::invalidData, "this must name an accessor of 1 to 4 components", where);
        return 1;
    }

    /// How many elements the accessor `object[key]` says it has.
    uint64_t countOf(const json& object, const char* key, const std::string& where) {
        const uint64_t index = whole(object, key, where);
        const json& entry = element("accessors", index, where + "/" + key);
        return ok() ? whole(entry, "count", "/accessors/" + std::to_string(index)) : 0;
    }

  private:
    static const char* typeName(uint32_t components) {
        constexpr std::array<const char*, 5> kNames = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        return kNames[components];
    }

    const json& element(const char* list, uint64_t index, const std::string& where) {
        static const json kNull;
        const json* all = optional(document_, list);
        if (all != nullptr && all->is_array() && index < all->size()) return (*all)[index];
        fail(ErrorCode::invalidData,
             "there is no /" + std::string(list) + "/" + std::to_string(index), where);
        return kNull;
    }

    std::span<const uint8_t> accessor(uint64_t index, const std::string& where,
                                      uint32_t componentType, uint32_t components, uint64_t count) {
        const json& entry = element("accessors", index, where);
        if (!ok()) return {};
        const std::string at = "/accessors/" + std::to_string(index);
        const json* type = optional(entry, "type");
        if (whole(entry, "componentType", at) != componentType || type == nullptr ||
            *type != typeName(components) || optional(entry, "sparse") != nullptr)
            fail(ErrorCode::invalidData,
                 "the accessor for " + where + " must be a plain " + typeName(components) +
                     (componentType == kFloat ? " of FLOAT" : " of UNSIGNED_INT"),
                 at);
        const uint64_t have = whole(entry, "count", at);
        if (ok() && have != count)
            fail(ErrorCode::invalidData,
                 "the accessor for " + where + " has " + std::to_string(have) + " elements, " +
                     std::to_string(count) + " are needed",
                 at + "/count");
        const uint64_t viewIndex = whole(entry, "bufferView", at);
        const uint64_t offset = wholeOr(entry, "byteOffset", at, 0);
        if (!ok()) return {};
        const auto view = bufferView(viewIndex, at + "/bufferView");
        const uint64_t size = count * components * 4;  // below 2^36
        if (ok() && (offset > view.size() || size > view.size() - offset))
            fail(ErrorCode::invalidData, "the accessor reaches beyond its bufferView", at);
        if (ok() && size > budget_)
            // Tables shared by thousands of fractures would unfold into any amount of memory.
            fail(ErrorCode::limitExceeded, "too many fractures share the same tables", where);
        if (!ok()) return {};
        budget_ -= size;
        return view.subspan(offset, size);
    }

    std::span<const uint8_t> bufferView(uint64_t index, const std::string& where) {
        const json& view = element("bufferViews", index, where);
        if (!ok()) return {};
        const std::string at = "/bufferViews/" + std::to_string(index);
        const uint64_t buffer = whole(view, "buffer", at);
        const uint64_t offset = wholeOr(view, "byteOffset", at, 0);
        const uint64_t length = whole(view, "byteLength", at);
        if (ok() && (buffer != 0 || optional(view, "byteStride") != nullptr))
            fail(ErrorCode::invalidData, "fracture data lies tightly packed in buffer 0", at);
        if (ok() && (offset > bin_.size() || length > bin_.size() - offset))
            fail(ErrorCode::invalidData, "the bufferView reaches beyond the binary chunk", at);
        return ok() ? bin_.subspan(offset, length) : std::span<const uint8_t>();
    }

    const json& document_;
    std::span<const uint8_t> bin_;
    uint64_t budget_;
    std::optional<Error> error_;
};

glm::vec3 vector3(const std::vector<float>& values, size_t i) {
    return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

glm::quat quaternion(const float* xyzw) {
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

std::vector<glm::vec3> vectors(const std::vector<float>& values) {
    std::vector<glm::vec3> out(values.size() / 3);
    for (size_t i = 0; i < out.size(); ++i) out[i] = vector3(values, i);
    return out;
}

std::vector<Range> ranges(const std::vector<uint32_t>& values) {
    std::vector<Range> out(values.size() / 2);
    for (size_t i = 0; i < out.size(); ++i) out[i] = {values[2 * i], values[2 * i + 1]};
    return out;
}

/// An optional array of one word per fragment.
void readFragmentWords(Reader& in, const json& fragments, const char* key, const std::string& where,
                       std::string Fragment::*word, FractureSet& set) {
    const json* words = Reader::optional(fragments, key);
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

void readFragments(Reader& in, const json& fracture, const std::string& parent, FractureSet& set) {
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

void readHulls(Reader& in, const json& fracture, const std::string& parent, FractureSet& set) {
    const json* hulls = Reader::optional(fracture, "hulls");
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

void readBonds(Reader& in, const json& fracture, const std::string& parent, FractureSet& set) {
    const json* bonds = Reader::optional(fracture, "bonds");
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

void readPrimitives(Reader& in, const json& geometry, const std::string& parent,
                    FractureGeometry& out) {
    const json& all = in.array(geometry, "primitives", parent);
    for (size_t p = 0; in.ok() && p < all.size(); ++p) {
        const std::string where = parent + "/primitives/" + std::to_string(p);
        Primitive primitive;
        primitive.material = static_cast<uint32_t>(in.whole(all[p], "material", where));
        primitive.exposedFrom = static_cast<uint32_t>(in.whole(all[p], "exposedFrom", where));
        primitive.sheet = in.flag(all[p], "sheet", where);
        const json& indices = in.member(all[p], "indices", where);
        primitive.indices.first =
            static_cast<uint32_t>(in.whole(indices, "first", where + "/indices"));
        primitive.indices.count =
            static_cast<uint32_t>(in.whole(indices, "count", where + "/indices"));
        out.primitives.push_back(primitive);
    }
}

void readPlainGeometry(Reader& in, const json& geometry, const std::string& where,
                       FractureGeometry& out) {
    const uint64_t vertices = in.whole(geometry, "vertexCount", where);
    const uint64_t indices = in.whole(geometry, "indexCount", where);
    const json& attributes = in.member(geometry, "attributes", where);
    out.positions = vectors(in.floats<3>(attributes, "POSITION", where + "/attributes", vertices));
    out.indices = in.integers(geometry, "indices", where, indices, 1);
    if (!in.ok()) return;
    for (const auto& [semantic, accessor] : attributes.items()) {
        if (semantic == "POSITION") continue;
        Attribute attribute;
        attribute.semantic = semantic;
        std::string place = where;
        place.append("/attributes/").append(semantic);
        attribute.components = in.componentsOf(accessor, place);
        attribute.values = in.floats(attributes, semantic.c_str(), where + "/attributes", vertices,
                                     attribute.components);
        if (!in.ok()) return;
        out.attributes.push_back(std::move(attribute));
    }
}

/// Where the values of one attribute lie in the stream, and on which grid.
QuantizedAttribute readGrid(Reader& in, const json& attribute, const std::string& where,
                            uint64_t attributeCount, uint64_t& id) {
    QuantizedAttribute out;
    id = in.whole(attribute, "id", where);
    out.components = static_cast<uint32_t>(in.whole(attribute, "components", where, 4));
    if (in.ok() && (id >= attributeCount || out.components == 0))
        in.fail(ErrorCode::invalidData, "ids count from 0, components 1 to 4", where);
    const auto numbers = [&]<size_t N>() {
        const auto origin = in.numbers<N>(attribute, "origin", where);
        out.origin.assign(origin.begin(), origin.end());
    };
    if (!in.ok()) return out;
    if (out.components == 1) numbers.operator()<1>();
    if (out.components == 2) numbers.operator()<2>();
    if (out.components == 3) numbers.operator()<3>();
    if (out.components == 4) numbers.operator()<4>();
    const json& step = in.member(attribute, "step", where);
    out.step = step.is_number() ? static_cast<float>(step.get<double>()) : 0.0F;
    if (!(out.step > 0) || !std::isfinite(out.step))
        in.fail(ErrorCode::invalidData, "this must be a positive number", where + "/step");
    return out;
}

void readDracoGeometry(Reader& in, const json& geometry, const std::string& where,
                       FractureGeometry& out) {
    // A vertex or two triangles take a byte and more; what claims less is made to fill memory.
    constexpr uint64_t kVerticesPerByte = 4, kIndicesPerByte = 16;
    const auto stream = in.stream(geometry, "stream", where);
    const uint64_t vertices = in.whole(geometry, "vertexCount", where);
    const uint64_t indices = in.whole(geometry, "indexCount", where);
    const json& attributes = in.member(geometry, "attributes", where);
    if (!in.ok()) return;
    if (vertices > kVerticesPerByte * stream.size() || indices > kIndicesPerByte * stream.size())
        return in.fail(ErrorCode::limitExceeded, "the stream is too short for so much geometry",
                       where + "/stream");
    if (!attributes.is_object() || attributes.find("POSITION") == attributes.end())
        return in.fail(ErrorCode::invalidData, "there must be a POSITION", where + "/attributes");
    QuantizedMesh mesh;
    mesh.vertexCount = static_cast<uint32_t>(vertices);
    mesh.attributes.resize(attributes.size());
    for (const auto& [semantic, attribute] : attributes.items()) {
        std::string place = where;
        place.append("/attributes/").append(semantic);
        uint64_t id = 0;
        QuantizedAttribute grid = readGrid(in, attribute, place, attributes.size(), id);
        if (!in.ok()) return;
        if (!mesh.attributes[id].semantic.empty() || semantic.empty() ||
            (semantic == "POSITION" && grid.components != 3))
            return in.fail(ErrorCode::invalidData,
                           "attributes must have a name and an id each, POSITION 3 components",
                           place);
        grid.semantic = semantic;
        mesh.attributes[id] = std::move(grid);
    }
    if (auto decoded = decodeDraco(stream, static_cast<uint32_t>(indices), mesh); !decoded)
        return in.fail(decoded.error().code, decoded.error().message, where + "/stream");
    out.indices = std::move(mesh.indices);
    for (const QuantizedAttribute& attribute : mesh.attributes) {
        std::vector<float> values = dequantize(attribute);
        for (const float value : values)
            if (!std::isfinite(value))
                return in.fail(ErrorCode::invalidData, "there are numbers that are not finite",
                               where + "/attributes/" + attribute.semantic);
        if (attribute.semantic == "POSITION")
            out.positions = vectors(values);
        else
            out.attributes.push_back({attribute.semantic, attribute.components, std::move(values)});
    }
}

void readGeometry(Reader& in, const json& fracture, const std::string& parent, FractureSet& set) {
    const std::string where = parent + "/geometry";
    const json& geometry = in.member(fracture, "geometry", parent);
    if (!in.ok()) return;
    const std::string encoding = in.text(geometry, "encoding", where);
    if (encoding == "none")
        readPlainGeometry(in, geometry, where, set.geometry);
    else if (encoding == "draco")
        readDracoGeometry(in, geometry, where, set.geometry);
    else
        return in.fail(ErrorCode::unsupported,
                       "geometry encoding '" + encoding + "' is not supported",
                       where + "/encoding");
    if (in.ok()) readPrimitives(in, geometry, where, set.geometry);
}

void readLevels(Reader& in, const json& fracture, const std::string& parent, FractureSet& set) {
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

void readMaterials(Reader& in, const json& document, const json& fracture, const std::string& where,
                   FractureSet& set) {
    const json& all = in.array(fracture, "materials", where);
    const json* known = Reader::optional(document, "materials");
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

void readJoined(Reader& in, const json& document, const json& fracture, const std::string& parent,
                FractureSet& set) {
    if (Reader::optional(fracture, "joined") == nullptr) return;
    const json& all = in.array(fracture, "joined", parent);
    const json* nodes = Reader::optional(document, "nodes");
    const uint64_t count = nodes != nullptr && nodes->is_array() ? nodes->size() : 0;
    for (size_t j = 0; in.ok() && j < all.size(); ++j) {
        const std::string at = parent + "/joined/" + std::to_string(j);
        const uint64_t node = in.whole(all[j], at, INT32_MAX);
        if (in.ok() && node >= count) in.fail(ErrorCode::invalidData, "there is no such node", at);
        set.joinedNodes.push_back(static_cast<int32_t>(node));
    }
}

FractureSet readFracture(Reader& in, const json& document, const json& fracture,
                         const std::string& where) {
    FractureSet set;
    set.name = in.text(fracture, "name", where);
    set.sourceHash = in.text(fracture, "sourceHash", where);
    set.mesh = static_cast<int32_t>(in.whole(fracture, "mesh", where, INT32_MAX));
    const json* meshes = Reader::optional(document, "meshes");
    if (in.ok() && (meshes == nullptr || !meshes->is_array() ||
                    static_cast<size_t>(set.mesh) >= meshes->size()))
        in.fail(ErrorCode::invalidData, "there is no such mesh", where + "/mesh");
    if (const json* pose = Reader::optional(fracture, "restPose")) {
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

/// A node belongs to one object at most, and once.
void checkNodeUse(Reader& in, const json& document, const std::vector<FractureSet>& sets) {
    const json* nodes = Reader::optional(document, "nodes");
    std::vector<bool> used(nodes != nullptr && nodes->is_array() ? nodes->size() : 0, false);
    for (const FractureSet& set : sets) {
        if (set.node >= 0) used[static_cast<size_t>(set.node)] = true;
        for (const int32_t node : set.sameNodes) used[static_cast<size_t>(node)] = true;
    }
    for (size_t s = 0; s < sets.size(); ++s) {
        const std::string where = "/extensions/" + std::string(kExtensionName) + "/fractures/" +
                                  std::to_string(s) + "/joined";
        if (!sets[s].joinedNodes.empty() && !sets[s].sameNodes.empty())
            return in.fail(ErrorCode::invalidData,
                           "an object of several nodes can be carried by one of them only", where);
        for (size_t j = 0; j < sets[s].joinedNodes.size(); ++j) {
            const auto node = static_cast<size_t>(sets[s].joinedNodes[j]);
            if (used[node])
                return in.fail(ErrorCode::invalidData,
                               "node " + std::to_string(node) + " is part of an object already",
                               where + "/" + std::to_string(j));
            used[node] = true;
        }
    }
}

/// The nodes that carry each fracture, the first one apart.
void findNodes(Reader& in, const json& document, std::vector<FractureSet>& sets) {
    const json* nodes = Reader::optional(document, "nodes");
    for (size_t n = 0; nodes != nullptr && nodes->is_array() && n < nodes->size(); ++n) {
        const json* extensions = Reader::optional((*nodes)[n], "extensions");
        const json* ours =
            extensions != nullptr ? Reader::optional(*extensions, kExtensionName) : nullptr;
        if (ours == nullptr) continue;
        const std::string where =
            "/nodes/" + std::to_string(n) + "/extensions/" + std::string(kExtensionName);
        const uint64_t index = in.whole(*ours, "fracture", where);
        if (in.ok() && index >= sets.size())
            in.fail(ErrorCode::invalidData, "there is no such fracture", where + "/fracture");
        if (!in.ok()) return;
        if (sets[index].node < 0)
            sets[index].node = static_cast<int32_t>(n);
        else
            sets[index].sameNodes.push_back(static_cast<int32_t>(n));
    }
    for (size_t s = 0; s < sets.size(); ++s)
        if (sets[s].node < 0)
            in.fail(
                ErrorCode::invalidData, "no node carries this fracture",
                "/extensions/" + std::string(kExtensionName) + "/fractures/" + std::to_string(s));
}

Result<std::vector<FractureSet>> readDocument(const GltfDocument& document) {
    if (!jsonDepthIsSafe(document.json))
        return fail(ErrorCode::limitExceeded,
                    "the JSON nests deeper than " + std::to_string(kMaxJsonDepth) + " levels");
    const json root = json::parse(document.json, nullptr, false);
    if (!root.is_object()) return fail(ErrorCode::malformed, "the JSON is not valid");
    const json* extensions = Reader::optional(root, "extensions");
    const json* ours =
        extensions != nullptr ? Reader::optional(*extensions, kExtensionName) : nullptr;
    std::vector<FractureSet> sets;
    if (ours == nullptr) return sets;
    const std::string where = "/extensions/" + std::string(kExtensionName);
    Reader in(root, document.bin);
    if (in.whole(*ours, "version", where) != kExtensionVersion && in.ok())
        return fail(ErrorCode::unsupported,
                    "this version of the extension is not supported; bake the object again",
                    where + "/version");
    const json& fractures = in.array(*ours, "fractures", where);
    for (size_t i = 0; in.ok() && i < fractures.size(); ++i)
        sets.push_back(
            readFracture(in, root, fractures[i], where + "/fractures/" + std::to_string(i)));
    if (in.ok()) findNodes(in, root, sets);
    if (in.ok()) checkNodeUse(in, root, sets);
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
