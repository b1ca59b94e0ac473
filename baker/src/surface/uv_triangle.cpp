// SPDX-License-Identifier: MIT
#include "surface/uv_triangle.h"

#include <optional>
#include <string>

#include "geometry/triangle.h"

namespace sherd {

UvKind classify(const std::array<GridPoint, 3>& c) {
    const int side = signOf(orientation(c[0], c[1], c[2]));
    if (side > 0) return UvKind::regular;
    if (side < 0) return UvKind::mirrored;
    return c[0] == c[1] && c[1] == c[2] ? UvKind::point : UvKind::collinear;
}

Result<std::vector<UvTriangle>> snapUv(const SurfaceMesh& mesh) {
    const Attribute* uv = findAttribute(mesh.attributes, mesh.uvSemantic);
    if (uv == nullptr || uv->components != 2) {
        return fail(
            ErrorCode::noTextureCoordinates,
            "the mesh has no texture coordinates, and fracture lines are drawn in UV; unwrap "
            "it in a modelling tool first",
            "mesh \"" + mesh.name + "\"");
    }
    std::vector<const glm::dmat3*> moved(mesh.placements.size(), nullptr);  // per material
    for (size_t slot = 0; slot < moved.size(); ++slot) {
        const glm::dmat3& transform = mesh.placements[slot].transform;
        if (transform != glm::dmat3(1.0)) moved[slot] = &transform;
    }
    std::vector<UvTriangle> triangles(mesh.corners.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
        const uint32_t slot = moved.empty() ? 0 : mesh.triangleMaterials[t];
        const glm::dmat3* transform = slot < moved.size() ? moved[slot] : nullptr;
        for (size_t k = 0; k < 3; ++k) {
            const float* value = &uv->values[2 * size_t{mesh.corners[t][k]}];
            glm::dvec3 at(value[0], value[1], 1);
            if (transform != nullptr) at = *transform * at;
            const std::optional<GridPoint> snapped = snapToGrid(at.x, at.y);
            if (!snapped) {
                return fail(
                    ErrorCode::limitExceeded,
                    "a texture coordinate lies beyond +-8 tiles, where lines cannot be followed "
                    "exactly; move the chart towards [0, 1], or use a projection or a pattern",
                    "mesh \"" + mesh.name + "\", UV (" + std::to_string(at.x) + ", " +
                        std::to_string(at.y) + ")");
            }
            triangles[t].corner[k] = *snapped;
        }
        triangles[t].kind = classify(triangles[t].corner);
    }
    return triangles;
}

std::optional<glm::dvec2> uvOf(const SurfaceMesh& mesh, uint32_t triangle,
                               const glm::dvec3& position) {
    const Attribute* uv = findAttribute(mesh.attributes, mesh.uvSemantic);
    if (uv == nullptr || uv->components != 2) return std::nullopt;
    const auto& v = mesh.triangles[triangle];
    const glm::dvec3 weights =
        weightsIn(position, mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]])
            .value_or(glm::dvec3(1, 0, 0));
    glm::dvec3 at(0.0);
    for (size_t k = 0; k < 3; ++k) {
        const float* value = &uv->values[2 * size_t{mesh.corners[triangle][k]}];
        at += glm::dvec3(value[0], value[1], 1) * weights[static_cast<int>(k)];
    }
    const uint32_t slot = mesh.triangleMaterials[triangle];
    if (slot < mesh.placements.size()) at = mesh.placements[slot].transform * at;
    return glm::dvec2(at);
}

}  // namespace sherd
