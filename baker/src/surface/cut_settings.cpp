// SPDX-License-Identifier: MIT
#include "surface/cut_settings.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sherd {

double diagonalOf(const SurfaceMesh& mesh) {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (const auto& t : mesh.triangles) {
        for (const uint32_t v : t) {
            low = glm::min(low, glm::dvec3(mesh.positions[v]));
            high = glm::max(high, glm::dvec3(mesh.positions[v]));
        }
    }
    return mesh.triangles.empty() ? 0 : glm::distance(low, high);
}

CutOptions cutOptionsOf(const Recipe& recipe, double diagonal) {
    CutOptions options;
    options.seams = {recipe.seamJoinShare * diagonal, recipe.interior.thesis};
    options.closeGaps = recipe.closeGaps;
    options.snapDistance = recipe.snapShare * diagonal;
    options.wrap = recipe.wrap;
    options.splitPatches = recipe.splitParts;
    return options;
}

}  // namespace sherd
