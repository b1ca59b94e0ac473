// SPDX-License-Identifier: MIT
#include "interior/vertex_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "parallel/parallel_for.h"

namespace sherd {
namespace {

constexpr size_t kNormalGrain = 1024;

/// Of a vector above the axis (sine > 0) with it, to 2e-8, as atan2 in a fifth of the time and the
/// same on every system. M. Abramowitz, I. A. Stegun, "Handbook of Mathematical Functions" (1964),
/// 4.4.49.
double angleOf(double sine, double cosine) {
    constexpr std::array<double, 8> kSeries{-0.3333314528, 0.1999355085,  -0.1420889944,
                                            0.1065626393,  -0.0752896400, 0.0429096138,
                                            -0.0161657367, 0.0028662257};
    const double side = std::abs(cosine);
    const bool isSteep = sine > side;
    const double t = isSteep ? side / sine : sine / side;
    double sum = 0;
    for (size_t k = kSeries.size(); k > 0; --k) sum = (sum + kSeries[k - 1]) * (t * t);
    const double angle = t + t * sum;
    const double upright = isSteep ? std::numbers::pi / 2 - angle : angle;
    return cosine < 0 ? std::numbers::pi - upright : upright;
}

Facet facetOf(const std::array<glm::dvec3, 3>& p) {
    const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double twiceArea = glm::length(cross);
    Facet facet;
    if (!(twiceArea > 0)) return facet;
    facet.normal = cross / twiceArea;
    const glm::dvec3 ab = p[1] - p[0], ac = p[2] - p[0], bc = p[2] - p[1];
    facet.angles[0] = angleOf(twiceArea, glm::dot(ab, ac));
    facet.angles[1] = angleOf(twiceArea, -glm::dot(ab, bc));
    facet.angles[2] = std::max(0.0, std::numbers::pi - facet.angles[0] - facet.angles[1]);
    return facet;
}

/// Opposite sheets welded together leave a sum of rounding errors only.
glm::dvec3 unit(const glm::dvec3& n) {
    const double length = glm::length(n);
    return length > 1e-9 ? n / length : glm::dvec3(0.0);
}

}  // namespace

std::vector<Facet> facetsOf(std::span<const glm::dvec3> points,
                            std::span<const std::array<uint32_t, 3>> triangles, unsigned threads) {
    std::vector<Facet> facets(triangles.size());
    parallelRuns(triangles.size(), kNormalGrain, threads, [&](size_t first, size_t last) {
        for (size_t t = first; t < last; ++t) {
            const auto& [a, b, c] = triangles[t];
            facets[t] = facetOf({points[a], points[b], points[c]});
        }
    });
    return facets;
}

std::vector<glm::dvec3> vertexNormals(std::span<const Facet> facets, const VertexCorners& corners,
                                      size_t vertices, unsigned threads) {
    std::vector<glm::dvec3> normals(vertices);
    parallelRuns(vertices, kNormalGrain, threads, [&](size_t first, size_t last) {
        for (size_t v = first; v < last; ++v) {
            glm::dvec3 sum(0.0);
            for (const uint32_t c : corners.of(static_cast<uint32_t>(v)))
                sum += facets[c / 3].angles[c % 3] * facets[c / 3].normal;
            normals[v] = unit(sum);
        }
    });
    return normals;
}

std::vector<std::array<glm::vec3, 3>> cornerNormals(
    std::span<const Facet> facets, std::span<const std::array<uint32_t, 3>> triangles,
    const VertexCorners& corners, std::span<const glm::dvec3> vertexNormals,
    std::span<const uint8_t> wanted, double creaseAngle, unsigned threads) {
    const double cosine = std::cos(creaseAngle), cosineOfHalf = std::cos(creaseAngle / 2);
    // Whether no two triangles around the vertex can turn from each other by the crease angle.
    std::vector<uint8_t> isSmooth(vertexNormals.size());
    parallelRuns(isSmooth.size(), kNormalGrain, threads, [&](size_t first, size_t last) {
        for (size_t v = first; v < last; ++v) {
            const std::span<const uint32_t> around = corners.of(static_cast<uint32_t>(v));
            isSmooth[v] = std::all_of(around.begin(), around.end(), [&](uint32_t c) {
                return glm::dot(facets[c / 3].normal, vertexNormals[v]) > cosineOfHalf;
            });
        }
    });
    const auto normalAt = [&](size_t t, size_t k) {
        const uint32_t v = triangles[t][k];
        if (isSmooth[v] != 0) return glm::vec3(vertexNormals[v]);
        glm::dvec3 sum(0.0);
        for (const uint32_t c : corners.of(v)) {
            const Facet& other = facets[c / 3];
            if (c / 3 == t || glm::dot(other.normal, facets[t].normal) > cosine)
                sum += other.angles[c % 3] * other.normal;
        }
        return glm::vec3(unit(sum));
    };
    std::vector<std::array<glm::vec3, 3>> result(triangles.size());
    parallelRuns(triangles.size(), kNormalGrain, threads, [&](size_t first, size_t last) {
        for (size_t t = first; t < last; ++t) {
            if (wanted[t] == 0) continue;
            for (size_t k = 0; k < 3; ++k) result[t][k] = normalAt(t, k);
        }
    });
    return result;
}

}  // namespace sherd
