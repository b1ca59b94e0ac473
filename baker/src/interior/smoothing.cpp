// SPDX-License-Identifier: MIT
// Laplacian smoothing with equal weights, and G. Taubin, "A Signal Processing Approach to Fair
// Surface Design" (1995) when mu is not 0. Cotangent weights were tried before the poles and
// dropped: see medial.cpp.
#include "interior/smoothing.h"

#include <algorithm>

namespace sherd {

std::vector<glm::dvec3> smoothed(std::span<const glm::dvec3> points,
                                 std::span<const std::array<uint32_t, 3>> triangles,
                                 const SmoothingOptions& options) {
    std::vector<glm::dvec3> current(points.begin(), points.end());
    std::vector<uint32_t> neighbours(points.size(), 0);
    for (const auto& t : triangles) {
        for (const uint32_t v : t) neighbours[v] += 2;
    }
    std::vector<glm::dvec3> sum(points.size());
    const auto step = [&](double factor) {
        std::fill(sum.begin(), sum.end(), glm::dvec3(0.0));
        for (const auto& t : triangles) {
            const glm::dvec3 a = current[t[0]], b = current[t[1]], c = current[t[2]];
            sum[t[0]] += b + c;
            sum[t[1]] += c + a;
            sum[t[2]] += a + b;
        }
        for (size_t v = 0; v < current.size(); ++v) {
            if (neighbours[v] == 0) continue;
            current[v] += factor * (sum[v] / static_cast<double>(neighbours[v]) - current[v]);
        }
    };
    for (int i = 0; i < options.iterations; ++i) {
        step(options.lambda);
        if (options.mu != 0) step(options.mu);
    }
    return current;
}

}  // namespace sherd
