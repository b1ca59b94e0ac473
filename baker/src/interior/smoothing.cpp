// SPDX-License-Identifier: MIT
// Laplacian smoothing with equal weights, and G. Taubin, "A Signal Processing Approach to Fair
// Surface Design" (1995) when mu is not 0. Cotangent weights were tried before the poles and
// dropped: see medial.cpp.
#include "interior/smoothing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sherd {
namespace {

/// Steps of each point. Smoothing k times blurs over about sqrt(k) edges; points with longer edges
/// take fewer steps, so that coarse meshes keep their shape.
std::vector<int> stepsWithin(std::span<const glm::dvec3> points,
                             std::span<const std::array<uint32_t, 3>> triangles,
                             const SmoothingOptions& options) {
    std::vector<int> steps(points.size(), options.iterations);
    if (std::isinf(options.reach)) return steps;
    std::vector<double> lengths(points.size(), 0.0);
    std::vector<uint32_t> edges(points.size(), 0);
    for (const auto& t : triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = t[k], b = t[(k + 1) % 3];
            const double length = glm::distance(points[a], points[b]);
            lengths[a] += length;
            lengths[b] += length;
            ++edges[a];
            ++edges[b];
        }
    }
    for (size_t v = 0; v < points.size(); ++v) {
        if (edges[v] == 0) continue;
        const double perStep = lengths[v] / edges[v];
        const double most = options.reach * options.reach;
        if (options.iterations * perStep * perStep > most)
            steps[v] = static_cast<int>(most / (perStep * perStep));
    }
    return steps;
}

}  // namespace

std::vector<glm::dvec3> smoothed(std::span<const glm::dvec3> points,
                                 std::span<const std::array<uint32_t, 3>> triangles,
                                 const SmoothingOptions& options) {
    std::vector<glm::dvec3> current(points.begin(), points.end());
    std::vector<uint32_t> neighbours(points.size(), 0);
    for (const auto& t : triangles) {
        for (const uint32_t v : t) neighbours[v] += 2;
    }
    std::vector<glm::dvec3> sum(points.size());
    const std::vector<int> steps = stepsWithin(points, triangles, options);
    const auto step = [&](double factor, int done) {
        std::fill(sum.begin(), sum.end(), glm::dvec3(0.0));
        for (const auto& t : triangles) {
            const glm::dvec3 a = current[t[0]], b = current[t[1]], c = current[t[2]];
            sum[t[0]] += b + c;
            sum[t[1]] += c + a;
            sum[t[2]] += a + b;
        }
        for (size_t v = 0; v < current.size(); ++v) {
            if (neighbours[v] == 0 || steps[v] <= done) continue;
            current[v] += factor * (sum[v] / static_cast<double>(neighbours[v]) - current[v]);
        }
    };
    for (int i = 0; i < options.iterations; ++i) {
        step(options.lambda, i);
        if (options.mu != 0) step(options.mu, i);
    }
    return current;
}

}  // namespace sherd
