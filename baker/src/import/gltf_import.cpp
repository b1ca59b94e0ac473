// SPDX-License-Identifier: MIT
#include "import/gltf_import.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

#include "import/gltf_primitive.h"
#include "import/limits.h"
#include "import/node_transforms.h"

namespace sherd {
namespace {

bool hasMesh(const GltfSource& source, int node) {
    return source.model.nodes[static_cast<size_t>(node)].mesh >= 0;
}

/// Nodes of the default scene, or of scene 0, or all when there are no scenes; ascending.
Result<std::vector<int>> nodesOfScene(const GltfSource& source, const std::vector<int>& parents) {
    const auto& model = source.model;
    std::vector<int> nodes;
    if (model.scenes.empty()) {
        for (size_t i = 0; i < parents.size(); ++i) nodes.push_back(static_cast<int>(i));
        return nodes;
    }
    const size_t scene = model.defaultScene < 0 ? 0 : static_cast<size_t>(model.defaultScene);
    if (scene >= model.scenes.size()) {
        return fail(ErrorCode::invalidData, "the default scene does not exist",
                    source.where("/scene"));
    }
    std::vector<bool> seen(parents.size(), false);
    for (const int root : model.scenes[scene].nodes) {
        if (root < 0 || static_cast<size_t>(root) >= parents.size()) {
            return fail(ErrorCode::invalidData, "the scene names a node that does not exist",
                        source.where("/scenes/" + std::to_string(scene) + "/nodes"));
        }
        if (!seen[static_cast<size_t>(root)]) nodes.push_back(root);
        seen[static_cast<size_t>(root)] = true;
    }
    for (size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : model.nodes[static_cast<size_t>(nodes[i])].children) {
            if (!seen[static_cast<size_t>(child)]) nodes.push_back(child);
            seen[static_cast<size_t>(child)] = true;
        }
    }
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

std::string listMeshNodes(const GltfSource& source) {
    constexpr int kMost = 40;
    std::string list;
    int count = 0;
    for (size_t i = 0; i < source.model.nodes.size(); ++i) {
        if (!hasMesh(source, static_cast<int>(i)) || ++count > kMost) continue;
        list += (list.empty() ? "" : ", ") + std::to_string(i);
        const std::string& name = source.model.nodes[i].name;
        if (!name.empty()) list += " \"" + name + "\"";
    }
    if (count > kMost) list += " and " + std::to_string(count - kMost) + " more";
    return list.empty() ? "none" : list;
}

/// Mesh nodes of that name; failing that, the node of that index.
std::vector<int> nodesNamed(const GltfSource& source, const std::string& wanted) {
    const auto& nodes = source.model.nodes;
    std::vector<int> found;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].name == wanted && hasMesh(source, static_cast<int>(i))) {
            found.push_back(static_cast<int>(i));
        }
    }
    if (!found.empty()) return found;
    uint32_t index = 0;
    const char* end = wanted.data() + wanted.size();
    const auto [stop, error] = std::from_chars(wanted.data(), end, index);
    if (error == std::errc() && stop == end && index < nodes.size() &&
        hasMesh(source, static_cast<int>(index))) {
        found.push_back(static_cast<int>(index));
    }
    return found;
}

Result<std::vector<int>> chooseNodes(const GltfSource& source, const std::vector<int>& parents,
                                     const ImportOptions& options) {
    std::vector<int> chosen;
    for (const std::string& wanted : options.nodes) {
        const std::vector<int> found = nodesNamed(source, wanted);
        if (found.empty()) {
            return fail(
                ErrorCode::badArgument,
                "no mesh node is called \"" + wanted + "\"; the file has: " + listMeshNodes(source),
                source.where("/nodes"));
        }
        for (const int node : found) {
            if (std::find(chosen.begin(), chosen.end(), node) == chosen.end()) {
                chosen.push_back(node);
            }
        }
    }
    if (!options.nodes.empty()) return chosen;
    auto nodes = nodesOfScene(source, parents);
    if (!nodes) return nodes;
    std::copy_if(nodes->begin(), nodes->end(), std::back_inserter(chosen),
                 [&](int node) { return hasMesh(source, node); });
    if (chosen.empty()) {
        return fail(ErrorCode::noTriangles,
                    "the scene shows no mesh; mesh nodes of the file: " + listMeshNodes(source),
                    source.where("/scenes"));
    }
    return chosen;
}

