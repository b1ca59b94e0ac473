// SPDX-License-Identifier: MIT
#include "import/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "geometry/weld.h"

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;

const Attribute* find(const MeshPart& part, const std::string& semantic) {
    return findAttribute(part.attributes, semantic);
}

Attribute* find(MeshPart& part, const std::string& semantic) {
    return const_cast<Attribute*>(findAttribute(part.attributes, semantic));
}

/// The values of the vertices in `order`, in that order.
std::vector<float> gather(const Attribute& attribute, const std::vector<uint32_t>& order) {
    std::vector<float> out(order.size() * attribute.components);
    float* to = out.data();
    for (const uint32_t vertex : order) {
        const float* from = attribute.values.data() + size_t{vertex} * attribute.components;
        to = std::copy_n(from, attribute.components, to);
    }
    return out;
}

void dropUnusedVertices(MeshPart& part) {
    std::vector<uint32_t> id(part.positions.size(), 0);
    for (const Triangle& t : part.triangles) {
        for (const uint32_t v : t) id[v] = 1;
    }
    std::vector<uint32_t> kept;
    kept.reserve(id.size());
    for (uint32_t v = 0; v < id.size(); ++v) {
        if (id[v] == 0) continue;
        id[v] = static_cast<uint32_t>(kept.size());
        kept.push_back(v);
    }
    if (kept.size() == part.positions.size()) return;
    for (size_t i = 0; i < kept.size(); ++i) part.positions[i] = part.positions[kept[i]];
    part.positions.resize(kept.size());
    for (Attribute& attribute : part.attributes) attribute.values = gather(attribute, kept);
    for (Triangle& t : part.triangles) t = {id[t[0]], id[t[1]], id[t[2]]};
}

/// `matrix` times the first three components of every value, made unit length.
void turnDirections(Attribute& attribute, const glm::dmat3& matrix) {
    for (size_t i = 0; i + 2 < attribute.values.size(); i += attribute.components) {
        float* v = attribute.values.data() + i;
        const glm::dvec3 turned = matrix * glm::dvec3(v[0], v[1], v[2]);
        const double length = glm::length(turned);
        if (!(length > 0)) continue;
        for (int k = 0; k < 3; ++k) v[k] = static_cast<float>(turned[k] / length);
    }
}

/// The spacing of a grid far below what floats of the part's size resolve (2^-24 of it), and above
/// what doubles lose in moving it (some 2^-52). Rounding to it makes of 1e-17 the 0 it stands for:
/// nearest to zero floats would tell them apart, and corners of parts that meet would not be one.
double noiseGrid(const MeshPart& part) {
    double size = 0;
    for (int k = 0; k < 3; ++k) size = std::max(size, std::abs(part.offset[k]));
    for (const glm::vec3& p : part.positions) {
        const glm::dvec3 moved = part.linear * glm::dvec3(p);
        for (int k = 0; k < 3; ++k) size = std::max(size, std::abs(moved[k]));
    }
    return std::ldexp(1.0, std::ilogb(size) - 43);
}

/// Leaves every bit of a part that is in the object's frame already.
void applyPlacement(MeshPart& part) {
    const glm::dmat3& deform = part.linear;
    const bool turned = deform != glm::dmat3(1.0);
    if (!turned && part.offset == glm::dvec3(0.0)) return;
    const double grid = part.offset == glm::dvec3(0.0) ? 0 : noiseGrid(part);
    for (glm::vec3& p : part.positions) {
        glm::dvec3 moved = deform * glm::dvec3(p) + part.offset;
        if (grid > 0) moved = grid * glm::round(moved / grid);
        p = glm::vec3(moved);
    }
    if (!turned) return;
    if (Attribute* normal = find(part, "NORMAL")) {
        turnDirections(*normal, glm::transpose(glm::inverse(deform)));
    }
    Attribute* tangent = find(part, "TANGENT");
    if (tangent != nullptr) turnDirections(*tangent, deform);
    if (glm::determinant(deform) > 0) return;
    for (Triangle& t : part.triangles) std::swap(t[1], t[2]);
    if (tangent == nullptr) return;
    for (size_t i = 3; i < tangent->values.size(); i += 4) tangent->values[i] = -tangent->values[i];
}

glm::vec3 faceNormal(const std::vector<glm::vec3>& positions, const Triangle& t) {
    const glm::dvec3 a(positions[t[0]]);
    const glm::dvec3 n =
        glm::cross(glm::dvec3(positions[t[1]]) - a, glm::dvec3(positions[t[2]]) - a);
    const double length = glm::length(n);
    return length > 0 ? glm::vec3(n / length) : glm::vec3(0, 0, 1);
}

/// glTF: without normals a face is flat, and tangents are void. Every corner gets its own vertex.
void makeFlat(MeshPart& part, std::vector<uint32_t>& positionIds) {
    std::vector<uint32_t> order;
    order.reserve(3 * part.triangles.size());
    for (const Triangle& t : part.triangles) order.insert(order.end(), t.begin(), t.end());
    Attribute normal{"NORMAL", 3, {}};
    normal.values.reserve(3 * order.size());
    for (const Triangle& t : part.triangles) {
        const glm::vec3 n = faceNormal(part.positions, t);
        for (int k = 0; k < 3; ++k) normal.values.insert(normal.values.end(), {n.x, n.y, n.z});
    }
    std::erase_if(part.attributes, [](const Attribute& a) { return a.semantic == "TANGENT"; });
    for (Attribute& attribute : part.attributes) attribute.values = gather(attribute, order);
    part.attributes.push_back(std::move(normal));
    std::vector<uint32_t> ids(order.size());
    for (size_t i = 0; i < order.size(); ++i) ids[i] = positionIds[order[i]];
    positionIds = std::move(ids);
    for (size_t t = 0; t < part.triangles.size(); ++t) {
        const auto first = static_cast<uint32_t>(3 * t);
        part.triangles[t] = {first, first + 1, first + 2};
    }
}

