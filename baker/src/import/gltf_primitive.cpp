// SPDX-License-Identifier: MIT
#include "import/gltf_primitive.h"

#include <cmath>
#include <cstring>
#include <numeric>

#include "import/gltf_accessor.h"
#include "import/limits.h"

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;

/// Triangles of a list, strip or fan of `vertices`. The index-degenerate triangles that connect
/// runs within a strip are left out; a list is taken as it is.
std::vector<Triangle> toTriangles(int mode, const std::vector<uint32_t>& vertices) {
    std::vector<Triangle> out;
    const size_t n = vertices.size();
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        out.reserve(n / 3);
        for (size_t i = 0; i + 2 < n; i += 3) {
            out.push_back({vertices[i], vertices[i + 1], vertices[i + 2]});
        }
        return out;
    }
    for (size_t i = 0; i + 2 < n; ++i) {
        Triangle t{vertices[i], vertices[i + 1], vertices[i + 2]};
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            t = {vertices[i + 1], vertices[i + 2], vertices[0]};
        } else if (i % 2 == 1) {
            t = {vertices[i], vertices[i + 2], vertices[i + 1]};
        }
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out.push_back(t);
    }
    return out;
}

/// The component count glTF fixes for a semantic; 0 for custom ones, -1 for names it does not know.
int componentsOf(const std::string& semantic) {
    if (semantic == "NORMAL") return 3;
    if (semantic == "TANGENT") return 4;
    if (semantic.starts_with("TEXCOORD_")) return 2;
    if (semantic.starts_with("COLOR_")) return 4;
    return semantic.starts_with("_") ? 0 : -1;
}

void addAlpha(FloatAccessor& color) {
    std::vector<float> rgba;
    rgba.reserve(color.count * 4);
    for (size_t i = 0; i < color.values.size(); i += 3) {
        rgba.insert(rgba.end(), {color.values[i], color.values[i + 1], color.values[i + 2], 1.0F});
    }
    color.values = std::move(rgba);
    color.components = 4;
}

/// Nothing if the attribute is one Sherd leaves out, which is reported.
Result<std::optional<Attribute>> readAttribute(const GltfSource& source,
                                               const std::string& semantic, int accessor,
                                               size_t vertexCount,
                                               const PrimitiveContext& context) {
    const std::string pointer = context.pointer + "/attributes/" + semantic;
    const auto bad = [&](const std::string& message) {
        return fail(ErrorCode::invalidData, message, source.where(pointer));
    };
    const int expected = componentsOf(semantic);
    if (expected < 0) {
        context.warnings->push_back("the attribute " + semantic +
                                    " is not one glTF defines; it was dropped (custom names start "
                                    "with an underscore)");
        return std::optional<Attribute>();
    }
    auto data = readFloats(source, accessor, pointer);
    if (!data) return tl::unexpected(data.error());
    if (data->count != vertexCount) {
        return bad(semantic + " has " + std::to_string(data->count) + " values for " +
                   std::to_string(vertexCount) + " positions");
    }
    if (data->components == 3 && expected == 4 && semantic != "TANGENT") addAlpha(*data);
    if (expected != 0 && data->components != static_cast<uint32_t>(expected)) {
        return bad(semantic + " must have " + std::to_string(expected) + " components");
    }
    if (semantic.starts_with("TEXCOORD_")) {
        for (const float value : data->values) {
            if (!std::isfinite(value)) return bad(semantic + " holds a value that is not finite");
        }
    }
    return std::optional<Attribute>(Attribute{semantic, data->components, std::move(data->values)});
}

}  // namespace

