// SPDX-License-Identifier: MIT
// Points spread in a solid: the sites of Voronoi cells.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd {

struct VolumeSites {
    enum class Kind : uint8_t {
        uniform,  ///< anywhere alike
        crowded,  ///< the more the nearer to the points `around`
        lattice   ///< on a cubic lattice, moved by jitter
    };
    Kind kind = Kind::uniform;
    uint32_t count = 12;  ///< 1 to 100,000; lattice: about as many, rounded to whole rows
    uint64_t seed = 1;    ///< the same seed gives the same sites
    std::vector<glm::dvec3> around;  ///< crowded: in the mesh's coordinates, at least one
    double spread = 0.2;  ///< crowded: how far the crowds reach, share of the diagonal, above 0
    double jitter = 0.5;  ///< lattice: 0 to 1, of the half distance between neighbours
};

/// Inside the mesh, where that is thick enough to be found by chance, else on its skin. Errors:
/// badArgument, noTriangles.
Result<std::vector<glm::dvec3>> volumeSites(std::span<const glm::vec3> positions,
                                            std::span<const std::array<uint32_t, 3>> triangles,
                                            const VolumeSites& options);

}  // namespace sherd
