// SPDX-License-Identifier: MIT
// Fiduccia and Mattheyses 1982, A linear-time heuristic for improving network partitions, between
// any number of parts: always the best move, also where it costs something, each node once a pass;
// then all moves behind the cheapest state are taken back. Costs are no small integers here, so
// moves are in a heap instead of buckets, brought up to date when they come to its top.
#include "graph/part_refinement.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace sherd {

PartitionCost::PartitionCost(const WeightedGraph& graph, uint32_t parts, double evenness)
    : graph_(graph), parts_(parts) {
    double weight = 0;
    for (uint32_t n = 0; n < graph.count(); ++n) weight += graph.weight(n);
    mean_ = weight / parts;
    // What is cut always decides between parts that are equally even.
    constexpr double kLeast = 1e-3;
    if (graph.strength() > 0) cut_ = std::max(1 - evenness, kLeast) / graph.strength();
    uneven_ = evenness / parts;
}

double PartitionCost::of(const std::vector<uint32_t>& part) const {
    std::vector<double> weights(parts_, 0);
    double cut = 0;
    for (uint32_t n = 0; n < graph_.count(); ++n) {
        weights[part[n]] += graph_.weight(n);
        for (const WeightedGraph::Link& link : graph_.links(n))
            if (link.node > n && part[link.node] != part[n]) cut += link.strength;
    }
    double sum = ofCut(cut);
    for (const double weight : weights) sum += ofWeight(weight);
    return sum;
}

namespace {

class Refinement {
  public:
    Refinement(const WeightedGraph& graph, const PartitionCost& cost, std::vector<uint32_t>& part)
        : graph_(graph),
          cost_(cost),
          part_(part),
          weights_(cost.parts(), 0),
          sizes_(cost.parts(), 0),
          seen_(graph.count(), 0) {
        for (uint32_t n = 0; n < graph.count(); ++n) {
            weights_[part[n]] += graph.weight(n);
            ++sizes_[part[n]];
        }
    }

    /// Whether it was worth anything.
    bool pass() {
        moved_.assign(graph_.count(), 0);
        moves_ = {};
        for (uint32_t n = 0; n < graph_.count(); ++n) consider(n);
        log_.clear();
        double sum = 0, least = 0;
        size_t best = 0;
        // Beyond so many moves for nothing there is nothing to be had.
        const size_t patience = 20 + graph_.count() / 20;
        while (!moves_.empty() && log_.size() < best + patience) {
            const Move move = moves_.top();
            moves_.pop();
            if (moved_[move.node] != 0) continue;
            const Move now = bestOf(move.node);
            if (now.to == kNowhere) continue;
            if (now.cost > move.cost + kTiny) {
                moves_.push(now);
                continue;
            }
            if (!mayLeave(now.node)) continue;  // considered again when a neighbour moves
            log_.push_back({now.node, part_[now.node]});
            apply(now.node, now.to);
            moved_[now.node] = 1;
            sum += now.cost;
            for (const WeightedGraph::Link& link : graph_.links(now.node)) consider(link.node);
            if (sum < least - kTiny) {
                least = sum;
                best = log_.size();
            }
        }
        for (size_t k = log_.size(); k > best; --k) apply(log_[k - 1].first, log_[k - 1].second);
        return best > 0;
    }

  private:
    static constexpr uint32_t kNowhere = 0xFFFFFFFFU;
    static constexpr double kTiny = 1e-12;  ///< sums of other orders differ by less

    struct Move {
        double cost = 0;
        uint32_t node = 0, to = kNowhere;
        bool operator<(const Move& o) const {  // the cheapest on top, then the lowest node
            return cost != o.cost ? cost > o.cost : node > o.node;
        }
    };

    void consider(uint32_t node) {
        if (moved_[node] != 0) return;
        const Move move = bestOf(node);
        if (move.to != kNowhere) moves_.push(move);
    }

    /// To the neighbouring part where it costs least.
    Move bestOf(uint32_t node) {
        const uint32_t from = part_[node];
        const double weight = graph_.weight(node);
        double own = 0;
        toward_.clear();
        for (const WeightedGraph::Link& link : graph_.links(node)) {
            const uint32_t to = part_[link.node];
            if (to == from) {
                own += link.strength;
                continue;
            }
            const auto known = std::find_if(toward_.begin(), toward_.end(),
                                            [to](const auto& t) { return t.first == to; });
            if (known == toward_.end())
                toward_.emplace_back(to, link.strength);
            else
                known->second += link.strength;
        }
        Move best{0, node, kNowhere};
        if (sizes_[from] == 1) return best;
        const double leaving = cost_.ofCut(own) + cost_.ofWeight(weights_[from] - weight) -
                               cost_.ofWeight(weights_[from]);
        for (const auto& [to, strength] : toward_) {
            const double cost = leaving - cost_.ofCut(strength) +
                                cost_.ofWeight(weights_[to] + weight) -
                                cost_.ofWeight(weights_[to]);
            if (best.to == kNowhere || cost < best.cost) best = {cost, node, to};
        }
        return best;
    }

    void apply(uint32_t node, uint32_t to) {
        weights_[part_[node]] -= graph_.weight(node);
        --sizes_[part_[node]];
        part_[node] = to;
        weights_[to] += graph_.weight(node);
        ++sizes_[to];
    }

    /// Whether its part stays connected without it: its neighbours there reach each other.
    bool mayLeave(uint32_t node) {
        const uint32_t from = part_[node];
        uint32_t wanted = 0, first = kNowhere;
        ++mark_;
        seen_[node] = mark_;
        for (const WeightedGraph::Link& link : graph_.links(node)) {
            if (part_[link.node] != from) continue;
            if (first == kNowhere) first = link.node;
            ++wanted;
        }
        if (wanted <= 1) return wanted == 1;
        // Breadth first: what must be met is near.
        open_.assign(1, first);
        seen_[first] = mark_;
        uint32_t met = 1;
        for (size_t k = 0; k < open_.size(); ++k) {
            for (const WeightedGraph::Link& link : graph_.links(open_[k])) {
                if (part_[link.node] != from || seen_[link.node] == mark_) continue;
                seen_[link.node] = mark_;
                open_.push_back(link.node);
                if (isLinked(node, link.node) && ++met == wanted) return true;
            }
        }
        return false;
    }

    bool isLinked(uint32_t a, uint32_t b) const {
        const auto links = graph_.links(a);
        const auto it = std::lower_bound(
            links.begin(), links.end(), b,
            [](const WeightedGraph::Link& link, uint32_t node) { return link.node < node; });
        return it != links.end() && it->node == b;
    }

    const WeightedGraph& graph_;
    const PartitionCost& cost_;
    std::vector<uint32_t>& part_;
    std::vector<double> weights_;  ///< per part
    std::vector<uint32_t> sizes_;  ///< per part
    std::vector<uint8_t> moved_;   ///< per node, in this pass
    std::priority_queue<Move> moves_;
    std::vector<std::pair<uint32_t, uint32_t>> log_;   ///< node, where it was
    std::vector<std::pair<uint32_t, double>> toward_;  ///< neighbouring parts of a node
    std::vector<uint32_t> seen_, open_;
    uint32_t mark_ = 0;
};

}  // namespace

void refineParts(const WeightedGraph& graph, const PartitionCost& cost,
                 std::vector<uint32_t>& part) {
    constexpr int kMostPasses = 20;
    Refinement refinement(graph, cost, part);
    for (int pass = 0; pass < kMostPasses && refinement.pass(); ++pass) {
    }
}

}  // namespace sherd
