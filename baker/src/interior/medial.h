// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/result.h"

namespace sherd {

struct MedialOptions {
    bool thesis = false;  ///< Laplacian smoothing, 10 steps before and 10 after, as Casella (2013)
    int preSmoothing = 12;  ///< smoothing steps of the surface before its poles are sought, 0..1000
    int postSmoothing = 0;  ///< Taubin steps of the medial surface afterwards, 0..1000
    unsigned threads = 2;   ///< at most; the result does not depend on it
};

/// One inner point M(v) for each position of a mesh: with the mesh's own triangles, the medial
/// surface. Depends on the positions and triangles only, never on drawn lines.
struct MedialSurface {
    std::vector<glm::vec3> points;  ///< inside the solid, or equal to the position itself
    double qhullSeconds = 0;        ///< wall time of the Delaunay triangulation
    uint32_t throughWalls = 0;      ///< poles whose ball crossed a triangle, and was shrunk
    uint32_t ballsInWalls = 0;  ///< of these: replaced by the tangent ball of the original surface
    uint32_t outsideBefore =
        0;  ///< vertices whose pole (after all smoothing) was outside or missing
    uint32_t outsideAfter = 0;    ///< vertices outside in the result: 0, counted again at the end
    uint32_t fromNeighbours = 0;  ///< of outsideBefore: mended by the mean of their neighbours
    uint32_t fallbackRaw = 0;     ///< by the tangent ball of the original surface
    uint32_t pulledBack = 0;      ///< by moving towards the vertex by halves until inside
    uint32_t onSurface = 0;       ///< M(v) = v: no room inside, or no triangle at v
    std::vector<std::string> warnings;
};

/// Positions must be finite, indices in range. Any topology; open surfaces have the inside that
/// `InsideTest` gives them.
Result<MedialSurface> medialSurface(const SurfaceMesh& mesh, const MedialOptions& options);

}  // namespace sherd
