// SPDX-License-Identifier: MIT
#include "interior/hidden_sheet.h"

#include <glm/geometric.hpp>

namespace sherd {

HiddenSheet plainSheet(const SplitSurface& surface, const MeshTopology& topology,
                       std::vector<glm::vec3> points) {
    HiddenSheet sheet{BisectedTriangles(vertexTriangles(surface), topology.opposite), {}, {}, {}};
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

void snapToFeet(double distance, HiddenSheet& sheet) {
    for (size_t v = 0; v < sheet.points.size(); ++v) {
        if (glm::distance(glm::dvec3(sheet.points[v]), glm::dvec3(sheet.feet[v])) < distance)
            sheet.points[v] = sheet.feet[v];
    }
}

}  // namespace sherd
