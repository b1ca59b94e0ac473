// SPDX-License-Identifier: MIT
#include "appearance/hidden_mesh.h"

#include <glm/geometric.hpp>

#include "geometry/triangle.h"
#include "geometry/union_find.h"

namespace sherd {
namespace {

/// The sheet's vertices, ends of edges without length put together. Those that only touch, as the
/// sheets below two sides of a piece may, stay apart: they have normals of their own.
UnionFind meltedVertices(const HiddenSheet& sheet) {
    UnionFind vertices(sheet.points.size());
    for (const HiddenSheet::Triangle& t : sheet.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = t.v[k], b = t.v[nextCorner(static_cast<uint32_t>(k))];
            if (sheet.points[a] == sheet.points[b]) vertices.unite(a, b);
        }
    }
    return vertices;
}

}  // namespace

HiddenMesh hiddenMesh(const SurfaceMesh& mesh, const SplitSurface& surface,
                      const Components& components, const HiddenSheet& sheet,
                      std::span<const HiddenFace> faces) {
    HiddenMesh result;
    result.positions = surface.positions;
    result.skinVertices = static_cast<uint32_t>(surface.positions.size());
    result.positions.insert(result.positions.end(), sheet.points.begin(), sheet.points.end());
    result.faces.reserve(faces.size());
    UnionFind melted = meltedVertices(sheet);
    for (const HiddenFace& face : faces) {
        HiddenMesh::Face out{};
        for (size_t k = 0; k < 3; ++k) {
            const CornerRef ref = face.corners[k];
            const uint32_t v = vertexOf(surface, sheet, ref);
            out.v[k] = ref.hidden != 0 ? result.skinVertices + melted.find(v) : v;
        }
        if (out.v[0] == out.v[1] || out.v[1] == out.v[2] || out.v[2] == out.v[0]) continue;
        // All corners of a face hang from one outer triangle, unless it says another.
        const CornerRef any = face.corners[0];
        const uint32_t above = face.under != kNone ? face.under
                               : any.hidden != 0   ? sheet.triangles[any.corner / 3].parent
                                                   : any.corner / 3;
        out.leaf = face.leaf;
        out.exposedFrom = face.exposedFrom;
        out.fragment = components.at(face.exposedFrom, face.leaf);
        out.material = mesh.triangleMaterials[surface.triangles[above].source];
        out.wall = face.wall;
        result.faces.push_back(out);
    }
    return result;
}

void addHoleCaps(const SurfaceMesh& mesh, const SplitSurface& surface, const Components& components,
                 HiddenMesh& hidden) {
    for (uint32_t t = 0; t < surface.triangles.size() && mesh.capTriangles > 0; ++t) {
        const SplitTriangle& triangle = surface.triangles[t];
        if (!mesh.isCap(triangle.source)) continue;
        const uint32_t leaf = components.leaf[t];
        hidden.faces.push_back({triangle.v, leaf, 1, components.at(1, leaf),
                                mesh.triangleMaterials[triangle.source], true});
    }
}

FaceShapes faceShapes(const HiddenMesh& mesh) {
    FaceShapes shapes;
    shapes.normals.reserve(mesh.faces.size());
    shapes.areas.reserve(mesh.faces.size());
    for (const HiddenMesh::Face& face : mesh.faces) {
        const glm::dvec3 a = mesh.positions[face.v[0]];
        const glm::dvec3 n = glm::cross(glm::dvec3(mesh.positions[face.v[1]]) - a,
                                        glm::dvec3(mesh.positions[face.v[2]]) - a);
        const double length = glm::length(n);
        shapes.normals.push_back(length > 0 ? n / length : glm::dvec3(0.0));
        shapes.areas.push_back(length > 0 ? 0.5 * length : 0);
    }
    return shapes;
}

}  // namespace sherd
