// SPDX-License-Identifier: MIT
#include "levels/drawn_prisms.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "map/planar_map.h"
#include "surface/page_frames.h"

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
    const Result<PlanarMap> planar = planarise(drawn);
    if (!planar) return tl::unexpected(planar.error());
    Result<PrismMap> map = PrismMap::of(*planar);
    if (!map) return tl::unexpected(map.error());
    DrawnPrisms prisms{std::move(*map), axis, cut.drawing->warnings};
    prisms.warnings.insert(prisms.warnings.end(), planar->warnings.begin(), planar->warnings.end());
    if (!cut.drawing->surfaceLines.empty())
        prisms.warnings.emplace_back("lines over the surface are not projected through the volume");
    return prisms;
}

}  // namespace sherd
