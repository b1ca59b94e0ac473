// SPDX-License-Identifier: MIT
#include "import/obj_import.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "import/mesh_builder.h"
#include "import/obj_document.h"
#include "import/obj_lines.h"
#include "import/obj_materials.h"
#include "import/obj_parse.h"
#include "import/polygon_triangulation.h"
#include "import/unit_scale.h"

namespace sherd {
namespace {

/// Ear clipping is quadratic: beyond this a single face is no sane model.
constexpr uint32_t kMaxFaceCorners = 4096;

/// Faces that agree in what they have can share a primitive.
struct PartKey {
    uint32_t material;
    bool hasUv;
    bool hasNormal;
    bool operator<(const PartKey& o) const {
        return std::tie(material, hasUv, hasNormal) < std::tie(o.material, o.hasUv, o.hasNormal);
    }
};

PartKey keyOf(const ObjFile& file, const ObjFile::Face& face) {
    PartKey key{face.material, true, true};
    for (uint32_t c = 0; c < face.corners.count; ++c) {
        const ObjFile::Corner& corner = file.corners[face.corners.first + c];
        key.hasUv = key.hasUv && corner.uv != ObjFile::kNone;
        key.hasNormal = key.hasNormal && corner.normal != ObjFile::kNone;
    }
    return key;
}

/// Turns (position, uv, normal) triples into vertices: each position keeps a chain of its own.
class PartMaker {
  public:
    explicit PartMaker(const ObjFile& file) : file_(file), head_(file.positions.size(), kNone) {}

    MeshPart make(const PartKey& key, const std::vector<uint32_t>& faces) {
        vertices_.clear();
        next_.clear();
        MeshPart part;
        part.material = key.material == ObjFile::kNone ? -1 : static_cast<int32_t>(key.material);
        for (const uint32_t face : faces) addFace(key, file_.faces[face], part);
        for (const ObjFile::Corner& corner : vertices_) head_[corner.position] = kNone;
        fillAttributes(key, part);
        return part;
    }

  private:
    static constexpr uint32_t kNone = UINT32_MAX;

    uint32_t vertex(const PartKey& key, ObjFile::Corner corner) {
        if (!key.hasUv) corner.uv = ObjFile::kNone;
        if (!key.hasNormal) corner.normal = ObjFile::kNone;
        for (uint32_t v = head_[corner.position]; v != kNone; v = next_[v]) {
            if (vertices_[v].uv == corner.uv && vertices_[v].normal == corner.normal) return v;
        }
        const auto made = static_cast<uint32_t>(vertices_.size());
        vertices_.push_back(corner);
        next_.push_back(head_[corner.position]);
        head_[corner.position] = made;
        return made;
    }

    void addFace(const PartKey& key, const ObjFile::Face& face, MeshPart& part) {
        const uint32_t first = face.corners.first;
        if (face.corners.count == 3) {
            const uint32_t a = vertex(key, file_.corners[first]);
            const uint32_t b = vertex(key, file_.corners[first + 1]);
            const uint32_t c = vertex(key, file_.corners[first + 2]);
            part.triangles.push_back({a, b, c});
            return;
        }
        polygon_.clear();
        ids_.clear();
        for (uint32_t c = 0; c < face.corners.count; ++c) {
            const ObjFile::Corner& corner = file_.corners[first + c];
            polygon_.push_back(file_.positions[corner.position]);
            ids_.push_back(vertex(key, corner));
        }
        for (const auto& t : triangulatePolygon(polygon_)) {
            part.triangles.push_back({ids_[t[0]], ids_[t[1]], ids_[t[2]]});
        }
    }

