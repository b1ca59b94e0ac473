// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "geometry/bisection.h"
#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/result.h"
#include "surface/mesh_topology.h"

namespace sherd {

struct MedialOptions {
    bool thesis = false;    ///< as Casella (2013): poles, Laplacian smoothing, 10 steps before and
                            ///< 10 after; nothing below is used
    int preSmoothing = 3;   ///< smoothing steps of the surface before its balls are sought, 0..1000
    int postSmoothing = 0;  ///< Taubin steps of the medial surface afterwards, 0..1000
    double smoothingReach = 0.02;  ///< of the diagonal: smoothing blurs no farther
    double separationAngle = 50;   ///< degrees, 0..180: the angle filter of the thesis, 6.3.1.
                                   ///< Contacts that a ball sees nearer together make no branch
    double scaleAxis = 1.2;        ///< >= 1: balls within others scaled by this make no branch; 1:
                                   ///< none are dropped
    double smallestRadius = 0;     ///< of the diagonal: the circumradius filter of the thesis,
                                   ///< 6.3.1. Smaller balls make no branch
    bool open = false;             ///< the surface has no inside: whatever is below it will do
    double refinement = 0.015;     ///< of the diagonal: shorter edges are not refined
    unsigned threads = 2;          ///< at most; the result does not depend on it
};

/// A map M from the surface into the solid: linear on the triangles of a refinement of the mesh.
/// It depends on the positions and triangles only, never on drawn lines.
struct MedialSurface {
    BisectedTriangles triangles;    ///< vertices [0, positions) are the mesh's
    std::vector<glm::vec3> points;  ///< of each vertex: inside the solid, or on its surface
    uint32_t covered = 0;           ///< vertices that took the sheet of larger balls
    uint32_t outside = 0;           ///< vertices whose ball had its centre outside
    uint32_t pulledBack = 0;        ///< of both: moved towards the surface until inside
    uint32_t onSurface = 0;         ///< M(v) = v: no room inside, or no triangle at v
    double delaunaySeconds = 0;     ///< thesis: wall time of Qhull
    std::vector<std::string> warnings;

    /// M of the place with these weights of the corners of a triangle of the mesh.
    glm::dvec3 at(uint32_t triangle, const glm::dvec3& weights) const;
};

/// Positions must be finite, indices in range, the topology that of the mesh. Any topology; open
/// surfaces have the inside that `InsideTest` gives them.
Result<MedialSurface> medialSurface(const SurfaceMesh& mesh, const MeshTopology& topology,
                                    const MedialOptions& options);

}  // namespace sherd
