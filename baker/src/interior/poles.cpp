// SPDX-License-Identifier: MIT
// N. Amenta and M. Bern, "Surface Reconstruction by Voronoi Filtering" (1999): the farthest
// vertices of a sample's Voronoi cell on either side of the surface, its poles, lie near the medial
// axis. They find the sides from the sample points alone; we know the normals and ask them.
#include "interior/poles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sherd {

std::vector<glm::dvec3> vertexNormals(std::span<const glm::dvec3> points,
                                      std::span<const std::array<uint32_t, 3>> triangles) {
    std::vector<glm::dvec3> normals(points.size(), glm::dvec3(0.0));
    for (const auto& t : triangles) {
        const glm::dvec3 cross =
            glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
        const double twiceArea = glm::length(cross);
        if (!(twiceArea > 0)) continue;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 a = points[t[(k + 1) % 3]] - points[t[k]];
            const glm::dvec3 b = points[t[(k + 2) % 3]] - points[t[k]];
            normals[t[k]] += cross * (std::atan2(twiceArea, glm::dot(a, b)) / twiceArea);
        }
    }
    for (glm::dvec3& n : normals) {
        const double length = glm::length(n);
        // Opposite sheets welded together leave a sum of rounding errors only.
        n = length > 1e-9 ? n / length : glm::dvec3(0.0);
    }
    return normals;
}

std::vector<uint32_t> innerPoles(std::span<const glm::dvec3> sites,
                                 std::span<const glm::dvec3> normals,
                                 const VoronoiVertices& voronoi, double maxRadius) {
    std::vector<uint32_t> poles(sites.size(), kNoPole);
    std::vector<double> farthest(sites.size(), 0);
    for (uint32_t i = 0; i < voronoi.points.size(); ++i) {
        for (uint32_t k = voronoi.firstSite[i]; k < voronoi.firstSite[i + 1]; ++k) {
            const uint32_t site = voronoi.sites[k];
            const glm::dvec3 d = voronoi.points[i] - sites[site];
            const double distance2 = glm::dot(d, d);
            if (distance2 <= farthest[site] || distance2 > maxRadius * maxRadius) continue;
            if (glm::dot(d, normals[site]) >= 0) continue;
            farthest[site] = distance2;
            poles[site] = i;
        }
    }
    return poles;
}

}  // namespace sherd