    void fillAttributes(const PartKey& key, MeshPart& part) const {
        Attribute uv{"TEXCOORD_0", 2, {}};
        Attribute normal{"NORMAL", 3, {}};
        Attribute color{"COLOR_0", 4, {}};
        part.positions.reserve(vertices_.size());
        for (const ObjFile::Corner& corner : vertices_) {
            part.positions.push_back(file_.positions[corner.position]);
            if (key.hasUv) {
                // OBJ counts v upwards, glTF and Sherd downwards.
                const glm::vec2 t = file_.uvs[corner.uv];
                uv.values.insert(uv.values.end(), {t.x, 1.0F - t.y});
            }
            if (key.hasNormal) {
                const glm::dvec3 n(file_.normals[corner.normal]);
                const double length = glm::length(n);
                const glm::vec3 unit(length > 0 ? n / length : n);
                normal.values.insert(normal.values.end(), {unit.x, unit.y, unit.z});
            }
            if (!file_.colors.empty()) {
                const glm::vec3 c = file_.colors[corner.position];
                color.values.insert(color.values.end(), {c.r, c.g, c.b, 1.0F});
            }
        }
        if (key.hasUv) part.attributes.push_back(std::move(uv));
        if (key.hasNormal) part.attributes.push_back(std::move(normal));
        if (!file_.colors.empty()) part.attributes.push_back(std::move(color));
    }

    const ObjFile& file_;
    std::vector<uint32_t> head_;  ///< per position: its latest vertex
    std::vector<uint32_t> next_;  ///< per vertex: the one before at the same position
    std::vector<ObjFile::Corner> vertices_;
    std::vector<glm::vec3> polygon_;
    std::vector<uint32_t> ids_;
};

Result<std::vector<MeshPart>> makeParts(const ObjFile& file, const std::string& name) {
    std::map<PartKey, std::vector<uint32_t>> faces;
    for (uint32_t f = 0; f < file.faces.size(); ++f) {
        if (file.faces[f].corners.count > kMaxFaceCorners) {
            return fail(ErrorCode::limitExceeded,
                        "a face has more than " + std::to_string(kMaxFaceCorners) +
                            " corners; triangulate it in the modelling tool",
                        name + ":" + std::to_string(file.faces[f].line));
        }
        faces[keyOf(file, file.faces[f])].push_back(f);
    }
    PartMaker maker(file);
    std::vector<MeshPart> parts;
    parts.reserve(faces.size());
    for (const auto& [key, list] : faces) parts.push_back(maker.make(key, list));
    return parts;
}

/// As the node above scales it.
void scale(SurfaceMesh& mesh, double metres) {
    for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(p) * metres);
    for (FractureMap::SurfaceLine& line : mesh.lines)
        for (SurfacePlace& place : line.places) place.point *= metres;
}

}  // namespace

Result<Model> importObj(std::string_view text, const std::filesystem::path& path,
                        const ImportOptions& options) {
    const std::string name = path.filename().string();
    if (!options.nodes.empty()) {
        return fail(ErrorCode::badArgument, "an OBJ file is one object: it has no nodes to choose",
                    name);
    }
    auto file = parseObj(text, name);
    if (!file) return tl::unexpected(file.error());
    if (file->faces.empty()) return fail(ErrorCode::noTriangles, "the file has no faces", name);
    auto parts = makeParts(*file, name);
    if (!parts) return tl::unexpected(parts.error());

    Model model;
    SurfaceMesh& mesh = model.meshes.emplace_back();
    mesh.node = 0;
    mesh.mesh = 0;
    mesh.name = file->objectName.empty() ? path.stem().string() : file->objectName;
    mesh.warnings = std::move(file->warnings);
    mesh.lines = makeObjLines(*file, name, mesh.warnings);
    joinParts(std::move(*parts), mesh);
    const std::string uv = "TEXCOORD_" + std::to_string(options.uvSet);
    if (findAttribute(mesh.attributes, uv) != nullptr) mesh.uvSemantic = uv;
    const auto materials = loadObjMaterials(file->materialNames, file->materialFiles,
                                            path.parent_path(), mesh.warnings);
    model.document = makeDocument(mesh, materials);
    if (options.unitScale) {
        if (auto ok = scaleScenes(model.document, name, *options.unitScale); !ok)
            return tl::unexpected(ok.error());
        scale(mesh, *options.unitScale);
    }
    model.recipeOfMesh.push_back(-1);
    return model;
}

}  // namespace sherd
