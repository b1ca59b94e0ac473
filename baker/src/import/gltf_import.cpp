// SPDX-License-Identifier: MIT
#include "import/gltf_import.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "import/gltf_lines.h"
#include "import/gltf_primitive.h"
#include "import/limits.h"
#include "import/line_nodes.h"
#include "import/node_choice.h"
#include "import/node_transforms.h"
#include "import/scene_objects.h"

namespace sherd {
namespace {

class GltfImporter {
  public:
    GltfImporter(const GltfSource& source, const std::vector<int>& parents,
                 const ImportOptions& options, const NodeRecipes& recipes)
        : source_(source),
          parents_(parents),
          options_(options),
          recipes_(recipes),
          transforms_(source, parents),
          objects_(source, lineNodes_, recipes, options) {}

    Result<std::vector<SurfaceMesh>> run() {
        auto chosen = chooseNodes(source_, parents_, options_);
        if (!chosen) return tl::unexpected(chosen.error());
        // A scene that makes no sense is no reason to refuse nodes chosen by hand.
        const auto scene = nodesOfScene(source_, parents_);
        lineNodes_ = findLineNodes(source_, parents_, scene ? *scene : std::vector<int>());
        warnings_ = recipes_.warnings;
        leaveWhole(*chosen);
        for (const int index : *chosen) {
            if (auto ok = addNode(index); !ok) return tl::unexpected(ok.error());
        }
        std::vector<SurfaceMesh> meshes;
        for (SceneObject& object : objects_.all()) {
            auto mesh = makeMesh(object);
            if (mesh) {
                meshes.push_back(std::move(*mesh));
            } else if (mesh.error().code == ErrorCode::noTriangles && options_.nodes.empty()) {
                skip(object.node);
            } else {
                return tl::unexpected(mesh.error());
            }
        }
        if (meshes.empty()) return noTriangles(skipped_);
        if (auto ok = addStrayLines(meshes); !ok) return tl::unexpected(ok.error());
        auto& told = meshes.front().warnings;
        told.insert(told.end(), warnings_.begin(), warnings_.end());
        return meshes;
    }

  private:
    const tinygltf::Node& node(int index) const {
        return source_.model.nodes[static_cast<size_t>(index)];
    }

    bool isLineNode(int index) const {
        return hasLines(source_, node(index).mesh) && !hasTriangles(source_, node(index).mesh);
    }

    tl::unexpected<Error> noTriangles(int index) const {
        return fail(
            ErrorCode::noTriangles,
            "the mesh has no triangles; choose another node with --node: " + listMeshNodes(source_),
            source_.where("/meshes/" + std::to_string(node(index).mesh)));
    }

    /// Where objects bring recipes, the others are not meant to break.
    void leaveWhole(std::vector<int>& chosen) {
        const bool all = recipes_.recipes.empty() || options_.wholeScene || options_.join;
        if (all || !options_.nodes.empty()) return;
        std::string names;
        size_t count = 0;
        std::erase_if(chosen, [&](int index) {
            const bool drawnOn =
                hasLines(source_, node(index).mesh) || lineNodes_.below.count(index) > 0;
            if (recipes_.of(index) >= 0 || drawnOn) return false;
            if (++count <= 10) names += (names.empty() ? "" : ", ") + labelOfNode(source_, index);
            return true;
        });
        if (count == 0) return;
        warnings_.push_back("left whole, having no recipe: " + names +
                            (count > 10 ? " and " + std::to_string(count - 10) + " more" : ""));
    }

    /// Nobody asked for this node in particular: lines and points may stand in a scene.
    void skip(int index) {
        skipped_ = index;
        if (isLineNode(index)) return;
        warnings_.push_back("node " + std::to_string(index) + " has no triangles; left out");
    }

    /// Checks the node and sorts it in.
    Result<void> addNode(int index) {
        const std::string pointer = "/nodes/" + std::to_string(index);
        if (static_cast<size_t>(node(index).mesh) >= source_.model.meshes.size()) {
            return fail(ErrorCode::invalidData, "the node's mesh does not exist",
                        source_.where(pointer + "/mesh"));
        }
        if (!hasTriangles(source_, node(index).mesh)) {
            if (!options_.nodes.empty()) return noTriangles(index);
            skip(index);
            return {};
        }
        if (node(index).skin >= 0) {
            return fail(ErrorCode::skinnedMesh,
                        "the node is skinned and has no single shape to break; apply the pose in "
                        "the modelling tool and export it as a static mesh",
                        source_.where(pointer + "/skin"));
        }
        auto transform = transforms_.of(index);
        if (!transform) return tl::unexpected(transform.error());
        objects_.add(index, *transform);
        return {};
    }

    Result<void> addParts(int index, const Placement& placement, std::vector<MeshPart>& parts,
                          std::vector<std::string>& warnings) const {
        const int meshIndex = node(index).mesh;
        const tinygltf::Mesh& mesh = source_.model.meshes[static_cast<size_t>(meshIndex)];
        uint64_t vertices = 0;
        uint64_t triangles = 0;
        for (const MeshPart& part : parts) {
            vertices += part.positions.size();
            triangles += part.triangles.size();
        }
        for (size_t i = 0; i < mesh.primitives.size(); ++i) {
            const PrimitiveContext context{
                "/meshes/" + std::to_string(meshIndex) + "/primitives/" + std::to_string(i),
                &warnings};
            auto part = readPrimitive(source_, mesh.primitives[i], context);
            if (!part) return tl::unexpected(part.error());
            if (!*part || (*part)->triangles.empty()) continue;
            vertices += (*part)->positions.size();
            triangles += (*part)->triangles.size();
            if (vertices > kMaxImportElements || triangles > kMaxImportElements) {
                return fail(ErrorCode::limitExceeded,
                            "the mesh has more than " + std::to_string(kMaxImportElements) +
                                " vertices or triangles; split the model",
                            source_.where(context.pointer));
            }
            if ((*part)->material >= static_cast<int32_t>(source_.materialCount)) {
                return fail(ErrorCode::invalidData,
                            "material " + std::to_string((*part)->material) + " does not exist",
                            source_.where("/meshes/" + std::to_string(meshIndex)));
            }
            (*part)->linear = placement.linear;
            (*part)->offset = placement.offset;
            parts.push_back(std::move(**part));
        }
        return {};
    }

