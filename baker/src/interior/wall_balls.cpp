// SPDX-License-Identifier: MIT
// Voronoi cells know the samples of a surface only. Where a wall is thinner than its vertices are
// apart, the ball around a pole reaches through the opposite side between them; the distance to the
// triangles tells, and the shrinking ball of Ma, Bae and Choi (2012) takes its place.
#include "interior/wall_balls.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <thread>

#include "geometry/triangle_bvh.h"
#include "interior/tangent_ball.h"

namespace sherd {

std::vector<std::optional<glm::dvec3>> ballsBetweenWalls(
    const WallSurface& surface, std::span<const std::optional<glm::dvec3>> poles,
    unsigned threads) {
    constexpr double kReach = 0.9;  // of the radius: chords of a curved side cut into any ball
    const std::vector<glm::vec3> rounded(surface.points.begin(), surface.points.end());
    const TriangleBvh bvh(rounded, surface.triangles);
    std::vector<std::optional<glm::dvec3>> centres(poles.size());
    const auto run = [&](size_t first, size_t last) {
        for (size_t v = first; v < last; ++v) {
            if (!poles[v]) continue;
            const double radius = glm::distance(*poles[v], surface.points[v]);
            const auto notAround = [&](uint32_t t) {
                const auto& corners = surface.triangles[t];
                return corners[0] != v && corners[1] != v && corners[2] != v;
            };
            const ClosestPoint hit = bvh.closest(*poles[v], kReach * radius, notAround);
            if (hit.triangle == ClosestPoint::kNone) continue;
            const double shrunk =
                tangentBallRadius(bvh, surface.triangles, static_cast<uint32_t>(v),
                                  glm::dvec3(rounded[v]), surface.normals[v], radius);
            centres[v] = surface.points[v] - shrunk * surface.normals[v];
        }
    };
    const size_t parts = std::clamp<size_t>(poles.size() / 1024, 1, std::max(threads, 1U));
    std::vector<std::thread> workers;
    for (size_t part = 1; part < parts; ++part) {
        workers.emplace_back(run, poles.size() * part / parts, poles.size() * (part + 1) / parts);
    }
    run(0, poles.size() / parts);
    for (std::thread& worker : workers) worker.join();
    return centres;
}

}  // namespace sherd
