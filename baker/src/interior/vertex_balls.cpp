// SPDX-License-Identifier: MIT
// Balls at neighbouring vertices touch neighbouring places, except where the medial surface
// branches. Searching the whole surface costs a hundred times what following a known contact does,
// and most of it is spent on proving that nothing else is in the ball.
#include "interior/vertex_balls.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "parallel/parallel_for.h"

namespace sherd {
namespace {

using Ball = BallTree::Ball;
using Tangent = BallTree::Tangent;

constexpr size_t kChunk = 256;
constexpr size_t kSearches = 64;  // take longer

/// Neighbours mostly touch the same few places. Of a hub's thousands of neighbours only the last
/// are compared.
void addOnce(uint32_t contact, std::vector<uint32_t>& contacts) {
    constexpr std::ptrdiff_t kLook = 16;
    const auto from = contacts.end() - std::min(kLook, std::ssize(contacts));
    if (std::find(from, contacts.end(), contact) == contacts.end()) contacts.push_back(contact);
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
          at_(tangents.size()) {}

    /// In an order in which each vertex is near the one before.
    std::vector<Ball> run(std::span<const uint32_t> order) {
        constexpr size_t kStride = 8;  // one of so many searches
        constexpr int kSweeps = 2;
        std::vector<uint32_t> sample;
        const size_t stride = order.size() < kManyVertices ? 1 : kStride;
        for (size_t i = 0; i < order.size(); i += stride) sample.push_back(order[i]);
        search(sample);
        if (stride == 1) return balls();
        spreadFrom(sample);
        std::vector<uint32_t> unreached;
        for (const uint32_t v : order)
            if (!isKnown(v)) unreached.push_back(v);
        search(unreached);
        std::vector<uint32_t> learners(order.begin(), order.end());
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            std::vector<uint32_t> changed = learn(learners);
            const std::vector<uint32_t> doubted = doubtful(order);
            search(doubted);
            changed.insert(changed.end(), doubted.begin(), doubted.end());
            learners = around(changed);
        }
        return balls();
    }

  private:
    enum Known : uint32_t { kUnknown, kNext, kLearned, kSearched };
    /// At a vertex. What a ball has learnt from a neighbour once it need not learn again: the
    /// rounds tell when either changed.
    struct State {
        Ball ball;
        uint32_t known : 2 = kUnknown;
        uint32_t changedAt : 30 = 0;
        uint32_t learnedAt = 0;
    };
    bool isKnown(uint32_t v) const { return at_[v].known != kUnknown; }

    std::vector<Ball> balls() const {
        std::vector<Ball> result;
        result.reserve(at_.size());
        for (const State& state : at_) result.push_back(state.ball);
        return result;
    }

    void search(const std::vector<uint32_t>& vertices) {
        parallelRuns(vertices.size(), kSearches, threads_, [&](size_t first, size_t last) {
            uint32_t near = BallTree::kNone;
            for (size_t i = first; i < last; ++i) {
                const uint32_t v = vertices[i];
                if (at_[v].ball.contact != BallTree::kNone) near = at_[v].ball.contact;
                at_[v].ball = tree_.largest(tangents_[v], maxRadius_, near);
                near = at_[v].ball.contact;
            }
        });
        for (const uint32_t v : vertices) {
            at_[v].known = kSearched;
            at_[v].changedAt = round_;
        }
    }

