// SPDX-License-Identifier: MIT
#include "assembly/hidden_vertices.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace sherd {
namespace {

/// Twice the area times the normal.
glm::dvec3 areaNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

int mainAxis(const glm::dvec3& n) {
    const glm::dvec3 a = glm::abs(n);
    if (a.x >= a.y && a.x >= a.z) return 0;
    return a.y >= a.z ? 1 : 2;
}

glm::vec3 unit(const glm::dvec3& n, int axis) {
    const double length = glm::length(n);
    glm::dvec3 fallback(0.0);
    fallback[axis] = 1;
    return length > 0 ? n / length : fallback;
}

}  // namespace

HiddenVertices::HiddenVertices(const AssemblyInput& input, FractureGeometry& out)
    : in_(input),
      out_(out),
      sheetFaces_(input.components.leafCount),
      sheet_(input.hidden.positions.size()) {
    for (uint32_t f = 0; f < in_.hidden.faces.size(); ++f) {
        if (!in_.hidden.faces[f].wall) sheetFaces_[in_.hidden.faces[f].leaf].push_back(f);
    }
}

/// Smooth normals of a leaf's sheet, weighted by area.
void HiddenVertices::beginSheet(uint32_t leaf) {
    sheetLeaf_ = leaf;
    for (const uint32_t f : sheetFaces_[leaf]) {
        const auto& v = in_.hidden.faces[f].v;
        const auto& p = in_.hidden.positions;
        const glm::dvec3 n = areaNormal(p[v[0]], p[v[1]], p[v[2]]);
        for (const uint32_t corner : v) {
            SheetVertex& vertex = sheet_[corner];
            if (vertex.leaf != leaf) vertex = {leaf, glm::dvec3(0.0), {kNone, kNone, kNone}};
            vertex.normal += n;
        }
    }
}

std::array<uint32_t, 3> HiddenVertices::vertices(const HiddenMesh::Face& face) {
    const auto& positions = in_.hidden.positions;
    const std::array<glm::vec3, 3> p{positions[face.v[0]], positions[face.v[1]],
                                     positions[face.v[2]]};
    const glm::dvec3 flat = areaNormal(p[0], p[1], p[2]);
    const int axis = mainAxis(flat);
    if (!face.wall && face.leaf != sheetLeaf_) beginSheet(face.leaf);
    std::array<uint32_t, 3> result{};
    for (size_t k = 0; k < 3; ++k) {
        if (face.wall) {
            result[k] = newVertex(p[k], unit(flat, axis), axis);
            continue;
        }
        SheetVertex& vertex = sheet_[face.v[k]];
        uint32_t& known = vertex.ofAxis[static_cast<size_t>(axis)];
        if (known == kNone) known = newVertex(p[k], unit(vertex.normal, axis), axis);
        result[k] = known;
    }
    return result;
}

uint32_t HiddenVertices::newVertex(const glm::vec3& position, const glm::vec3& normal, int axis) {
    const int uAxis = axis == 0 ? 2 : 0;
    const int vAxis = axis == 1 ? 2 : 1;
    glm::dvec3 tangent(0.0);
    tangent[uAxis] = 1;
    tangent -= glm::dvec3(normal) * glm::dot(glm::dvec3(normal), tangent);
    const glm::vec3 t = unit(tangent, uAxis);
    for (Attribute& attribute : out_.attributes) {
        std::vector<float>& values = attribute.values;
        if (attribute.semantic == "NORMAL") {
            values.insert(values.end(), {normal.x, normal.y, normal.z});
        } else if (attribute.semantic == "TANGENT") {
            values.insert(values.end(), {t.x, t.y, t.z, 1.0F});
        } else if (attribute.semantic.starts_with("TEXCOORD_")) {
            values.push_back(static_cast<float>(position[uAxis] / in_.uvMetresPerTile));
            values.push_back(static_cast<float>(-position[vAxis] / in_.uvMetresPerTile));
        } else {
            const float value = attribute.semantic.starts_with("COLOR_") ? 1.0F : 0.0F;
            values.insert(values.end(), attribute.components, value);
        }
    }
    out_.positions.push_back(position);
    return static_cast<uint32_t>(out_.positions.size() - 1);
}

}  // namespace sherd
