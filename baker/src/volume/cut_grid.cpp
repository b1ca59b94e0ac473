// SPDX-License-Identifier: MIT
#include "volume/cut_grid.h"

#include <algorithm>
#include <cmath>

#include "geometry/bounds.h"
#include "geometry/exact_grid.h"

namespace sherd {

Result<CutGrid> CutGrid::around(std::span<const glm::vec3> positions,
                                std::span<const std::array<uint32_t, 3>> triangles) {
    if (triangles.empty()) return fail(ErrorCode::noTriangles, "there is nothing to cut");
    for (size_t t = 0; t < triangles.size(); ++t) {
        for (const uint32_t v : triangles[t]) {
            const bool known = v < positions.size();
            if (known && std::isfinite(positions[v].x) && std::isfinite(positions[v].y) &&
                std::isfinite(positions[v].z)) {
                continue;
            }
            return fail(ErrorCode::invalidData,
                        known ? "a position is not a number" : "there is no such vertex",
                        "triangle " + std::to_string(t));
        }
    }
    const Bounds bounds = boundsOf(positions, triangles);
    const glm::dvec3 size = bounds.size();
    CutGrid grid;
    grid.middle_ = bounds.middle();
    grid.extent_ = std::max({size.x, size.y, size.z});
    if (!(grid.extent_ > 0)) return fail(ErrorCode::invalidData, "the mesh is a single point");
    int exponent = 0;
    const double mantissa = std::frexp(grid.extent_, &exponent);
    if (mantissa == 0.5) --exponent;
    grid.step_ = std::ldexp(1.0, exponent - 26);
    return grid;
}

CutGridPoint CutGrid::snap(const glm::dvec3& position) const {
    const glm::dvec3 g = toGrid(position);
    return {roundToInteger(g.x), roundToInteger(g.y), roundToInteger(g.z)};
}

}  // namespace sherd
