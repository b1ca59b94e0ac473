// SPDX-License-Identifier: MIT
#include "interior/hidden_sheet.h"

namespace sherd {

HiddenSheet plainSheet(const SplitSurface& surface, const MeshTopology& topology,
                       std::vector<glm::vec3> points) {
    HiddenSheet sheet;
    sheet.triangles.reserve(surface.triangles.size());
    for (uint32_t t = 0; t < surface.triangles.size(); ++t)
        sheet.triangles.push_back({surface.triangles[t].v, t, {3 * t, 3 * t + 1, 3 * t + 2}});
    sheet.opposite = topology.opposite;
    sheet.origins = surface.origins;
    sheet.feet = surface.positions;
    sheet.points = std::move(points);
    return sheet;
}

void setHubs(HiddenSheet& sheet, std::span<const glm::vec3> hubs) {
    const size_t kept = sheet.points.size() - sheet.hubs;
    for (std::vector<glm::vec3>* places : {&sheet.points, &sheet.feet}) {
        places->resize(kept);
        places->insert(places->end(), hubs.begin(), hubs.end());
    }
    sheet.origins.resize(kept);
    sheet.origins.resize(kept + hubs.size());
    sheet.hubs = static_cast<uint32_t>(hubs.size());
}

glm::dvec3 weightsOf(const VertexOrigin& origin, const std::array<uint32_t, 3>& meshTriangle) {
    glm::dvec3 weights(0.0);
    for (int k = 0; k < 3; ++k) {
        if (origin.weights[k] == 0) continue;
        for (int corner = 0; corner < 3; ++corner) {
            if (meshTriangle[static_cast<size_t>(corner)] !=
                origin.vertices[static_cast<size_t>(k)])
                continue;
            weights[corner] += origin.weights[k];
            break;
        }
    }
    return weights;
}

}  // namespace sherd
