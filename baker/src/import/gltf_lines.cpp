// SPDX-License-Identifier: MIT
#include "import/gltf_lines.h"

#include <algorithm>

#include "import/gltf_primitive.h"
#include "import/level_name.h"
#include "import/limits.h"
#include "import/node_choice.h"
#include "import/surface_lines.h"

namespace sherd {
namespace {

bool isLines(const tinygltf::Primitive& primitive) {
    return primitive.mode > TINYGLTF_MODE_POINTS && primitive.mode < TINYGLTF_MODE_TRIANGLES;
}

template <class Is>
bool anyPrimitive(const GltfSource& source, int mesh, const Is& is) {
    if (mesh < 0 || static_cast<size_t>(mesh) >= source.model.meshes.size()) return false;
    const auto& primitives = source.model.meshes[static_cast<size_t>(mesh)].primitives;
    return std::any_of(primitives.begin(), primitives.end(), is);
}

void addSegments(int mode, const std::vector<uint32_t>& vertices, uint32_t firstPoint,
                 std::vector<std::array<uint32_t, 2>>& ends) {
    const size_t n = vertices.size();
    const size_t step = mode == TINYGLTF_MODE_LINE ? 2 : 1;
    for (size_t i = 0; i + 1 < n; i += step) {
        ends.push_back({firstPoint + vertices[i], firstPoint + vertices[i + 1]});
    }
    // A loop of two points would run back over itself.
    if (mode == TINYGLTF_MODE_LINE_LOOP && n > 2) {
        ends.push_back({firstPoint + vertices.back(), firstPoint + vertices.front()});
    }
}

Result<void> addPrimitive(const GltfSource& source, const tinygltf::Primitive& primitive,
                          const PrimitiveContext& context, LineSegments& out) {
    if (auto ok = refuseSkinned(source, primitive, context); !ok) return ok;
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
        context.warnings->push_back(context.pointer + ": lines without POSITION were left out");
        return {};
    }
    auto positions = readPositions(source, position->second, context);
    if (!positions) return tl::unexpected(positions.error());
    auto vertices = readVertexOrder(source, primitive, positions->size(), context);
    if (!vertices) return tl::unexpected(vertices.error());
    if (out.points.size() + positions->size() > kMaxImportElements ||
        out.ends.size() + vertices->size() > kMaxImportElements) {
        return fail(ErrorCode::limitExceeded,
                    "the mesh has more than " + std::to_string(kMaxImportElements) +
                        " points of lines; split the model",
                    source.where(context.pointer));
    }
    if (primitive.mode == TINYGLTF_MODE_LINE && vertices->size() % 2 != 0) {
        context.warnings->push_back(context.pointer +
                                    ": the last line has one end only; it was dropped");
    }
    addSegments(primitive.mode, *vertices, static_cast<uint32_t>(out.points.size()), out.ends);
    out.points.insert(out.points.end(), positions->begin(), positions->end());
    return {};
}

}  // namespace

bool hasLines(const GltfSource& source, int mesh) {
    return anyPrimitive(source, mesh, isLines);
}

bool hasTriangles(const GltfSource& source, int mesh) {
    return anyPrimitive(source, mesh, [](const tinygltf::Primitive& primitive) {
        return primitive.mode >= TINYGLTF_MODE_TRIANGLES;
    });
}

Result<std::vector<FractureMap::SurfaceLine>> readNodeLines(const GltfSource& source, int node,
                                                            const NodeTransform& toScene,
                                                            std::vector<std::string>& warnings) {
    const tinygltf::Node& owner = source.model.nodes[static_cast<size_t>(node)];
    const tinygltf::Mesh& mesh = source.model.meshes[static_cast<size_t>(owner.mesh)];
    if (owner.skin >= 0) {
        return fail(ErrorCode::skinnedMesh,
                    "the lines are skinned and lie nowhere in particular; apply the pose in the "
                    "modelling tool",
                    source.where("/nodes/" + std::to_string(node) + "/skin"));
    }
    LineSegments segments;
    for (size_t i = 0; i < mesh.primitives.size(); ++i) {
        if (!isLines(mesh.primitives[i])) continue;
        const PrimitiveContext context{
            "/meshes/" + std::to_string(owner.mesh) + "/primitives/" + std::to_string(i),
            &warnings};
        auto added = addPrimitive(source, mesh.primitives[i], context, segments);
        if (!added) return tl::unexpected(added.error());
    }
    const LineChains chains = chainSegments(segments);
    const std::string label = labelOfNode(source, node);
    reportDropped(chains, label, warnings);
    auto level = levelInName(owner.name);
    if (!level) level = levelInName(mesh.name);
    std::vector<FractureMap::SurfaceLine> lines;
    addSurfaceLines(
        chains, label, level.value_or(1),
        [&](const glm::dvec3& p) {
            return toScene.rotation * (toScene.deform * p) + toScene.translation;
        },
        lines);
    return lines;
}

}  // namespace sherd
