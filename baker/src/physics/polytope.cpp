// SPDX-License-Identifier: MIT
#include "physics/polytope.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace sherd {
namespace {

double height(const HalfSpace& wall, const glm::dvec3& p) {
    return glm::dot(wall.normal, p) - wall.offset;
}

}  // namespace

glm::dvec3 wallCrossing(glm::dvec3 a, double ha, glm::dvec3 b, double hb) {
    if (ha > hb) {
        std::swap(a, b);
        std::swap(ha, hb);
    }
    return a + (b - a) * (ha / (ha - hb));
}

double volumeOf(const Polytope& polytope) {
    if (polytope.empty()) return 0;
    const glm::dvec3 apex = polytope.points[0];
    double sum = 0;
    for (const auto& f : polytope.faces)
        sum += glm::dot(polytope.points[f[0]] - apex,
                        glm::cross(polytope.points[f[1]] - apex, polytope.points[f[2]] - apex));
    return sum / 6;
}

/// Faces carry slabs, edges wedges of cylinders, and the corners together a ball (J. Steiner,
/// 1840).
double roundedVolume(const Polytope& polytope, double margin) {
    const auto sides = [&](const std::array<uint32_t, 3>& f) {
        const glm::dvec3& a = polytope.points[f[0]];
        return glm::cross(polytope.points[f[1]] - a, polytope.points[f[2]] - a);
    };
    double twiceArea = 0;
    struct Side {
        uint64_t edge;
        double length;
        glm::dvec3 normal;
    };
    std::vector<Side> edges;  // each twice
    for (const auto& f : polytope.faces) {
        const glm::dvec3 n = sides(f);
        twiceArea += glm::length(n);
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = f[k], b = f[(k + 1) % 3];
            edges.push_back({uint64_t{std::min(a, b)} << 32 | std::max(a, b),
                             glm::distance(polytope.points[a], polytope.points[b]), n});
        }
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const Side& x, const Side& y) { return x.edge < y.edge; });
    double bend = 0;  // lengths of edges times the angles between the normals beside them
    for (size_t i = 0; i + 1 < edges.size(); i += 2) {
        const glm::dvec3 &n = edges[i].normal, &m = edges[i + 1].normal;
        bend += edges[i].length * std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m));
    }
    return volumeOf(polytope) +
           margin * (twiceArea / 2 + margin * (bend / 2 + margin * 4 / 3 * M_PI));
}

double volumeBeyond(const Polytope& polytope, const HalfSpace& wall) {
    // Seen from a point of the wall, the cap in it has no volume.
    const glm::dvec3 apex = wall.normal * wall.offset;
    double sum = 0;
    for (const auto& f : polytope.faces) {
        std::array<glm::dvec3, 4> loop{};
        size_t count = 0;
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec3& a = polytope.points[f[k]];
            const glm::dvec3& b = polytope.points[f[(k + 1) % 3]];
            const double ha = height(wall, a), hb = height(wall, b);
            if (ha >= 0) loop[count++] = a;
            if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0))
                loop[count++] = wallCrossing(a, ha, b, hb);
        }
        for (size_t k = 2; k < count; ++k)
            sum += glm::dot(loop[0] - apex, glm::cross(loop[k - 1] - apex, loop[k] - apex));
    }
    return sum / 6;
}

Polytope clipped(const Polytope& polytope, const HalfSpace& wall) {
    std::vector<double> heights;
    std::vector<glm::dvec3> kept;
    for (const glm::dvec3& p : polytope.points) {
        heights.push_back(height(wall, p));
        if (heights.back() <= 0) kept.push_back(p);
    }
    if (kept.size() == polytope.points.size()) return polytope;
    for (const auto& f : polytope.faces) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = f[k], b = f[(k + 1) % 3];
            // Every edge is in two faces, once in either direction.
            if (heights[a] < 0 && heights[b] > 0)
                kept.push_back(
                    wallCrossing(polytope.points[a], heights[a], polytope.points[b], heights[b]));
        }
    }
    return hullOf(kept);
}

std::vector<HalfSpace> halfSpacesOf(const Polytope& polytope) {
    std::vector<HalfSpace> out;
    for (const auto& f : polytope.faces) {
        const glm::dvec3& a = polytope.points[f[0]];
        const glm::dvec3 n = glm::cross(polytope.points[f[1]] - a, polytope.points[f[2]] - a);
        const double length = glm::length(n);
        if (!(length > 0)) continue;
        const glm::dvec3 normal = n / length;
        const bool known = std::any_of(out.begin(), out.end(), [&](const HalfSpace& h) {
            const glm::dvec3 d = h.normal - normal;
            return glm::dot(d, d) < 1e-14;
        });
        if (!known) out.push_back({normal, reachOf(polytope.points, normal).high});
    }
    return out;
}

Reach reachOf(std::span<const glm::dvec3> points, const glm::dvec3& direction) {
    Reach reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const glm::dvec3& p : points) {
        const double d = glm::dot(direction, p);
        reach.low = std::min(reach.low, d);
        reach.high = std::max(reach.high, d);
    }
    return reach;
}

}  // namespace sherd
