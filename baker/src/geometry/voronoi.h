// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd {

/// The finite vertices of a 3D Voronoi diagram: each is equally far from its (4 or more) sites, and
/// no other site is nearer.
struct VoronoiVertices {
    std::vector<glm::dvec3> points;
    std::vector<uint32_t>
        firstSite;  ///< vertex i: sites[firstSite[i]] to sites[firstSite[i + 1] - 1]
    std::vector<uint32_t> sites;
};

/// Sites must be finite and of a size around 1. Fewer than 4 sites, or sites all in one plane, have
/// no Voronoi vertices and are an error (`invalidData`) with Qhull's own words.
Result<VoronoiVertices> voronoiVertices(std::span<const glm::dvec3> sites);

}  // namespace sherd
