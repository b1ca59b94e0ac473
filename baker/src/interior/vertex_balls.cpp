// SPDX-License-Identifier: MIT
// Balls at neighbouring vertices touch neighbouring places, except where the medial surface
// branches. Searching the whole surface costs a hundred times what following a known contact does,
// and most of it is spent on proving that nothing else is in the ball.
#include "interior/vertex_balls.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "geometry/parallel_for.h"

namespace sherd {
namespace {

using Ball = BallTree::Ball;
using Tangent = BallTree::Tangent;

constexpr size_t kChunk = 256;

/// Bits 0, 3, 6, ... of the result are the lowest ten of x.
uint32_t spread(uint32_t x) {
    x = (x | (x << 16)) & 0x030000ffU;
    x = (x | (x << 8)) & 0x0300f00fU;
    x = (x | (x << 4)) & 0x030c30c3U;
    return (x | (x << 2)) & 0x09249249U;
}

/// Those with a normal, along a Morton curve: each is near the one before.
std::vector<uint32_t> alongCurve(std::span<const Tangent> tangents, const VertexRings& rings) {
    std::vector<std::pair<uint32_t, uint32_t>> order;
    order.reserve(tangents.size());
    for (uint32_t v = 0; v < tangents.size(); ++v) {
        const auto& [point, normal] = tangents[v];
        if (rings.of(v).empty() || !(glm::dot(normal, normal) > 0)) continue;
        const glm::uvec3 cell(glm::clamp(point + 0.5F, 0.0F, 1.0F) * 1023.0F);
        order.emplace_back(spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2, v);
    }
    std::sort(order.begin(), order.end());
    std::vector<uint32_t> vertices;
    vertices.reserve(order.size());
    for (const auto& [code, v] : order) vertices.push_back(v);
    return vertices;
}

class VertexBalls {
  public:
    VertexBalls(const BallTree& tree, std::span<const Tangent> tangents, const VertexRings& rings,
                float maxRadius, unsigned threads)
        : tree_(tree),
          tangents_(tangents),
          rings_(rings),
          maxRadius_(maxRadius),
          threads_(threads),
          balls_(tangents.size()),
          known_(tangents.size(), 0) {}

    std::vector<Ball> run() {
        constexpr size_t kStride = 8;  // one of so many searches
        constexpr int kSweeps = 2;
        const std::vector<uint32_t> order = alongCurve(tangents_, rings_);
        std::vector<uint32_t> sample;
        const size_t stride = order.size() < kManyVertices ? 1 : kStride;
        for (size_t i = 0; i < order.size(); i += stride) sample.push_back(order[i]);
        search(sample);
        if (stride == 1) return std::move(balls_);
        spreadFrom(sample);
        std::vector<uint32_t> unreached;
        for (const uint32_t v : order)
            if (known_[v] == 0) unreached.push_back(v);
        search(unreached);
        std::vector<uint32_t> learners = order;
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            std::vector<uint32_t> changed = learn(learners);
            const std::vector<uint32_t> doubted = doubtful(order);
            search(doubted);
            changed.insert(changed.end(), doubted.begin(), doubted.end());
            learners = around(changed);
        }
        return std::move(balls_);
    }

  private:
    void search(const std::vector<uint32_t>& vertices) {
        parallelRuns(vertices.size(), kChunk, threads_, [&](size_t first, size_t last) {
            uint32_t near = BallTree::kNone;
            for (size_t i = first; i < last; ++i) {
                const uint32_t v = vertices[i];
                if (balls_[v].contact != BallTree::kNone) near = balls_[v].contact;
                balls_[v] = tree_.largest(tangents_[v], maxRadius_, near);
                near = balls_[v].contact;
            }
        });
        for (const uint32_t v : vertices) known_[v] = kSearched;
    }

    /// Those whose ball is out of proportion to a neighbour's, or touches nothing.
    std::vector<uint32_t> doubtful(const std::vector<uint32_t>& vertices) {
        constexpr float kProportion = 1.5F;
        std::vector<uint32_t> result;
        for (const uint32_t v : vertices) {
            if (known_[v] == kSearched) continue;
            float least = maxRadius_;
            for (const uint32_t u : rings_.of(v))
                if (known_[u] != 0) least = std::min(least, balls_[u].radius);
            if (balls_[v].contact == BallTree::kNone || balls_[v].radius > kProportion * least)
                result.push_back(v);
        }
        return result;
    }

    /// Ring by ring from the known ones.
    void spreadFrom(std::vector<uint32_t> front) {
        while (!front.empty()) {
            std::vector<uint32_t> next;
            for (const uint32_t v : front) {
                for (const uint32_t u : rings_.of(v)) {
                    const glm::vec3& n = tangents_[u].normal;
                    if (known_[u] != 0 || !(glm::dot(n, n) > 0)) continue;
                    known_[u] = kNext;
                    next.push_back(u);
                }
            }
            for (const uint32_t v : next) {
                balls_[v] = {maxRadius_, BallTree::kNone};
            }
            learn(next);
            for (const uint32_t v : next) known_[v] = kLearned;
            front = std::move(next);
        }
    }

    /// The neighbours of some vertices, each once.
    std::vector<uint32_t> around(const std::vector<uint32_t>& vertices) const {
        std::vector<uint8_t> taken(tangents_.size(), 0);
        std::vector<uint32_t> result;
        for (const uint32_t v : vertices) {
            for (const uint32_t u : rings_.of(v)) {
                if (taken[u] != 0 || known_[u] == kUnknown) continue;
                taken[u] = 1;
                result.push_back(u);
            }
        }
        return result;
    }

    /// All of `vertices` at once from the balls that are known now. Returns those whose ball
    /// changed.
    std::vector<uint32_t> learn(const std::vector<uint32_t>& vertices) {
        learned_.resize(vertices.size());
        parallelRuns(vertices.size(), kChunk, threads_, [&](size_t first, size_t last) {
            std::vector<uint32_t> contacts;
            for (size_t i = first; i < last; ++i) {
                const uint32_t v = vertices[i];
                contacts.clear();
                for (const uint32_t u : rings_.of(v))
                    if (known_[u] == kLearned || known_[u] == kSearched)
                        contacts.push_back(balls_[u].contact);
                std::sort(contacts.begin(), contacts.end());
                contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
                learned_[i] = tree_.beside(tangents_[v], balls_[v], contacts);
            }
        });
        std::vector<uint32_t> changed;
        for (size_t i = 0; i < vertices.size(); ++i) {
            Ball& ball = balls_[vertices[i]];
            if (ball.contact != learned_[i].contact) changed.push_back(vertices[i]);
            ball = learned_[i];
        }
        return changed;
    }

    const BallTree& tree_;
    std::span<const Tangent> tangents_;
    const VertexRings& rings_;
    float maxRadius_;
    unsigned threads_;
    std::vector<Ball> balls_, learned_;
    enum Known : uint8_t { kUnknown, kNext, kLearned, kSearched };
    std::vector<uint8_t> known_;
};

}  // namespace

std::vector<Ball> vertexBalls(const BallTree& tree, std::span<const Tangent> tangents,
                              const VertexRings& rings, float maxRadius, unsigned threads) {
    return VertexBalls(tree, tangents, rings, maxRadius, threads).run();
}

}  // namespace sherd
