// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/result.h"

namespace sherd {

struct PoleMedialOptions {
    int preSmoothing = 10;  ///< Laplacian steps of the surface before its poles are sought, 0..1000
    int postSmoothing = 10;  ///< Laplacian steps of the medial surface afterwards, 0..1000
    unsigned threads = 2;    ///< at most; the result does not depend on it
};

/// The thesis' own medial surface, and the reference for ours: an inner point for each position.
struct PoleMedialSurface {
    std::vector<glm::vec3> points;  ///< inside the solid, or equal to the position itself
    double qhullSeconds = 0;        ///< wall time of the Delaunay triangulation
    uint32_t outside = 0;           ///< vertices whose pole was outside or missing
    uint32_t pulledBack = 0;        ///< of these, moved towards the vertex by halves until inside
    uint32_t onSurface = 0;         ///< M(v) = v: no room inside, or no triangle at v
    std::vector<std::string> warnings;
};

/// Positions must be finite, indices in range. Any topology; open surfaces have the inside that
/// `InsideTest` gives them.
Result<PoleMedialSurface> poleMedialSurface(const SurfaceMesh& mesh,
                                            const PoleMedialOptions& options);

}  // namespace sherd
