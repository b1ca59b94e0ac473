// SPDX-License-Identifier: MIT
// G. Thuermer, C. A. Wuethrich, "Computing Vertex Normals from Polygonal Facets" (1998): weighted
// by the angle at the vertex, a normal does not depend on how flat faces are cut into triangles.
#include "interior/corner_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sherd {
namespace {

glm::vec3 unit(const glm::vec3& n) {
    const float length = glm::length(n);
    return length > 0 ? n / length : glm::vec3(0.0F);
}

struct Facet {
    glm::vec3 normal{0.0F};       ///< unit
    std::array<float, 3> angles;  ///< at the corners, radians
};

std::vector<Facet> facetsOf(std::span<const glm::vec3> positions,
                            std::span<const std::array<uint32_t, 3>> triangles) {
    std::vector<Facet> facets(triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
        const auto& v = triangles[t];
        const std::array<glm::vec3, 3> p{positions[v[0]], positions[v[1]], positions[v[2]]};
        facets[t].normal = unit(glm::cross(p[1] - p[0], p[2] - p[0]));
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec3 a = unit(p[(k + 1) % 3] - p[k]), b = unit(p[(k + 2) % 3] - p[k]);
            facets[t].angles[k] = std::acos(std::clamp(glm::dot(a, b), -1.0F, 1.0F));
        }
    }
    return facets;
}

}  // namespace

std::vector<std::array<glm::vec3, 3>> cornerNormals(
    std::span<const glm::vec3> positions, std::span<const std::array<uint32_t, 3>> triangles,
    double creaseAngle) {
    const std::vector<Facet> facets = facetsOf(positions, triangles);
    std::vector<uint32_t> start(positions.size() + 1, 0), corners(3 * triangles.size());
    for (const auto& t : triangles)
        for (const uint32_t v : t) ++start[v + 1];
    for (size_t v = 0; v < positions.size(); ++v) start[v + 1] += start[v];
    std::vector<uint32_t> next(start.begin(), start.end() - 1);
    for (uint32_t c = 0; c < corners.size(); ++c) corners[next[triangles[c / 3][c % 3]]++] = c;
    const auto smooth = static_cast<float>(std::cos(creaseAngle));
    std::vector<std::array<glm::vec3, 3>> result(triangles.size());
    for (uint32_t c = 0; c < corners.size(); ++c) {
        const uint32_t v = triangles[c / 3][c % 3];
        glm::vec3 sum(0.0F);
        for (uint32_t i = start[v]; i < start[v + 1]; ++i) {
            const Facet& other = facets[corners[i] / 3];
            if (corners[i] == c || glm::dot(other.normal, facets[c / 3].normal) > smooth)
                sum += other.angles[corners[i] % 3] * other.normal;
        }
        result[c / 3][c % 3] = unit(sum);
    }
    return result;
}

}  // namespace sherd
