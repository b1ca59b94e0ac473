// SPDX-License-Identifier: MIT
// A texture that repeats shows the same picture in every tile, so a triangle is drawn where it
// falls when its centre is taken to the first tile; in odd tiles of a mirrored texture the picture
// is the other way round. Triangles are moved whole: one that spans tiles reaches off the page.
#include "layout/drawn_triangle.h"

#include <cmath>

namespace sherd {

DrawnTriangle drawnTriangle(const std::array<glm::vec2, 3>& uv, const TexturePlacement& placement) {
    DrawnTriangle out{uv, DrawnWhere::inPlace};
    std::array<glm::dvec2, 3> at{};
    for (size_t k = 0; k < 3; ++k) {
        at[k] = glm::dvec2(placement.transform * glm::dvec3(glm::dvec2(uv[k]), 1.0));
    }
    const glm::dvec2 centre = (at[0] + at[1] + at[2]) / 3.0;
    bool moved = placement.transform != glm::dmat3(1.0);
    for (int axis = 0; axis < 2; ++axis) {
        if (!std::isfinite(centre[axis])) return out;
        if (centre[axis] >= 0 && centre[axis] <= 1) continue;
        const Wrap wrap = axis == 0 ? placement.wrapU : placement.wrapV;
        if (wrap == Wrap::clamp) {
            out.where = DrawnWhere::beyondEdge;
            continue;
        }
        moved = true;
        if (out.where == DrawnWhere::inPlace) out.where = DrawnWhere::anotherTile;
        const double tile = std::floor(centre[axis]);
        const bool turned = wrap == Wrap::mirror && std::fmod(tile, 2.0) != 0;
        for (glm::dvec2& p : at) p[axis] = turned ? tile + 1 - p[axis] : p[axis] - tile;
    }
    if (!moved) return out;
    for (size_t k = 0; k < 3; ++k) out.points[k] = glm::vec2(at[k]);
    return out;
}

DrawnMesh::DrawnMesh(const SurfaceMesh& mesh)
    : mesh_(mesh),
      uv_(mesh.uvSemantic.empty() ? nullptr : findAttribute(mesh.attributes, mesh.uvSemantic)) {}

DrawnTriangle DrawnMesh::operator[](size_t triangle) const {
    return drawnTriangle(corners(triangle), placement(triangle));
}

std::array<glm::dvec2, 3> DrawnMesh::placed(size_t triangle) const {
    const std::array<glm::vec2, 3> at = corners(triangle);
    const glm::dmat3 transform = placement(triangle).transform;
    std::array<glm::dvec2, 3> out{};
    for (size_t k = 0; k < 3; ++k)
        out[k] = glm::dvec2(transform * glm::dvec3(glm::dvec2(at[k]), 1.0));
    return out;
}

std::array<glm::vec2, 3> DrawnMesh::corners(size_t triangle) const {
    std::array<glm::vec2, 3> out{};
    for (size_t k = 0; k < 3; ++k) {
        const size_t at = size_t{2} * mesh_.corners[triangle][k];
        // Adding zero makes a negative zero positive: they are one point.
        out[k] = at + 1 < uv_->values.size()
                     ? glm::vec2(uv_->values[at] + 0.0F, uv_->values[at + 1] + 0.0F)
                     : glm::vec2(NAN);
    }
    return out;
}

TexturePlacement DrawnMesh::placement(size_t triangle) const {
    const uint32_t slot =
        triangle < mesh_.triangleMaterials.size() ? mesh_.triangleMaterials[triangle] : 0;
    return slot < mesh_.placements.size() ? mesh_.placements[slot] : TexturePlacement();
}

}  // namespace sherd