Result<std::vector<glm::vec3>> readPositions(const GltfSource& source, int accessor,
                                             const PrimitiveContext& context) {
    const std::string user = context.pointer + "/attributes/POSITION";
    auto count = accessorCount(source, accessor, user);
    if (!count) return tl::unexpected(count.error());
    const std::string pointer = "/accessors/" + std::to_string(accessor);
    if (*count > kMaxImportElements) {
        return fail(ErrorCode::limitExceeded,
                    std::to_string(*count) + " vertices are more than Sherd reads (" +
                        std::to_string(kMaxImportElements) + "); split the model",
                    source.where(pointer));
    }
    auto data = readFloats(source, accessor, user);
    if (!data) return tl::unexpected(data.error());
    if (data->components != 3) {
        return fail(ErrorCode::invalidData, "POSITION must have 3 components",
                    source.where(pointer));
    }
    for (size_t i = 0; i < data->values.size(); ++i) {
        if (std::isfinite(data->values[i])) continue;
        return fail(ErrorCode::invalidData,
                    "the position of vertex " + std::to_string(i / 3) +
                        " is not finite; repair the model in the modelling tool",
                    source.where(pointer));
    }
    std::vector<glm::vec3> positions(*count);
    if (*count > 0) std::memcpy(&positions[0].x, data->values.data(), *count * sizeof(glm::vec3));
    return positions;
}

Result<std::vector<uint32_t>> readVertexOrder(const GltfSource& source,
                                              const tinygltf::Primitive& primitive,
                                              size_t vertexCount, const PrimitiveContext& context) {
    if (primitive.indices < 0) {
        std::vector<uint32_t> all(vertexCount);
        std::iota(all.begin(), all.end(), 0U);
        return all;
    }
    auto vertices = readIndices(source, primitive.indices, context.pointer + "/indices");
    if (!vertices) return vertices;
    for (size_t i = 0; i < vertices->size(); ++i) {
        if ((*vertices)[i] < vertexCount) continue;
        return fail(ErrorCode::invalidData,
                    "index " + std::to_string(i) + " is " + std::to_string((*vertices)[i]) +
                        ", but there are " + std::to_string(vertexCount) + " vertices",
                    source.where("/accessors/" + std::to_string(primitive.indices)));
    }
    return vertices;
}

Result<void> refuseSkinned(const GltfSource& source, const tinygltf::Primitive& primitive,
                           const PrimitiveContext& context) {
    if (primitive.targets.empty() && !primitive.attributes.contains("JOINTS_0") &&
        !primitive.attributes.contains("WEIGHTS_0")) {
        return {};
    }
    return fail(ErrorCode::skinnedMesh,
                "the mesh is skinned or morphed and has no single shape to break; apply the "
                "pose in the modelling tool and export it as a static mesh",
                source.where(context.pointer));
}

Result<std::optional<MeshPart>> readPrimitive(const GltfSource& source,
                                              const tinygltf::Primitive& primitive,
                                              const PrimitiveContext& context) {
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        return fail(ErrorCode::invalidData, "the primitive's mode is not one glTF defines",
                    source.where(context.pointer));
    }
    if (primitive.mode == TINYGLTF_MODE_POINTS) {
        context.warnings->push_back(context.pointer + ": points were left out");
    }
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) return std::optional<MeshPart>();
    if (auto ok = refuseSkinned(source, primitive, context); !ok) {
        return tl::unexpected(ok.error());
    }
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
        context.warnings->push_back(context.pointer +
                                    ": a primitive without POSITION was left out");
        return std::optional<MeshPart>();
    }
    MeshPart part;
    part.material = primitive.material;
    auto positions = readPositions(source, position->second, context);
    if (!positions) return tl::unexpected(positions.error());
    part.positions = std::move(*positions);
    auto vertices = readVertexOrder(source, primitive, part.positions.size(), context);
    if (!vertices) return tl::unexpected(vertices.error());
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && vertices->size() % 3 != 0) {
        context.warnings->push_back(context.pointer +
                                    ": the last triangle is incomplete; it was dropped");
    }
    part.triangles = toTriangles(primitive.mode, *vertices);
    for (const auto& [semantic, accessor] : primitive.attributes) {
        if (semantic == "POSITION") continue;
        auto attribute = readAttribute(source, semantic, accessor, part.positions.size(), context);
        if (!attribute) return tl::unexpected(attribute.error());
        if (*attribute) part.attributes.push_back(std::move(**attribute));
    }
    return std::optional<MeshPart>(std::move(part));
}

}  // namespace sherd
