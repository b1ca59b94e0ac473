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

}  // namespace sherd
