// SPDX-License-Identifier: MIT
#include "extension_geometry.h"

#include <cmath>

#include "quantized_stream.h"

namespace sherd {
namespace {

using nlohmann::json;

void readPrimitives(ExtensionReader& in, const json& geometry, const std::string& parent,
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

void readPlainGeometry(ExtensionReader& in, const json& geometry, const std::string& where,
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
QuantizedAttribute readGrid(ExtensionReader& in, const json& attribute, const std::string& where,
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

void readDracoGeometry(ExtensionReader& in, const json& geometry, const std::string& where,
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

}  // namespace

void readGeometry(ExtensionReader& in, const json& fracture, const std::string& parent,
                  FractureSet& set) {
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

}  // namespace sherd
