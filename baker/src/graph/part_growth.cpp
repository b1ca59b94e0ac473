// SPDX-License-Identifier: MIT
// Seeds: each is the farthest from those before (Gonzalez 1985, Clustering to minimize the maximum
// intercluster distance), by Dijkstra's shortest paths that only go on where they became shorter.
// Growth: greedy graph growing (Karypis and Kumar 1998), all parts at once.
#include "graph/part_growth.h"

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "geometry/no_index.h"

namespace sherd {
namespace {

constexpr double kNoWay = std::numeric_limits<double>::infinity();

/// Shortest ways from several sources, more of which can be added.
class Ways {
  public:
    explicit Ways(const WeightedGraph& graph) : graph_(graph), length_(graph.count(), kNoWay) {}

    void addSource(uint32_t source) {
        using Entry = std::pair<double, uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
        length_[source] = 0;
        open.emplace(0, source);
        while (!open.empty()) {
            const auto [length, node] = open.top();
            open.pop();
            if (length > length_[node]) continue;
            for (const WeightedGraph::Link& link : graph_.links(node)) {
                const double way =
                    length + glm::distance(graph_.place(node), graph_.place(link.node));
                if (!(way < length_[link.node])) continue;
                length_[link.node] = way;
                open.emplace(way, link.node);
            }
        }
    }
    double length(uint32_t node) const { return length_[node]; }
    uint32_t farthest() const {
        return static_cast<uint32_t>(std::max_element(length_.begin(), length_.end()) -
                                     length_.begin());
    }

  private:
    const WeightedGraph& graph_;
    std::vector<double> length_;
};

uint32_t farthestFrom(const WeightedGraph& graph, uint32_t node) {
    Ways ways(graph);
    ways.addSource(node);
    return ways.farthest();
}

class Growth {
  public:
    Growth(const WeightedGraph& graph, const std::vector<uint32_t>& seeds, GrowthOrder order)
        : graph_(graph),
          seeds_(seeds),
          order_(order),
          part_(graph.count(), kNone),
          weights_(seeds.size(), 0),
          edges_(seeds.size()) {
        Ways ways(graph);
        for (const uint32_t seed : seeds) ways.addSource(seed);
        reach_ = ways.length(ways.farthest());
    }

    std::vector<uint32_t> run() {
        for (uint32_t p = 0; p < seeds_.size(); ++p) part_[seeds_[p]] = p;
        for (uint32_t p = 0; p < seeds_.size(); ++p) take(seeds_[p], p);
        while (!next_.empty()) {
            const uint32_t p = next_.top().second;
            next_.pop();
            const uint32_t node = bestOf(p);
            if (node != kNone) take(node, p);  // else it is enclosed by others
        }
        return std::move(part_);
    }

  private:
    struct Candidate {
        double score;
        uint32_t node;
        bool operator<(const Candidate& o) const {  // of equals the lower node is the best
            return score != o.score ? score < o.score : node > o.node;
        }
    };

    void take(uint32_t node, uint32_t p) {
        part_[node] = p;
        weights_[p] += graph_.weight(node);
        for (const WeightedGraph::Link& link : graph_.links(node))
            if (part_[link.node] == kNone) edges_[p].push({scoreOf(link.node, p), link.node});
        if (edges_[p].empty()) return;
        next_.emplace(order_ == GrowthOrder::lightest ? weights_[p] : -edges_[p].top().score, p);
    }

    /// The share of its links that the part has, less how far it is from the seed.
    double scoreOf(uint32_t node, uint32_t p) const {
        double inside = 0, all = 0;
        for (const WeightedGraph::Link& link : graph_.links(node)) {
            all += link.strength;
            if (part_[link.node] == p) inside += link.strength;
        }
        const double away = glm::distance(graph_.place(node), graph_.place(seeds_[p]));
        return inside / all - (reach_ > 0 ? away / reach_ : 0);
    }

    uint32_t bestOf(uint32_t p) {
        while (!edges_[p].empty()) {
            const uint32_t node = edges_[p].top().node;
            edges_[p].pop();
            if (part_[node] == kNone) return node;
        }
        return kNone;
    }

    const WeightedGraph& graph_;
    const std::vector<uint32_t>& seeds_;
    GrowthOrder order_;
    std::vector<uint32_t> part_;
    std::vector<double> weights_;  ///< per part
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next_;  ///< parts to grow
    std::vector<std::priority_queue<Candidate>> edges_;  ///< per part; some are out of date
    double reach_ = 0;  ///< how far the farthest node is from its nearest seed
};

}  // namespace

std::vector<uint32_t> spreadSeeds(const WeightedGraph& graph, uint32_t count) {
    std::vector<uint32_t> seeds{farthestFrom(graph, farthestFrom(graph, 0))};
    std::vector<uint8_t> isSeed(graph.count(), 0);
    isSeed[seeds[0]] = 1;
    Ways ways(graph);
    ways.addSource(seeds[0]);
    using Entry = std::pair<double, uint32_t>;
    const auto less = [](const Entry& a, const Entry& b) {
        return a.first != b.first ? a.first < b.first : a.second > b.second;
    };
    std::priority_queue<Entry, std::vector<Entry>, decltype(less)> farthest(less);
    for (uint32_t n = 0; n < graph.count(); ++n) farthest.emplace(ways.length(n), n);
    while (seeds.size() < count) {
        const auto [length, node] = farthest.top();
        farthest.pop();
        if (isSeed[node] != 0) continue;
        if (length > ways.length(node)) {
            farthest.emplace(ways.length(node), node);
            continue;
        }
        isSeed[node] = 1;
        seeds.push_back(node);
        ways.addSource(node);
    }
    return seeds;
}

std::vector<uint32_t> growParts(const WeightedGraph& graph, const std::vector<uint32_t>& seeds,
                                GrowthOrder order) {
    return Growth(graph, seeds, order).run();
}

std::vector<uint32_t> middlesOf(const WeightedGraph& graph, const std::vector<uint32_t>& part,
                                uint32_t parts) {
    std::vector<glm::dvec3> centres(parts, glm::dvec3(0)), plain(parts, glm::dvec3(0));
    std::vector<double> weights(parts, 0), counts(parts, 0);
    for (uint32_t n = 0; n < graph.count(); ++n) {
        centres[part[n]] += graph.weight(n) * graph.place(n);
        plain[part[n]] += graph.place(n);
        weights[part[n]] += graph.weight(n);
        counts[part[n]] += 1;
    }
    for (uint32_t p = 0; p < parts; ++p)
        centres[p] = weights[p] > 0 ? centres[p] / weights[p] : plain[p] / counts[p];
    std::vector<uint32_t> middles(parts, kNone);
    std::vector<double> nearest(parts, kNoWay);
    for (uint32_t n = 0; n < graph.count(); ++n) {
        const double away = glm::distance(graph.place(n), centres[part[n]]);
        if (middles[part[n]] != kNone && !(away < nearest[part[n]])) continue;
        nearest[part[n]] = away;
        middles[part[n]] = n;
    }
    return middles;
}

}  // namespace sherd
