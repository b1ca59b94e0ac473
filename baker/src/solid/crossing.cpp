// SPDX-License-Identifier: MIT
#include "solid/crossing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/predicates.h"

namespace sherd {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

/// How far a segment must be moved at most not to go through the triangle; 0 if it does not. Its
/// ends lie on different sides.
double depthOf(const glm::dvec3& p, const glm::dvec3& q, const Triangle& t) {
    bool left = true, right = true;
    for (size_t k = 0; k < 3; ++k) {
        const int side = orient3d(p, q, t[k], t[(k + 1) % 3]);
        left = left && side >= 0;
        right = right && side <= 0;
    }
    if (left == right) return 0;
    const glm::dvec3 across = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double area = glm::length(across);
    if (!(area > 0)) return 0;
    const glm::dvec3 normal = across / area;
    const double a = std::abs(glm::dot(p - t[0], normal));
    const double b = std::abs(glm::dot(q - t[0], normal));
    double depth = std::min(a, b);
    const glm::dvec3 place = p + (q - p) * (a / (a + b));
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec3 along = t[(k + 1) % 3] - t[k];
        depth = std::min(depth, glm::length(glm::cross(place - t[k], along)) / glm::length(along));
    }
    return depth;
}

bool anyEdgePierces(const Triangle& a, const Triangle& b, double least) {
    std::array<int, 3> side{};
    for (size_t k = 0; k < 3; ++k) side[k] = orient3d(b[0], b[1], b[2], a[k]);
    for (size_t k = 0; k < 3; ++k) {
        const size_t next = (k + 1) % 3;
        if (side[k] * side[next] < 0 && depthOf(a[k], a[next], b) > least) return true;
    }
    return false;
}

}  // namespace

bool trianglesCross(const Triangle& a, const Triangle& b, double depth) {
    return anyEdgePierces(a, b, depth) || anyEdgePierces(b, a, depth);
}

}  // namespace sherd
