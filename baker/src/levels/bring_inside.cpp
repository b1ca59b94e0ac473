// SPDX-License-Identifier: MIT
#include "levels/bring_inside.h"

#include <cmath>

#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"

namespace sherd {

uint32_t bringInside(const SurfaceMesh& object, double tolerance, HiddenMesh& hidden) {
    const InsideTest inside(object.positions, object.triangles);
    const TriangleBvh skin(object.positions, object.triangles);
    uint32_t moved = 0;
    for (size_t v = hidden.skinVertices; v < hidden.positions.size(); ++v) {
        const glm::dvec3 p = hidden.positions[v];
        if (inside.inside(p)) continue;
        const ClosestPoint nearest = skin.closest(p);
        if (std::sqrt(nearest.distance2) <= tolerance) continue;
        hidden.positions[v] = glm::vec3(nearest.point);
        ++moved;
    }
    return moved;
}

}  // namespace sherd
