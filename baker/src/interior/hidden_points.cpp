// SPDX-License-Identifier: MIT
#include "interior/hidden_points.h"

namespace sherd {

glm::vec3 pullInside(const InsideTest& inside, const glm::vec3& p, glm::vec3 hidden) {
    for (int step = 0; step < 12; ++step) {
        if (inside.inside(glm::dvec3(hidden))) return hidden;
        hidden = glm::vec3((glm::dvec3(hidden) + glm::dvec3(p)) * 0.5);
    }
    return p;
}

HiddenPoints hiddenPoints(const SplitSurface& surface, std::span<const glm::vec3> medial,
                          const InsideTest& inside, unsigned threads) {
    HiddenPoints result;
    result.points.assign(medial.begin(), medial.end());
    const size_t count = surface.positions.size() - surface.meshVertices;
    result.points.reserve(surface.positions.size());
    for (size_t v = surface.meshVertices; v < surface.positions.size(); ++v) {
        const VertexOrigin& origin = surface.origins[v];
        glm::dvec3 sum(0.0);
        for (size_t k = 0; k < 3; ++k) {
            sum += glm::dvec3(medial[origin.vertices[k]]) * origin.weights[static_cast<int>(k)];
        }
        result.points.emplace_back(sum);
    }
    std::vector<uint8_t> isInside(count);
    inside.inside(std::span(result.points).subspan(surface.meshVertices), isInside, threads);
    for (size_t i = 0; i < count; ++i) {
        if (isInside[i] != 0) continue;
        const size_t v = surface.meshVertices + i;
        result.points[v] = pullInside(inside, surface.positions[v], result.points[v]);
        ++result.pulledBack;
        if (result.points[v] == surface.positions[v]) ++result.onSurface;
    }
    return result;
}

}  // namespace sherd