Result<std::vector<MeshPart>> readParts(const GltfSource& source, int meshIndex,
                                        std::vector<std::string>& warnings) {
    const tinygltf::Mesh& mesh = source.model.meshes[static_cast<size_t>(meshIndex)];
    std::vector<MeshPart> parts;
    uint64_t vertices = 0;
    uint64_t triangles = 0;
    for (size_t i = 0; i < mesh.primitives.size(); ++i) {
        const PrimitiveContext context{
            "/meshes/" + std::to_string(meshIndex) + "/primitives/" + std::to_string(i), &warnings};
        auto part = readPrimitive(source, mesh.primitives[i], context);
        if (!part) return tl::unexpected(part.error());
        if (!*part || (*part)->triangles.empty()) continue;
        vertices += (*part)->positions.size();
        triangles += (*part)->triangles.size();
        if (vertices > kMaxImportElements || triangles > kMaxImportElements) {
            return fail(ErrorCode::limitExceeded,
                        "the mesh has more than " + std::to_string(kMaxImportElements) +
                            " vertices or triangles; split the model",
                        source.where(context.pointer));
        }
        parts.push_back(std::move(**part));
    }
    return parts;
}

Result<SurfaceMesh> importNode(const GltfSource& source, const std::vector<int>& parents, int index,
                               uint32_t uvSet) {
    const tinygltf::Node& node = source.model.nodes[static_cast<size_t>(index)];
    const std::string pointer = "/nodes/" + std::to_string(index);
    if (static_cast<size_t>(node.mesh) >= source.model.meshes.size()) {
        return fail(ErrorCode::invalidData, "the node's mesh does not exist",
                    source.where(pointer + "/mesh"));
    }
    if (node.skin >= 0) {
        return fail(ErrorCode::skinnedMesh,
                    "the node is skinned and has no single shape to break; apply the pose in the "
                    "modelling tool and export it as a static mesh",
                    source.where(pointer + "/skin"));
    }
    SurfaceMesh mesh;
    mesh.node = index;
    mesh.mesh = node.mesh;
    mesh.name = node.name;
    if (mesh.name.empty()) mesh.name = source.model.meshes[static_cast<size_t>(node.mesh)].name;
    auto transform = globalTransform(source, parents, index);
    if (!transform) return tl::unexpected(transform.error());
    mesh.restPose.translation = glm::vec3(transform->translation);
    mesh.restPose.rotation = glm::quat(transform->rotation);

    auto parts = readParts(source, node.mesh, mesh.warnings);
    if (!parts) return tl::unexpected(parts.error());
    if (parts->empty()) {
        return fail(
            ErrorCode::noTriangles,
            "the mesh has no triangles; choose another node with --node: " + listMeshNodes(source),
            source.where("/meshes/" + std::to_string(node.mesh)));
    }
    joinParts(std::move(*parts), transform->deform, mesh);
    for (const glm::vec3& p : mesh.positions) {
        const float sum = p.x + p.y + p.z;
        if (std::abs(sum) <= std::numeric_limits<float>::max()) continue;
        return fail(ErrorCode::invalidData, "positions overflow under the node's transform",
                    source.where(pointer));
    }
    const std::string uv = "TEXCOORD_" + std::to_string(uvSet);
    if (findAttribute(mesh.attributes, uv) != nullptr) mesh.uvSemantic = uv;
    return mesh;
}

Result<void> checkMaterials(const GltfSource& source, const SurfaceMesh& mesh) {
    for (const int32_t material : mesh.materials) {
        if (material < static_cast<int32_t>(source.materialCount)) continue;
        return fail(ErrorCode::invalidData,
                    "material " + std::to_string(material) + " does not exist",
                    source.where("/meshes/" + std::to_string(mesh.mesh)));
    }
    return {};
}

}  // namespace

Result<std::vector<SurfaceMesh>> importGltf(const GltfDocument& document, const std::string& name,
                                            const ImportOptions& options) {
    auto source = parseGltfSource(document, name);
    if (!source) return tl::unexpected(source.error());
    auto parents = nodeParents(*source);
    if (!parents) return tl::unexpected(parents.error());
    auto chosen = chooseNodes(*source, *parents, options);
    if (!chosen) return tl::unexpected(chosen.error());
    std::vector<SurfaceMesh> meshes;
    std::vector<std::string> warnings;
    for (const int node : *chosen) {
        auto mesh = importNode(*source, *parents, node, options.uvSet);
        if (!mesh) {
            // Nobody asked for this one in particular: lines and points may stand in a scene.
            const bool skip = mesh.error().code == ErrorCode::noTriangles && options.nodes.empty();
            if (!skip || (meshes.empty() && node == chosen->back())) {
                return tl::unexpected(mesh.error());
            }
            warnings.push_back("node " + std::to_string(node) + " has no triangles; left out");
            continue;
        }
        if (auto ok = checkMaterials(*source, *mesh); !ok) return tl::unexpected(ok.error());
        meshes.push_back(std::move(*mesh));
    }
    auto& told = meshes.front().warnings;
    told.insert(told.end(), warnings.begin(), warnings.end());
    return meshes;
}

}  // namespace sherd
