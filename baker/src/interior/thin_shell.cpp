// SPDX-License-Identifier: MIT
#include "interior/thin_shell.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "geometry/ray_hit.h"
#include "interior/hidden_points.h"

namespace sherd {

ThinShell::ThinShell(const SplitSurface& surface, const InsideTest& inside)
    : surface_(surface),
      inside_(inside),
      normals_(surface.positions.size(), glm::dvec3(0.0)),
      tree_(surface.positions, vertexTriangles(surface)) {
    for (const SplitTriangle& t : surface.triangles) {
        const glm::dvec3 a = surface.positions[t.v[0]];
        const glm::dvec3 normal = glm::cross(glm::dvec3(surface.positions[t.v[1]]) - a,
                                             glm::dvec3(surface.positions[t.v[2]]) - a);
        for (const uint32_t v : t.v) normals_[v] += normal;
    }
}

glm::vec3 ThinShell::below(uint32_t vertex, double share, double deepest) const {
    const glm::vec3& p = surface_.positions[vertex];
    const double length = glm::length(normals_[vertex]);
    if (!(length > 0)) return p;
    const glm::dvec3 inwards = normals_[vertex] / -length;
    // The triangles around the vertex are hit at once; what counts lies farther than rounding.
    const double start = 1e-6 * deepest;
    const RayHit hit = firstHit(tree_, glm::dvec3(p) + inwards * start, inwards);
    const double depth = std::min(deepest, share * hit.t);
    return pullInside(inside_, p, glm::vec3(glm::dvec3(p) + inwards * depth));
}

}  // namespace sherd
