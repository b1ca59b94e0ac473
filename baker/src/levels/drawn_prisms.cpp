// SPDX-License-Identifier: MIT
#include "levels/drawn_prisms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "map/planar_map.h"
#include "surface/page_frames.h"
#include "volume/coplanar_faces.h"

namespace sherd {
namespace {

/// Places of the page on the grid, as far as they are seen along the axis.
class PageOnGrid {
  public:
    PageOnGrid(const PagePlane& page, const CutGrid& grid, uint32_t axis)
        : page_(page), grid_(grid), x_((axis + 1) % 3), y_((axis + 2) % 3) {}

    /// In the units of a planar map, in which the grid is [0, 1]; see `PrismMap::kStep`.
    glm::dvec2 operator()(const glm::dvec2& p) const {
        const glm::dvec3 place = page_.origin +
                                 page_.right * (p.x / glm::dot(page_.right, page_.right)) +
                                 page_.down * (p.y / glm::dot(page_.down, page_.down));
        const glm::dvec3 at = grid_.toGrid(place);
        constexpr double kSteps = 2.0 * CutGrid::kReach;
        return glm::dvec2(at[static_cast<int>(x_)], at[static_cast<int>(y_)]) / kSteps + 0.5;
    }

  private:
    const PagePlane& page_;
    const CutGrid& grid_;
    uint32_t x_, y_;
};

/// Faces of the object's skin that stand upright on the page's plane, in the drawing's units.
std::vector<UprightFace> uprightFaces(const PieceModel& model, const CutGrid& grid, uint32_t axis,
                                      double band) {
    constexpr double kSteps = 2.0 * CutGrid::kReach;
    std::vector<UprightFace> faces;
    for (const SplitTriangle& t : model.surface.triangles) {
        std::array<glm::dvec3, 3> p{};
        for (size_t k = 0; k < 3; ++k)
            p[k] = grid.toGrid(glm::dvec3(model.surface.positions[t.v[k]])) / kSteps + 0.5;
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const glm::dvec2 across(normal[static_cast<int>((axis + 1) % 3)],
                                normal[static_cast<int>((axis + 2) % 3)]);
        const double size = glm::length(across);
        if (!(std::abs(normal[static_cast<int>(axis)]) < 1e-3 * size)) continue;
        // With the solid on its left a stretch runs so that the normal is on its right.
        const glm::dvec2 along = glm::dvec2(-across.y, across.x) / size;
        UprightFace face;
        double least = 1e30, most = -1e30, low = 1e30, high = -1e30;
        for (const glm::dvec3& corner : p) {
            const glm::dvec2 at(corner[static_cast<int>((axis + 1) % 3)],
                                corner[static_cast<int>((axis + 2) % 3)]);
            const double along1 = glm::dot(at, along), off = glm::dot(at, across) / size;
            low = std::min(low, off);
            high = std::max(high, off);
            if (along1 < least) face.from = at;
            if (along1 > most) face.to = at;
            least = std::min(least, along1);
            most = std::max(most, along1);
        }
        if (high - low > band) continue;
        face.area = glm::length(normal) / 2;
        faces.push_back(face);
    }
    return faces;
}

}  // namespace

Result<DrawnPrisms> drawnPrisms(const VolumeCut& cut, const PieceModel& model,
                                const CutGrid& grid) {
    const PagePlane page = fitPage(model.surface, cut.along);
    const glm::dvec3 look = glm::cross(page.down, page.right);
    uint32_t axis = 0;
    for (uint32_t k = 1; k < 3; ++k)
        if (std::abs(look[static_cast<int>(k)]) > std::abs(look[static_cast<int>(axis)])) axis = k;
    const PageOnGrid onGrid(page, grid, axis);
    FractureMap drawn;
    for (const FractureMap::Line& line : cut.drawing->lines) {
        drawn.lines.push_back(line);
        for (glm::dvec2& p : drawn.lines.back().points) p = onGrid(p);
    }
    // In the drawing's units, as a millionth of the extent.
    const double by = 2 * kCoplanarBand * grid.extent() / (grid.step() * 2.0 * CutGrid::kReach);
    const MovedLines moved = moveOffFaces(uprightFaces(model, grid, axis, by / 2), by, drawn);
    const Result<PlanarMap> planar = planarise(drawn);
    if (!planar) return tl::unexpected(planar.error());
    Result<PrismMap> map = PrismMap::of(*planar);
    if (!map) return tl::unexpected(map.error());
    DrawnPrisms prisms{std::move(*map), axis, cut.drawing->warnings, moved};
    prisms.warnings.insert(prisms.warnings.end(), planar->warnings.begin(), planar->warnings.end());
    if (!cut.drawing->surfaceLines.empty())
        prisms.warnings.emplace_back("lines over the surface are not projected through the volume");
    return prisms;
}

}  // namespace sherd
