// SPDX-License-Identifier: MIT
// Closes an open mesh that is open by a few holes, so that its pieces can be solid.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sherd/baker/surface_mesh.h"
#include "surface/mesh_topology.h"

namespace sherd {

struct CapOptions {
    uint32_t mostHoles = 64;        ///< a mesh with more is a surface rather than a solid
    uint32_t mostCorners = 100000;  ///< of all holes together
};

struct HoleCap {
    glm::dvec3 place{0};  ///< mean of the hole's corners, object frame
    double length = 0;    ///< around the hole, metres
    double area = 0;      ///< of the cap, square metres
    uint32_t corners = 0;
    bool flat = false;    ///< filled in a plane
    std::string refusal;  ///< why the hole was left open; empty: it was closed
};

/// Appends the caps' triangles to the mesh, last (SurfaceMesh::capTriangles says how many). Their
/// material is that of the surface around. In the UV set lines are drawn in, the cap of a hole
/// within one chart covers the hole there, so lines go on over it; one that several charts surround
/// is a single point, and no drawn line crosses it. A hole is left open where its cap would cross
/// the surface or another cap. Of a mesh beyond the limits nothing is capped.
std::vector<HoleCap> capHoles(const MeshTopology& topology, SurfaceMesh& mesh,
                              const CapOptions& options = {});

}  // namespace sherd
