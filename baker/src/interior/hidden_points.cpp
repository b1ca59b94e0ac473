// SPDX-License-Identifier: MIT
#include "interior/hidden_points.h"

#include <algorithm>

namespace sherd {

glm::vec3 pullInside(const SolidTest& object, const glm::vec3& p, glm::vec3 hidden) {
    for (int step = 0; step < 12; ++step) {
        if (object.contains(glm::dvec3(hidden))) return hidden;
        hidden = glm::vec3((glm::dvec3(hidden) + glm::dvec3(p)) * 0.5);
    }
    return p;
}

bool mostlyInside(const InsideTest& inside, std::span<const glm::vec3> points) {
    std::vector<uint8_t> isInside(points.size());
    inside.inside(points, isInside);
    return 2 * std::count(isInside.begin(), isInside.end(), 1) >
           static_cast<std::ptrdiff_t>(points.size());
}

std::vector<glm::vec3> hiddenPoints(const SurfaceMesh& mesh, const SplitSurface& surface,
                                    const HiddenMap& map) {
    std::vector<glm::vec3> points(surface.positions);
    std::vector<uint8_t> known(points.size(), 0);
    for (const SplitTriangle& t : surface.triangles) {
        for (const uint32_t v : t.v) {
            if (known[v] != 0) continue;
            known[v] = 1;
            points[v] =
                glm::vec3(map(t.source, weightsOf(surface.origins[v], mesh.triangles[t.source])));
        }
    }
    return points;
}

}  // namespace sherd
