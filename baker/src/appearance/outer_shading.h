// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include "sherd/baker/surface_mesh.h"
#include "surface/split_surface.h"

namespace sherd {

/// How cutting changes the light on the outer surface at rest.
struct ShadingShift {
    uint32_t triangles = 0;  ///< of the mesh: cut, and shaded otherwise by more than was asked for
    double degrees = 0;      ///< by which the normal of a renderer's pixel turns at most
    glm::dvec3 place{0};     ///< where it does
};

/// Renderers interpolate normals over a triangle and bring them back to unit length in each pixel.
/// Where a line cuts, glTF wants unit normals again, and within the parts of a triangle they turn
/// at another pace than in the whole: the more, the more the triangle's corners disagree. `least`
/// is in degrees.
ShadingShift shadingShift(const SurfaceMesh& mesh, const SplitSurface& surface, double least);

}  // namespace sherd