    /// Those whose ball is out of proportion to a neighbour's, or touches nothing.
    std::vector<uint32_t> doubtful(std::span<const uint32_t> vertices) {
        std::vector<uint8_t> isIn(vertices.size());
        parallelRuns(vertices.size(), kChunk, threads_, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) isIn[i] = isDoubtful(vertices[i]) ? 1 : 0;
        });
        std::vector<uint32_t> result;
        for (size_t i = 0; i < vertices.size(); ++i)
            if (isIn[i] != 0) result.push_back(vertices[i]);
        return result;
    }
    bool isDoubtful(uint32_t v) const {
        constexpr float kProportion = 1.5F;
        if (at_[v].known == kSearched) return false;
        if (at_[v].ball.contact == BallTree::kNone) return true;
        float least = maxRadius_;
        for (const uint32_t u : rings_.of(v))
            if (isKnown(u)) least = std::min(least, at_[u].ball.radius);
        return at_[v].ball.radius > kProportion * least && isSteep(v, least);
    }

    /// Whether the ball is larger than `least` by more than its edges are long. Beside a crease
    /// balls of no size lie beside balls as large as the edge between them.
    bool isSteep(uint32_t v, float least) const {
        const float rise = at_[v].ball.radius - least;
        const auto isShort = [&](uint32_t u) {
            const glm::vec3 edge = tangents_[u].point - tangents_[v].point;
            return glm::dot(edge, edge) < rise * rise;
        };
        const std::span<const uint32_t> ring = rings_.of(v);
        return std::all_of(ring.begin(), ring.end(), isShort);
    }

    /// Ring by ring from the known ones.
    void spreadFrom(std::vector<uint32_t> front) {
        while (!front.empty()) {
            std::vector<uint32_t> next;
            for (const uint32_t v : front) {
                for (const uint32_t u : rings_.of(v)) {
                    const glm::vec3& n = tangents_[u].normal;
                    if (isKnown(u) || !(glm::dot(n, n) > 0)) continue;
                    at_[u].known = kNext;
                    next.push_back(u);
                }
            }
            for (const uint32_t v : next) {
                at_[v].ball = {maxRadius_, BallTree::kNone};
            }
            learn(next);
            for (const uint32_t v : next) at_[v].known = kLearned;
            front = std::move(next);
        }
    }

    /// The neighbours of some vertices, each once.
    std::vector<uint32_t> around(const std::vector<uint32_t>& vertices) const {
        std::vector<uint8_t> taken(tangents_.size(), 0);
        std::vector<uint32_t> result;
        for (const uint32_t v : vertices) {
            for (const uint32_t u : rings_.of(v)) {
                if (taken[u] != 0 || !isKnown(u)) continue;
                taken[u] = 1;
                result.push_back(u);
            }
        }
        return result;
    }

    /// All of `vertices` at once from the balls that are known now. Returns those whose ball
    /// changed.
    std::vector<uint32_t> learn(const std::vector<uint32_t>& vertices) {
        ++round_;
        learned_.resize(vertices.size());
        parallelRuns(vertices.size(), kChunk, threads_, [&](size_t first, size_t last) {
            std::vector<uint32_t> contacts;
            for (size_t i = first; i < last; ++i) {
                const uint32_t v = vertices[i];
                const State& own = at_[v];
                contacts.clear();
                for (const uint32_t u : rings_.of(v)) {
                    const State& other = at_[u];
                    if (other.known >= kLearned && other.changedAt >= own.learnedAt)
                        addOnce(other.ball.contact, contacts);
                }
                learned_[i] =
                    contacts.empty() ? own.ball : tree_.beside(tangents_[v], own.ball, contacts);
            }
        });
        std::vector<uint32_t> changed;
        for (size_t i = 0; i < vertices.size(); ++i) {
            const uint32_t v = vertices[i];
            at_[v].learnedAt = round_;
            if (at_[v].ball.contact != learned_[i].contact) {
                changed.push_back(v);
                at_[v].changedAt = round_;
            }
            at_[v].ball = learned_[i];
        }
        return changed;
    }

    const BallTree& tree_;
    std::span<const Tangent> tangents_;
    const VertexRings& rings_;
    float maxRadius_;
    unsigned threads_;
    std::vector<State> at_;
    std::vector<Ball> learned_;
    uint32_t round_ = 0;
};

}  // namespace

std::vector<Ball> vertexBalls(const BallTree& tree,
                              std::span<const std::array<uint32_t, 3>> triangles,
                              std::span<const Tangent> tangents, const VertexRings& rings,
                              float maxRadius, unsigned threads) {
    std::vector<uint8_t> taken(tangents.size());
    for (size_t v = 0; v < taken.size(); ++v) {
        const glm::vec3& n = tangents[v].normal;
        taken[v] = glm::dot(n, n) > 0 ? 0 : 1;
    }
    // Without branches: whether a vertex comes for the first time is hard to guess.
    std::vector<uint32_t> order(tangents.size() + 1);
    size_t count = 0;
    for (const uint32_t t : tree.order()) {
        for (const uint32_t v : triangles[t]) {
            order[count] = v;
            count += taken[v] ^ 1U;
            taken[v] = 1;
        }
    }
    order.resize(count);
    return VertexBalls(tree, tangents, rings, maxRadius, threads).run(order);
}

}  // namespace sherd
