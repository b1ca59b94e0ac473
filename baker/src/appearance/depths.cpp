// SPDX-License-Identifier: MIT
#include "appearance/depths.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace sherd {

std::vector<double> hiddenDepths(const HiddenMesh& mesh, const TriangleBvh& skin) {
    std::vector<double> depths(mesh.positions.size(), -1);
    std::fill_n(depths.begin(), mesh.skinVertices, 0.0);
    for (const HiddenMesh::Face& face : mesh.faces) {
        for (const uint32_t v : face.v) {
            if (depths[v] >= 0) continue;
            // Points of a medial surface are as far from much of the skin; a bound from the face's
            // other corners saves most of the search.
            const glm::dvec3 p = mesh.positions[v];
            double reach = std::numeric_limits<double>::infinity();
            for (const uint32_t other : face.v) {
                if (depths[other] < 0) continue;
                const double apart = glm::distance(p, glm::dvec3(mesh.positions[other]));
                reach = std::min(reach, (depths[other] + apart) * (1 + 1e-9));
            }
            const double found = std::sqrt(skin.closest(p, reach).distance2);
            depths[v] = std::isfinite(found) ? found : 0;
        }
    }
    for (double& depth : depths) depth = std::max(depth, 0.0);
    return depths;
}

}  // namespace sherd
