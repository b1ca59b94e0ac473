// SPDX-License-Identifier: MIT
// The places that see a whole polyhedron are what is inside all its planes: its kernel (Lee and
// Preparata 1979). Its deepest point is the maximum of a concave function, the least distance from
// a plane, and is found by going away from the nearest plane in shrinking steps (Shor's
// subgradients): near enough, since any point well inside does.
#include "solid/star_core.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "geometry/bounds.h"

namespace sherd {
namespace {

struct Plane {
    glm::dvec3 normal{0.0};  ///< unit, outwards
    double offset = 0;
    double depthOf(const glm::dvec3& p) const { return offset - glm::dot(normal, p); }
};

const Plane* nearestPlane(std::span<const Plane> planes, const glm::dvec3& p, double& depth) {
    const Plane* nearest = nullptr;
    depth = std::numeric_limits<double>::infinity();
    for (const Plane& plane : planes) {
        const double d = plane.depthOf(p);
        if (!(d < depth)) continue;
        depth = d;
        nearest = &plane;
    }
    return nearest;
}

}  // namespace

double leastHeight(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                   const glm::dvec3& apex) {
    const auto twiceArea = [](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
        return glm::length(glm::cross(q - p, r - p));
    };
    const double volume = glm::dot(glm::cross(b - a, c - a), a - apex);
    const double largest = std::max(std::max(twiceArea(a, b, c), twiceArea(a, b, apex)),
                                    std::max(twiceArea(b, c, apex), twiceArea(c, a, apex)));
    return largest > 0 ? volume / largest : 0;
}

glm::dvec3 starCore(std::span<const glm::vec3> positions,
                    std::span<const std::array<uint32_t, 3>> triangles, double flat) {
    std::vector<Plane> planes;
    Bounds bounds;
    glm::dvec3 sum(0.0);
    for (const auto& t : triangles) {
        const glm::dvec3 a = positions[t[0]], b = positions[t[1]], c = positions[t[2]];
        for (const glm::dvec3& p : {a, b, c}) {
            bounds.add(p);
            sum += p;
        }
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double twice = glm::length(normal);
        const double longest =
            std::max(std::max(glm::distance(a, b), glm::distance(b, c)), glm::distance(c, a));
        if (!(twice > flat * longest)) continue;
        planes.push_back({normal / twice, glm::dot(normal / twice, a)});
    }
    glm::dvec3 place = sum / (3.0 * static_cast<double>(triangles.size()));
    glm::dvec3 best = place;
    double deepest = -std::numeric_limits<double>::infinity();
    constexpr int kSteps = 300;
    for (int step = 0; step < kSteps && !planes.empty(); ++step) {
        double depth = 0;
        const Plane* nearest = nearestPlane(planes, place, depth);
        if (depth > deepest) {
            deepest = depth;
            best = place;
        }
        place -= nearest->normal * (0.25 * bounds.diagonal() / (step + 1));
    }
    return best;
}

}  // namespace sherd
