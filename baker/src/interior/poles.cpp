// SPDX-License-Identifier: MIT
// N. Amenta and M. Bern, "Surface Reconstruction by Voronoi Filtering" (1999): the farthest
// vertices of a sample's Voronoi cell on either side of the surface, its poles, lie near the medial
// axis. They find the sides from the sample points alone; we know the normals and ask them.
#include "interior/poles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sherd {

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