bool isDirection(const float* v) {
    const double length = glm::length(glm::dvec3(v[0], v[1], v[2]));
    return std::isfinite(length) && length > 0;
}

/// Normals of no direction become that of a face around them. Returns how many.
size_t mendNormals(MeshPart& part) {
    Attribute& normal = *find(part, "NORMAL");
    size_t mended = 0;
    for (const Triangle& t : part.triangles) {
        for (const uint32_t v : t) {
            float* n = normal.values.data() + size_t{v} * 3;
            if (isDirection(n)) continue;
            const glm::vec3 flat = faceNormal(part.positions, t);
            std::copy_n(&flat.x, 3, n);
            ++mended;
        }
    }
    return mended;
}

float defaultValue(const std::string& semantic, uint32_t component) {
    if (semantic.starts_with("COLOR_")) return 1;
    if (semantic == "TANGENT") return component == 0 || component == 3 ? 1.0F : 0.0F;
    return 0;
}

/// Everything but positions and normals: what is not a number becomes the default.
size_t mendValues(MeshPart& part) {
    size_t mended = 0;
    for (Attribute& attribute : part.attributes) {
        for (size_t i = 0; i < attribute.values.size(); ++i) {
            if (std::isfinite(attribute.values[i])) continue;
            const auto component = static_cast<uint32_t>(i % attribute.components);
            attribute.values[i] = defaultValue(attribute.semantic, component);
            ++mended;
        }
    }
    return mended;
}

void mend(MeshPart& part, std::vector<std::string>& warnings) {
    if (find(part, "NORMAL") != nullptr) {
        const size_t normals = mendNormals(part);
        if (normals > 0) {
            warnings.push_back(std::to_string(normals) +
                               " normals had no direction and were taken from a face");
        }
    }
    const size_t values = mendValues(part);
    if (values > 0) {
        warnings.push_back(std::to_string(values) +
                           " attribute values were not finite and were set to their default");
    }
}

/// The attributes any part has, the widest form of each, empty.
std::vector<Attribute> unionOfAttributes(const std::vector<MeshPart>& parts) {
    std::vector<Attribute> all;
    for (const MeshPart& part : parts) {
        for (const Attribute& attribute : part.attributes) {
            auto* known = const_cast<Attribute*>(findAttribute(all, attribute.semantic));
            if (known == nullptr) {
                all.push_back({attribute.semantic, attribute.components, {}});
            } else {
                known->components = std::max(known->components, attribute.components);
            }
        }
    }
    std::sort(all.begin(), all.end(),
              [](const Attribute& a, const Attribute& b) { return a.semantic < b.semantic; });
    return all;
}

void append(const MeshPart& part, size_t vertexCount, Attribute& to,
            std::vector<std::string>& warnings) {
    const Attribute* from = find(part, to.semantic);
    if (from != nullptr && from->components == to.components) {
        to.values.insert(to.values.end(), from->values.begin(), from->values.end());
        return;
    }
    if (from == nullptr) {
        // All in one point of the UV set: no drawn line passes through such triangles.
        const bool uv = to.semantic.starts_with("TEXCOORD_");
        warnings.push_back("a primitive of material " + std::to_string(part.material) + " has no " +
                           to.semantic +
                           (uv ? ": lines drawn in that UV set do not cut its " +
                                     std::to_string(part.triangles.size()) + " triangles"
                               : "; it was given default values"));
    }
    for (size_t v = 0; v < vertexCount; ++v) {
        for (uint32_t k = 0; k < to.components; ++k) {
            const bool known = from != nullptr && k < from->components;
            to.values.push_back(known ? from->values[v * from->components + k]
                                      : defaultValue(to.semantic, k));
        }
    }
}

uint32_t materialSlot(SurfaceMesh& mesh, int32_t material) {
    const auto found = std::find(mesh.materials.begin(), mesh.materials.end(), material);
    const auto slot = static_cast<uint32_t>(found - mesh.materials.begin());
    if (found == mesh.materials.end()) mesh.materials.push_back(material);
    return slot;
}

}  // namespace

void joinParts(std::vector<MeshPart> parts, SurfaceMesh& mesh) {
    PositionWelder welder(mesh.positions);
    std::vector<std::vector<uint32_t>> positionIds(parts.size());
    for (size_t p = 0; p < parts.size(); ++p) {
        MeshPart& part = parts[p];
        dropUnusedVertices(part);
        applyPlacement(part);
        mend(part, mesh.warnings);
        positionIds[p] = welder.add(part.positions);
        if (find(part, "NORMAL") == nullptr) makeFlat(part, positionIds[p]);
    }

    mesh.attributes = unionOfAttributes(parts);
    uint32_t firstVertex = 0;
    for (size_t p = 0; p < parts.size(); ++p) {
        MeshPart& part = parts[p];
        const std::vector<uint32_t>& ids = positionIds[p];
        const uint32_t slot = materialSlot(mesh, part.material);
        mesh.triangleMaterials.insert(mesh.triangleMaterials.end(), part.triangles.size(), slot);
        for (const Triangle& t : part.triangles) {
            mesh.triangles.push_back({ids[t[0]], ids[t[1]], ids[t[2]]});
            mesh.corners.push_back({firstVertex + t[0], firstVertex + t[1], firstVertex + t[2]});
        }
        for (Attribute& to : mesh.attributes) append(part, ids.size(), to, mesh.warnings);
        firstVertex += static_cast<uint32_t>(ids.size());
        part = {};
    }
}

}  // namespace sherd
