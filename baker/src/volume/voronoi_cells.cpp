// SPDX-License-Identifier: MIT
#include "volume/voronoi_cells.h"

#include <cmath>
#include <glm/common.hpp>

namespace sherd {

Result<CellFamily> voronoiCells(std::span<const glm::dvec3> sites, const CutGrid& grid) {
    CellFamily family;
    for (size_t i = 0; i < sites.size(); ++i) {
        const glm::dvec3 away = glm::abs(grid.toGrid(sites[i]));
        if (!(away.x <= CutGrid::kFarthest && away.y <= CutGrid::kFarthest &&
              away.z <= CutGrid::kFarthest)) {
            return fail(ErrorCode::badArgument,
                        "a site is no number, or farther than twice the mesh's extent from it",
                        "site " + std::to_string(i));
        }
        const CutGridPoint p = grid.snap(sites[i]);
        const int64_t x = p.x, y = p.y, z = p.z;
        // |v - p|^2 less |v|^2.
        family.functions.push_back({-2 * x, -2 * y, -2 * z, x * x + y * y + z * z});
        family.sites.emplace_back(p.x, p.y, p.z);
    }
    return family;
}

}  // namespace sherd
