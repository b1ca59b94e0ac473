// SPDX-License-Identifier: MIT
// Random meshes with random atlases, and maps drawn over them so that lines meet vertices, edges
// and each other all the time.
#pragma once

#include "sherd/baker/fracture_map.h"
#include "sherd/baker/surface_mesh.h"
#include "support/property.h"

namespace sherd::test {

struct SurfaceChoice {
    uint32_t cells = 4;        ///< about how many quads along each side of a shape
    bool open = true;          ///< open shapes, too
    bool nonManifold = false;  ///< shapes that touch themselves along edges, and worse
    bool spoilt = true;        ///< needles, flat and index-degenerate triangles
    double scale = 1;
};

/// Boxes, spheres, tori, plates with several holes, open sheets: with what the choice allows.
SurfaceMesh randomSurface(Random& random, const SurfaceChoice& choice);

/// Up to `lines` lines of up to three levels.
FractureMap randomMap(Random& random, const SurfaceMesh& mesh, uint32_t lines);

}  // namespace sherd::test
