// SPDX-License-Identifier: MIT
// Seeds far from each other, parts that grow around them, and exchanges along their borders: the
// steps of Diekmann, Preis, Schlimbach and Walshaw 2000, Shape-optimized mesh partitioning and load
// balancing for parallel adaptive FEM, on the graph as it is. Graphs here have some thousand nodes:
// the multilevel coarsening of Karypis and Kumar 1998 would pay only far above.
#include "graph/graph_partition.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "graph/part_growth.h"
#include "graph/part_refinement.h"

namespace sherd {
namespace {

/// How many parts each component gets: one at least, the next always to the one with the largest.
std::vector<uint32_t> shareOut(const std::vector<std::vector<uint32_t>>& components,
                               const WeightedGraph& graph, uint32_t parts) {
    std::vector<double> weights;
    for (const std::vector<uint32_t>& nodes : components) {
        double& sum = weights.emplace_back(0);
        for (const uint32_t node : nodes) sum += graph.weight(node);
    }
    if (std::all_of(weights.begin(), weights.end(), [](double weight) { return weight <= 0; }))
        for (size_t c = 0; c < components.size(); ++c)
            weights[c] = static_cast<double>(components[c].size());
    std::vector<uint32_t> shares(components.size(), 1);
    using Entry = std::pair<double, uint32_t>;  // the lower component first among equals
    const auto less = [](const Entry& a, const Entry& b) {
        return a.first != b.first ? a.first < b.first : a.second > b.second;
    };
    std::priority_queue<Entry, std::vector<Entry>, decltype(less)> largest(less);
    for (uint32_t c = 0; c < components.size(); ++c)
        if (components[c].size() > 1) largest.emplace(weights[c], c);
    for (size_t made = components.size(); made < parts && !largest.empty(); ++made) {
        const uint32_t c = largest.top().second;
        largest.pop();
        if (++shares[c] < components[c].size()) largest.emplace(weights[c] / shares[c], c);
    }
    return shares;
}

WeightedGraph withoutZeros(const WeightedGraph& graph, std::span<const uint32_t> nodes) {
    WeightedGraph part = graph.part(nodes);
    for (uint32_t n = 0; n < part.count(); ++n)
        if (part.weight(n) > 0) return part;
    part.weighAlike();
    return part;
}

/// The cheapest of some rounds, each around the middles of the parts before.
std::vector<uint32_t> grow(const WeightedGraph& graph, const PartitionCost& cost,
                           std::vector<uint32_t> seeds, GrowthOrder order) {
    constexpr int kRounds = 6;  // more changed nothing on grids and on Voronoi cells
    std::vector<uint32_t> best;
    double least = 0;
    for (int round = 0; round < kRounds; ++round) {
        std::vector<uint32_t> part = growParts(graph, seeds, order);
        std::vector<uint32_t> middles = middlesOf(graph, part, cost.parts());
        if (const double now = cost.of(part); best.empty() || now < least) {
            best = std::move(part);
            least = now;
        }
        if (middles == seeds) break;
        seeds = std::move(middles);
    }
    return best;
}

std::vector<uint32_t> divide(const WeightedGraph& graph, uint32_t parts, double evenness) {
    if (parts <= 1) return std::vector<uint32_t>(graph.count(), 0);
    std::vector<uint32_t> part(graph.count());
    if (parts >= graph.count()) {
        for (uint32_t n = 0; n < graph.count(); ++n) part[n] = n;
        return part;
    }
    const PartitionCost cost(graph, parts, evenness);
    const std::vector<uint32_t> seeds = spreadSeeds(graph, parts);
    std::vector<uint32_t> best;
    for (const GrowthOrder order : {GrowthOrder::lightest, GrowthOrder::mostJoined}) {
        part = grow(graph, cost, seeds, order);
        refineParts(graph, cost, part);
        if (best.empty() || cost.of(part) < cost.of(best)) best = part;
    }
    return best;
}

}  // namespace

GraphPartition partitionGraph(const WeightedGraph& graph, const PartitionOptions& options) {
    GraphPartition result;
    const std::vector<uint32_t> label = graph.components(result.components);
    std::vector<std::vector<uint32_t>> components(result.components);
    for (uint32_t n = 0; n < graph.count(); ++n) components[label[n]].push_back(n);
    const std::vector<uint32_t> shares = shareOut(components, graph, options.parts);
    result.part.resize(graph.count());
    uint32_t first = 0;
    for (size_t c = 0; c < components.size(); ++c) {
        const std::vector<uint32_t> part =
            divide(withoutZeros(graph, components[c]), shares[c], options.evenness);
        for (size_t n = 0; n < part.size(); ++n) result.part[components[c][n]] = first + part[n];
        first += shares[c];
    }
    constexpr uint32_t kOpen = 0xFFFFFFFFU;
    std::vector<uint32_t> number(first, kOpen);
    for (uint32_t& part : result.part) {
        if (number[part] == kOpen) number[part] = result.parts++;
        part = number[part];
    }
    return result;
}

}  // namespace sherd
