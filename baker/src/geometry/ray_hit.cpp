// SPDX-License-Identifier: MIT
// Moeller and Trumbore 1997, Fast, Minimum Storage Ray/Triangle Intersection.
#include "geometry/ray_hit.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace sherd {
namespace {

bool meetsBox(const glm::dvec3& from, const glm::dvec3& along, const glm::vec3& low,
              const glm::vec3& high) {
    double enter = 0;
    double leave = 1e300;
    for (int k = 0; k < 3; ++k) {
        if (along[k] == 0) {
            if (from[k] < low[k] || from[k] > high[k]) return false;
            continue;
        }
        const double x = (low[k] - from[k]) / along[k];
        const double y = (high[k] - from[k]) / along[k];
        enter = std::max(enter, std::min(x, y));
        leave = std::min(leave, std::max(x, y));
    }
    return enter <= leave;
}

/// 0: none.
double hitAt(const glm::dvec3& from, const glm::dvec3& along,
             const std::array<glm::vec3, 3>& corners) {
    const glm::dvec3 a = corners[0];
    const glm::dvec3 ab = glm::dvec3(corners[1]) - a;
    const glm::dvec3 ac = glm::dvec3(corners[2]) - a;
    const glm::dvec3 p = glm::cross(along, ac);
    const double det = glm::dot(ab, p);
    if (det == 0) return 0;
    const glm::dvec3 s = from - a;
    const double u = glm::dot(s, p) / det;
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(along, q) / det;
    if (u < 0 || v < 0 || u + v > 1) return 0;
    return glm::dot(ac, q) / det;
}

}  // namespace

RayHit firstHit(const TriangleBvh& tree, const glm::dvec3& origin, const glm::dvec3& direction,
                uint32_t except) {
    RayHit best;
    const auto wants = [&](const glm::vec3& low, const glm::vec3& high) {
        return meetsBox(origin, direction, low, high);
    };
    tree.forEach(wants, [&](uint32_t triangle, const std::array<glm::vec3, 3>& corners) {
        if (triangle == except) return;
        const double t = hitAt(origin, direction, corners);
        if (t <= 0 || t > best.t || (t == best.t && triangle > best.triangle)) return;
        best = {t, triangle};
    });
    return best;
}

}  // namespace sherd
