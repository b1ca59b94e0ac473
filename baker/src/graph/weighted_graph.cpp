// SPDX-License-Identifier: MIT
#include "graph/weighted_graph.h"

#include <algorithm>
#include <map>
#include <utility>

namespace sherd {

WeightedGraph::WeightedGraph(std::vector<double> weights, std::vector<glm::dvec3> places,
                             std::span<const Edge> edges)
    : weights_(std::move(weights)), places_(std::move(places)) {
    std::map<std::pair<uint32_t, uint32_t>, double> sums;
    for (const Edge& edge : edges)
        if (edge.a != edge.b && edge.strength > 0)
            sums[std::minmax(edge.a, edge.b)] += edge.strength;
    start_.assign(weights_.size() + 1, 0);
    for (const auto& [ends, strength] : sums) {
        ++start_[ends.first + 1];
        ++start_[ends.second + 1];
        strength_ += strength;
    }
    for (size_t n = 1; n < start_.size(); ++n) start_[n] += start_[n - 1];
    links_.resize(2 * sums.size());
    std::vector<uint32_t> next(start_.begin(), start_.end() - 1);
    // A node's lower neighbours come first, both in the order of the sums: ascending.
    for (const auto& [ends, strength] : sums) links_[next[ends.second]++] = {ends.first, strength};
    for (const auto& [ends, strength] : sums) links_[next[ends.first]++] = {ends.second, strength};
}

std::vector<uint32_t> WeightedGraph::components(uint32_t& number) const {
    constexpr uint32_t kOpen = 0xFFFFFFFFU;
    std::vector<uint32_t> label(count(), kOpen), stack;
    number = 0;
    for (uint32_t first = 0; first < count(); ++first) {
        if (label[first] != kOpen) continue;
        label[first] = number;
        stack.push_back(first);
        while (!stack.empty()) {
            const uint32_t node = stack.back();
            stack.pop_back();
            for (const Link& link : links(node)) {
                if (label[link.node] != kOpen) continue;
                label[link.node] = number;
                stack.push_back(link.node);
            }
        }
        ++number;
    }
    return label;
}

WeightedGraph WeightedGraph::part(std::span<const uint32_t> nodes) const {
    std::vector<double> weights;
    std::vector<glm::dvec3> places;
    std::vector<Edge> edges;
    for (uint32_t n = 0; n < nodes.size(); ++n) {
        weights.push_back(weights_[nodes[n]]);
        places.push_back(places_[nodes[n]]);
        for (const Link& link : links(nodes[n])) {
            const auto it = std::lower_bound(nodes.begin(), nodes.end(), link.node);
            if (link.node > nodes[n] && it != nodes.end() && *it == link.node)
                edges.push_back({n, static_cast<uint32_t>(it - nodes.begin()), link.strength});
        }
    }
    return {std::move(weights), std::move(places), edges};
}

}  // namespace sherd
