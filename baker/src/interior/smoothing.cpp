// SPDX-License-Identifier: MIT
// Laplacian smoothing with equal weights, and G. Taubin, "A Signal Processing Approach to Fair
// Surface Design" (1995) when mu is not 0. Cotangent weights were tried before the poles and
// dropped: see medial.cpp.
#include "interior/smoothing.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "parallel/parallel_for.h"

namespace sherd {
namespace {

constexpr size_t kSmoothingGrain = 2048;

/// Steps of each point. Smoothing k times blurs over about sqrt(k) edges; points with longer edges
/// take fewer steps, so that coarse meshes keep their shape.
std::vector<int> stepsWithin(std::span<const glm::dvec3> points, const VertexRings& rings,
                             const SmoothingOptions& options, unsigned threads) {
    std::vector<int> steps(points.size(), options.iterations);
    if (std::isinf(options.reach)) return steps;
    const double most = options.reach * options.reach;
    parallelRuns(points.size(), kSmoothingGrain, threads, [&](size_t first, size_t last) {
        for (size_t v = first; v < last; ++v) {
            const std::span<const uint32_t> ring = rings.of(static_cast<uint32_t>(v));
            if (ring.empty()) continue;
            double length = 0;
            for (const uint32_t u : ring) length += glm::distance(points[v], points[u]);
            const double perStep = length / static_cast<double>(ring.size());
            if (options.iterations * perStep * perStep > most)
                steps[v] = static_cast<int>(most / (perStep * perStep));
        }
    });
    return steps;
}

}  // namespace

std::vector<glm::dvec3> smoothed(std::span<const glm::dvec3> points, const VertexRings& rings,
                                 const SmoothingOptions& options, unsigned threads) {
    std::vector<glm::dvec3> current(points.begin(), points.end()), moved(points.size());
    const std::vector<int> steps = stepsWithin(points, rings, options, threads);
    const auto step = [&](double factor, int done) {
        parallelRuns(points.size(), kSmoothingGrain, threads, [&](size_t first, size_t last) {
            for (size_t v = first; v < last; ++v) {
                moved[v] = current[v];
                const std::span<const uint32_t> ring = rings.of(static_cast<uint32_t>(v));
                if (ring.empty() || steps[v] <= done) continue;
                glm::dvec3 sum(0.0);
                for (const uint32_t u : ring) sum += current[u];
                moved[v] += factor * (sum / static_cast<double>(ring.size()) - current[v]);
            }
        });
        current.swap(moved);
    };
    for (int i = 0; i < options.iterations; ++i) {
        step(options.lambda, i);
        if (options.mu != 0) step(options.mu, i);
    }
    return current;
}

}  // namespace sherd