    Result<std::vector<MeshPart>> readParts(const SceneObject& object, SurfaceMesh& mesh) {
        std::vector<MeshPart> parts;
        if (auto ok = addParts(object.node, {object.transform.deform, {}}, parts, mesh.warnings);
            !ok) {
            return tl::unexpected(ok.error());
        }
        for (const int joined : object.joined) {
            auto transform = transforms_.of(joined);
            if (!transform) return tl::unexpected(transform.error());
            const Placement placement = relativeTo(object.transform, *transform);
            if (auto ok = addParts(joined, placement, parts, mesh.warnings); !ok) {
                return tl::unexpected(ok.error());
            }
        }
        if (parts.empty()) return noTriangles(object.node);
        return parts;
    }

    Result<SurfaceMesh> makeMesh(SceneObject& object) {
        SurfaceMesh mesh;
        mesh.node = object.node;
        mesh.mesh = node(object.node).mesh;
        mesh.name = node(object.node).name;
        if (mesh.name.empty())
            mesh.name = source_.model.meshes[static_cast<size_t>(mesh.mesh)].name;
        if (mesh.name.empty()) mesh.name = "node " + std::to_string(object.node);
        mesh.restPose.translation = glm::vec3(object.transform.translation);
        mesh.restPose.rotation = glm::quat(object.transform.rotation);
        mesh.sameNodes.assign(object.same.begin(), object.same.end());
        mesh.joinedNodes.assign(object.joined.begin(), object.joined.end());
        mesh.warnings = std::move(object.warnings);
        auto parts = readParts(object, mesh);
        if (!parts) return tl::unexpected(parts.error());
        joinParts(std::move(*parts), mesh);
        for (const glm::vec3& p : mesh.positions) {
            const float sum = p.x + p.y + p.z;
            if (std::abs(sum) <= std::numeric_limits<float>::max()) continue;
            return fail(ErrorCode::invalidData, "positions overflow under the node's transform",
                        source_.where("/nodes/" + std::to_string(object.node)));
        }
        const std::string uv = "TEXCOORD_" + std::to_string(options_.uvSet);
        if (findAttribute(mesh.attributes, uv) != nullptr) mesh.uvSemantic = uv;
        placeTextures(source_.pictures, mesh);
        if (auto ok = addObjectLines(object, mesh); !ok) return tl::unexpected(ok.error());
        return mesh;
    }

    Result<void> addLines(int index, SurfaceMesh& mesh) {
        if (!hasLines(source_, node(index).mesh)) return {};
        auto transform = transforms_.of(index);
        if (!transform) return tl::unexpected(transform.error());
        auto lines = readNodeLines(source_, index, *transform, mesh.warnings);
        if (!lines) return tl::unexpected(lines.error());
        mesh.lines.insert(mesh.lines.end(), std::make_move_iterator(lines->begin()),
                          std::make_move_iterator(lines->end()));
        return {};
    }

    Result<void> addObjectLines(const SceneObject& object, SurfaceMesh& mesh) {
        std::vector<int> nodes{object.node};
        nodes.insert(nodes.end(), object.joined.begin(), object.joined.end());
        for (const int index : nodes) {
            if (auto ok = addLines(index, mesh); !ok) return ok;
            const auto below = lineNodes_.below.find(index);
            if (below == lineNodes_.below.end()) continue;
            for (const int line : below->second) {
                if (auto ok = addLines(line, mesh); !ok) return ok;
            }
        }
        return {};
    }

    /// Lines that are no object's child can mean only the one object there is.
    Result<void> addStrayLines(std::vector<SurfaceMesh>& meshes) {
        for (const int index : lineNodes_.stray) {
            if (meshes.size() == 1) {
                if (auto ok = addLines(index, meshes.front()); !ok) return ok;
            } else {
                warnings_.push_back("the lines of " + labelOfNode(source_, index) +
                                    " were left out: they could belong to any of " +
                                    std::to_string(meshes.size()) +
                                    " objects; parent them to the one they break");
            }
        }
        return {};
    }

    const GltfSource& source_;
    const std::vector<int>& parents_;
    const ImportOptions& options_;
    const NodeRecipes& recipes_;
    GlobalTransforms transforms_;
    LineNodes lineNodes_;
    SceneObjects objects_;
    std::vector<std::string> warnings_;
    int skipped_ = -1;  ///< the last node left out
};

}  // namespace

Result<std::vector<SurfaceMesh>> importGltf(const GltfDocument& document, const std::string& name,
                                            const ImportOptions& options,
                                            const NodeRecipes& recipes) {
    auto source = parseGltfSource(document, name);
    if (!source) return tl::unexpected(source.error());
    auto parents = nodeParents(*source);
    if (!parents) return tl::unexpected(parents.error());
    return GltfImporter(*source, *parents, options, recipes).run();
}

}  // namespace sherd
