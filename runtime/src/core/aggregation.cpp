// SPDX-License-Identifier: MIT
#include "core/aggregation.h"

#include <algorithm>
#include <tuple>

namespace sherd {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

double weightOf(const ElasticNetwork::Edge& edge) {
    const glm::dmat3& s = edge.stiffness.linear;
    return s[0][0] + s[1][1] + s[2][2];
}

}  // namespace

void Aggregation::reserve(size_t nodes, size_t edges) {
    crossings_.reserve(edges);
    counts_.reserve(nodes);
    firstNeighbor_.reserve(nodes + 2);
    neighbors_.reserve(2 * edges);
}

// Y. Notay, "An aggregation-based algebraic multigrid method", ETNA 37 (2010): matching along the
// strongest couplings; twice gives aggregates of four. Nodes left over join their strongest
// neighbour's pair instead of staying alone.
uint32_t Aggregation::pairUp(const ElasticNetwork& network, Vector<uint32_t>& aggregateOf) {
    const uint32_t count = network.nodeCount();
    firstNeighbor_.assign(size_t(count) + 2, 0);
    const auto forEachSide = [&](const auto& visit) {
        for (const ElasticNetwork::Edge& edge : network.edges) {
            if (edge.b == ElasticNetwork::kGround) continue;
            visit(edge.a, edge.b, weightOf(edge));
            visit(edge.b, edge.a, weightOf(edge));
        }
    };
    forEachSide([&](uint32_t from, uint32_t, double) { ++firstNeighbor_[from + 2]; });
    for (size_t n = 2; n < firstNeighbor_.size(); ++n) firstNeighbor_[n] += firstNeighbor_[n - 1];
    neighbors_.resize(firstNeighbor_.back());
    forEachSide([&](uint32_t from, uint32_t to, double weight) {
        neighbors_[firstNeighbor_[from + 1]++] = {to, weight};
    });

    aggregateOf.assign(count, kNone);
    uint32_t aggregates = 0;
    for (const bool pairing : {true, false}) {
        for (uint32_t node = 0; node < count; ++node) {
            if (aggregateOf[node] != kNone) continue;
            uint32_t best = kNone;
            double strongest = 0;
            for (uint32_t n = firstNeighbor_[node]; n < firstNeighbor_[node + 1]; ++n) {
                const Neighbor& neighbor = neighbors_[n];
                const bool isFree = aggregateOf[neighbor.node] == kNone;
                if (isFree != pairing || !(neighbor.weight > strongest)) continue;
                strongest = neighbor.weight;
                best = neighbor.node;
            }
            if (pairing && best != kNone) {
                aggregateOf[node] = aggregateOf[best] = aggregates++;
            } else if (!pairing) {
                aggregateOf[node] = best != kNone ? aggregateOf[best] : aggregates++;
            }
        }
    }
    return aggregates;
}

// P. Vanek, J. Mandel, M. Brezina, "Algebraic multigrid by smoothed aggregation for second and
// fourth order elliptic problems", Computing 56 (1996), without the smoothing: so the coarse matrix
// is again one of a network, and as sparse.
void Aggregation::merge(const ElasticNetwork& fine, std::span<const uint32_t> aggregateOf,
                        uint32_t count, ElasticNetwork& coarse) {
    coarse.centers.assign(count, glm::dvec3(0));
    counts_.assign(count, 0);
    for (uint32_t node = 0; node < fine.nodeCount(); ++node) {
        coarse.centers[aggregateOf[node]] += fine.centers[node];
        ++counts_[aggregateOf[node]];
    }
    for (uint32_t c = 0; c < count; ++c) coarse.centers[c] /= double(std::max(counts_[c], 1U));

    crossings_.clear();
    for (uint32_t e = 0; e < fine.edges.size(); ++e) {
        const ElasticNetwork::Edge& edge = fine.edges[e];
        uint32_t a = aggregateOf[edge.a];
        uint32_t b = edge.b == ElasticNetwork::kGround ? edge.b : aggregateOf[edge.b];
        if (a == b) continue;
        if (a > b) std::swap(a, b);
        crossings_.push_back({a, b, e});
    }
    std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& x, const Crossing& y) {
        return std::tie(x.a, x.b, x.edge) < std::tie(y.a, y.b, y.edge);
    });
    coarse.edges.clear();
    for (size_t i = 0; i < crossings_.size();) {
        const size_t first = i;
        ElasticNetwork::Edge merged;
        merged.a = crossings_[first].a;
        merged.b = crossings_[first].b;
        const auto isSame = [&](size_t k) {
            return k < crossings_.size() && crossings_[k].a == merged.a &&
                   crossings_[k].b == merged.b;
        };
        glm::dvec3 middle(0);
        double weights = 0;
        for (; isSame(i); ++i) {
            const ElasticNetwork::Edge& edge = fine.edges[crossings_[i].edge];
            middle += weightOf(edge) * fine.placeOf(edge);
            weights += weightOf(edge);
        }
        middle /= weights;
        for (size_t k = first; k < i; ++k) {
            const ElasticNetwork::Edge& edge = fine.edges[crossings_[k].edge];
            merged.stiffness += stiffnessFrom(edge.stiffness, fine.placeOf(edge) - middle);
        }
        merged.armA = middle - coarse.centers[merged.a];
        if (merged.b != ElasticNetwork::kGround) merged.armB = middle - coarse.centers[merged.b];
        coarse.edges.push_back(merged);
    }
}

}  // namespace sherd
