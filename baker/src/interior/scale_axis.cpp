// SPDX-License-Identifier: MIT
#include "interior/scale_axis.h"

#include <glm/geometric.hpp>
#include <utility>

namespace sherd {

std::vector<uint32_t> coveringBalls(std::span<const glm::vec3> centres,
                                    std::span<const float> radii, const VertexRings& rings,
                                    float scale) {
    constexpr int kMaxRounds = 1000;
    const auto count = static_cast<uint32_t>(centres.size());
    // How far ball j, scaled, reaches beyond the centre of ball v.
    const auto reach = [&](uint32_t j, uint32_t v) {
        return scale * radii[j] - glm::distance(centres[j], centres[v]);
    };
    std::vector<uint32_t> best(count), front(count);
    std::vector<float> bestReach(count);
    for (uint32_t v = 0; v < count; ++v) {
        best[v] = front[v] = v;
        bestReach[v] = scale * radii[v];
    }
    std::vector<uint8_t> inNext(count, 0);
    std::vector<std::pair<uint32_t, uint32_t>> news;  // vertex, what covers it better
    for (int round = 0; round < kMaxRounds && !front.empty(); ++round) {
        news.clear();
        for (const uint32_t u : front) {
            for (const uint32_t v : rings.of(u)) {
                if (best[v] != best[u] && reach(best[u], v) > bestReach[v])
                    news.emplace_back(v, best[u]);
            }
        }
        front.clear();
        for (const auto& [v, j] : news) {
            const float r = reach(j, v);
            if (!(r > bestReach[v])) continue;
            best[v] = j;
            bestReach[v] = r;
            if (inNext[v] != 0) continue;
            inNext[v] = 1;
            front.push_back(v);
        }
        for (const uint32_t v : front) inNext[v] = 0;
    }
    // Rounding must not let a ball be covered by its like.
    constexpr float kMore = 1 + 1e-5F;
    for (uint32_t v = 0; v < count; ++v) {
        if (radii[v] >= 0 && !(bestReach[v] > kMore * scale * radii[v])) best[v] = v;
    }
    return best;
}

}  // namespace sherd
