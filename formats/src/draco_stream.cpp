// SPDX-License-Identifier: MIT
// Draco 1.5: sequential meshes of integers. The decoder believes what a stream says about itself
// (61 bytes of an old version take 20 GB), so everything that decides on memory is looked at
// before.
#include "quantized_stream.h"

#ifdef SHERD_HAS_DRACO
#include <optional>
#include <string_view>

#include <draco/attributes/geometry_attribute.h>
#include <draco/compression/expert_encode.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/mesh/mesh.h>
#endif

namespace sherd {

#ifdef SHERD_HAS_DRACO

namespace {

using draco::AttributeValueIndex;
using draco::FaceIndex;
using draco::PointIndex;

tl::unexpected<Error> refuse(const char* why) {
    return fail(ErrorCode::invalidData, std::string("the Draco stream is unusable: ") + why);
}

/// LEB128, as Draco's bitstream has counts from version 2.0 on.
std::optional<uint32_t> takeVarint(std::span<const uint8_t> bytes, size_t& at) {
    uint64_t value = 0;
    for (int shift = 0; shift < 35 && at < bytes.size(); shift += 7) {
        const uint8_t byte = bytes[at++];
        value |= uint64_t{byte & 0x7FU} << shift;
        if ((byte & 0x80U) == 0)
            return value <= UINT32_MAX ? std::optional(uint32_t(value)) : std::nullopt;
    }
    return std::nullopt;
}

/// Draco bitstream specification, 2.2: header, then the counts of a sequential mesh.
Result<void> checkHeader(std::span<const uint8_t> stream, uint32_t faces, uint32_t points) {
    constexpr size_t kHeader = 11;
    if (stream.size() < kHeader ||
        std::string_view(reinterpret_cast<const char*>(stream.data()), 5) != "DRACO")
        return refuse("it does not begin as one");
    if (stream[5] != 2 || stream[6] != 2) return refuse("its version is not 2.2");
    if (stream[7] != draco::TRIANGULAR_MESH) return refuse("it is no mesh");
    if (stream[8] != draco::MESH_SEQUENTIAL_ENCODING)
        return refuse("it is not sequential, and triangles would lose their order");
    if (stream[9] != 0 || stream[10] != 0) return refuse("it has metadata");
    size_t at = kHeader;
    const auto faceCount = takeVarint(stream, at);
    const auto pointCount = takeVarint(stream, at);
    if (faceCount != faces || pointCount != points)
        return refuse("its counts are not those of the file");
    return {};
}

/// Stops between what a stream says of its attributes and the memory taken for them.
class CheckedDecoder final : public draco::MeshSequentialDecoder {
  public:
    explicit CheckedDecoder(const QuantizedMesh& mesh) : mesh_(mesh) {}

  protected:
    bool DecodeAllAttributes() override {
        const draco::PointCloud& cloud = *point_cloud();
        if (size_t(cloud.num_attributes()) != mesh_.attributes.size()) return false;
        for (size_t a = 0; a < mesh_.attributes.size(); ++a) {
            const draco::PointAttribute& attribute = *cloud.attribute(int(a));
            if (attribute.unique_id() != a || attribute.data_type() != draco::DT_UINT32 ||
                attribute.attribute_type() != draco::GeometryAttribute::GENERIC ||
                uint32_t(attribute.num_components()) != mesh_.attributes[a].components)
                return false;
        }
        return draco::MeshSequentialDecoder::DecodeAllAttributes();
    }

  private:
    const QuantizedMesh& mesh_;
};

}  // namespace

bool hasDraco() {
    return true;
}

Result<std::vector<uint8_t>> encodeDraco(const QuantizedMesh& mesh) {
    draco::Mesh out;
    out.set_num_points(mesh.vertexCount);
    out.SetNumFaces(mesh.indices.size() / 3);
    for (size_t f = 0; 3 * f < mesh.indices.size(); ++f)
        out.SetFace(FaceIndex(uint32_t(f)),
                    {PointIndex(mesh.indices[3 * f]), PointIndex(mesh.indices[3 * f + 1]),
                     PointIndex(mesh.indices[3 * f + 2])});
    for (size_t a = 0; a < mesh.attributes.size(); ++a) {
        const QuantizedAttribute& values = mesh.attributes[a];
        draco::GeometryAttribute description;
        description.Init(draco::GeometryAttribute::GENERIC, nullptr, uint8_t(values.components),
                         draco::DT_UINT32, false, int64_t(4) * values.components, 0);
        const int id = out.AddAttribute(description, true, mesh.vertexCount);
        out.attribute(id)->set_unique_id(uint32_t(a));
        for (uint32_t v = 0; v < mesh.vertexCount; ++v)
            out.attribute(id)->SetAttributeValue(AttributeValueIndex(v),
                                                 &values.values[size_t{v} * values.components]);
    }
    draco::ExpertEncoder encoder(out);
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    encoder.SetSpeedOptions(0, 5);
    encoder.options().SetGlobalBool("compress_connectivity", true);
    draco::EncoderBuffer buffer;
    if (const draco::Status status = encoder.EncodeToBuffer(&buffer); !status.ok())
        return fail(ErrorCode::internal,
                    "Draco could not encode the geometry: " + status.error_msg_string());
    const auto* bytes = reinterpret_cast<const uint8_t*>(buffer.data());
    return std::vector<uint8_t>(bytes, bytes + buffer.size());
}

Result<void> decodeDraco(std::span<const uint8_t> stream, uint32_t indexCount,
                         QuantizedMesh& mesh) {
    if (indexCount % 3 != 0) return refuse("its triangles are not whole");
    if (auto ok = checkHeader(stream, indexCount / 3, mesh.vertexCount); !ok) return ok;
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
    draco::Mesh decoded;
    CheckedDecoder decoder(mesh);
    const draco::DecoderOptions options;
    if (!decoder.Decode(options, &buffer, &decoded).ok()) return refuse("it does not decode");
    if (decoded.num_faces() != indexCount / 3 || decoded.num_points() != mesh.vertexCount)
        return refuse("it holds something else than it says");
    mesh.indices.clear();
    mesh.indices.reserve(indexCount);
    for (uint32_t f = 0; f < decoded.num_faces(); ++f)
        for (const PointIndex& corner : decoded.face(FaceIndex(f)))
            mesh.indices.push_back(corner.value());
    for (size_t a = 0; a < mesh.attributes.size(); ++a) {
        const draco::PointAttribute& from = *decoded.attribute(int(a));
        QuantizedAttribute& to = mesh.attributes[a];
        if (from.size() != mesh.vertexCount) return refuse("an attribute misses vertices");
        to.values.resize(size_t{mesh.vertexCount} * to.components);
        for (uint32_t v = 0; v < mesh.vertexCount; ++v)
            from.GetMappedValue(PointIndex(v), &to.values[size_t{v} * to.components]);
    }
    return {};
}

#else

namespace {

tl::unexpected<Error> unsupported() {
    return fail(ErrorCode::unsupported,
                "the geometry is compressed with Draco, which this build of Sherd leaves out; "
                "configure it with -DSHERD_DRACO=ON, or bake with --encoding none");
}

}  // namespace

bool hasDraco() {
    return false;
}

Result<std::vector<uint8_t>> encodeDraco(const QuantizedMesh& /*mesh*/) {
    return unsupported();
}

Result<void> decodeDraco(std::span<const uint8_t> /*stream*/, uint32_t /*indexCount*/,
                         QuantizedMesh& /*mesh*/) {
    return unsupported();
}

#endif

}  // namespace sherd
