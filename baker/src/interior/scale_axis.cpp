// SPDX-License-Identifier: MIT
#include "interior/scale_axis.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "parallel/parallel_for.h"

namespace sherd {

std::vector<uint32_t> coveringBalls(std::span<const glm::vec3> centres,
                                    std::span<const float> radii, const VertexRings& rings,
                                    float scale, unsigned threads) {
    constexpr int kMaxRounds = 1000;
    constexpr size_t kChunk = 1024;  // vertices
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
    struct News {
        uint32_t vertex, ball;  // that covers it better
        float reach;
    };
    std::vector<std::vector<News>> news;  // chunk by chunk of the front
    for (int round = 0; round < kMaxRounds && !front.empty(); ++round) {
        news.resize((front.size() + kChunk - 1) / kChunk);
        parallelRuns(front.size(), kChunk, threads, [&](size_t first, size_t last) {
            std::vector<News>& found = news[first / kChunk];
            found.clear();
            for (size_t i = first; i < last; ++i) {
                const uint32_t j = best[front[i]];
                const float most = scale * radii[j];
                for (const uint32_t v : rings.of(front[i])) {
                    // Mostly there is no way, which takes no root to tell.
                    if (best[v] == j || !(most > bestReach[v])) continue;
                    const float r = reach(j, v);
                    if (r > bestReach[v]) found.push_back({v, j, r});
                }
            }
        });
        front.clear();
        const auto take = [&](const News& item) {
            const uint32_t v = item.vertex;
            if (!(item.reach > bestReach[v])) return;
            best[v] = item.ball;
            bestReach[v] = item.reach;
            if (inNext[v] != 0) return;
            inNext[v] = 1;
            front.push_back(v);
        };
        for (const std::vector<News>& found : news) std::for_each(found.begin(), found.end(), take);
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
