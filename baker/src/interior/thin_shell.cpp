// SPDX-License-Identifier: MIT
#include "interior/thin_shell.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "geometry/ray_hit.h"
#include "interior/hidden_points.h"

namespace sherd {

namespace {

std::vector<std::array<uint32_t, 3>> trianglesOf(const HiddenSheet& sheet) {
    std::vector<std::array<uint32_t, 3>> triangles;
    triangles.reserve(sheet.triangles.size());
    for (const HiddenSheet::Triangle& t : sheet.triangles) triangles.push_back(t.v);
    return triangles;
}

}  // namespace

ThinShell::ThinShell(const HiddenSheet& sheet, const SolidTest& object)
    : sheet_(sheet),
      object_(object),
      normals_(sheet.feet.size(), glm::dvec3(0.0)),
      tree_(sheet.feet, trianglesOf(sheet)) {
    for (const HiddenSheet::Triangle& t : sheet.triangles) {
        const glm::dvec3 a = sheet.feet[t.v[0]];
        const glm::dvec3 normal =
            glm::cross(glm::dvec3(sheet.feet[t.v[1]]) - a, glm::dvec3(sheet.feet[t.v[2]]) - a);
        for (const uint32_t v : t.v) normals_[v] += normal;
    }
}

glm::vec3 ThinShell::below(uint32_t vertex, double share, double deepest) const {
    const glm::vec3& p = sheet_.feet[vertex];
    const double length = glm::length(normals_[vertex]);
    if (!(length > 0)) return p;
    const glm::dvec3 inwards = normals_[vertex] / -length;
    // The triangles around the vertex are hit at once; what counts lies farther than rounding.
    const double start = 1e-6 * deepest;
    const RayHit hit = firstHit(tree_, glm::dvec3(p) + inwards * start, inwards);
    const double depth = std::min(deepest, share * hit.t);
    return pullInside(object_, p, glm::vec3(glm::dvec3(p) + inwards * depth));
}

}  // namespace sherd
