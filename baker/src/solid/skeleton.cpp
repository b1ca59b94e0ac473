// SPDX-License-Identifier: MIT
// Seen from outside, the pieces around a node follow each other counter-clockwise; seen from the
// other end of a line through the solid they do so clockwise. So a line through a wall ends in a
// node of the reversed order (the thesis' carried graph keeps the cyclic order, 6.3.2). Where the
// two sides of a wall differ by a flip (front: A meets C; back: B meets D) no node has a partner,
// but the four nodes close around one point inside: every border of two pieces comes twice, and the
// borders form a sphere around the point (Euler). So do all the nodes of a convex body around its
// middle.
#include "solid/skeleton.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "geometry/union_find.h"

namespace sherd {
namespace {

using Order = std::vector<uint32_t>;

/// A border as a node sees it: the pieces before and after.
using Side = std::pair<uint32_t, uint32_t>;

class SkeletonFinder {
  public:
    SkeletonFinder(std::span<const glm::vec3> positions, const BorderGraph& graph,
                   Skeleton& skeleton)
        : positions_(positions), graph_(graph), skeleton_(skeleton) {}

    void run(HubChoice choice) {
        if (choice == HubChoice::near) {
            findPartners();
            findNearHubs();
        }
        shareHubs();
    }

  private:
    glm::dvec3 at(uint32_t node) const { return positions_[graph_.nodes[node].vertex]; }
    bool isFree(uint32_t node) const {
        return graph_.nodes[node].plain && skeleton_.linesAt[node].empty();
    }

    /// Nodes of reversed order, the nearest first.
    void findPartners() {
        std::map<Order, std::vector<uint32_t>> byOrder;
        for (uint32_t n = 0; n < graph_.nodes.size(); ++n)
            if (isFree(n)) byOrder[piecesAround(graph_.nodes[n], false)].push_back(n);
        struct Pair {
            double distance;
            uint32_t a, b;
            bool operator<(const Pair& o) const {
                return std::tie(distance, a, b) < std::tie(o.distance, o.a, o.b);
            }
        };
        std::vector<Pair> pairs;
        for (uint32_t a = 0; a < graph_.nodes.size(); ++a) {
            if (!isFree(a)) continue;
            const auto found = byOrder.find(piecesAround(graph_.nodes[a], true));
            if (found == byOrder.end()) continue;
            for (const uint32_t b : found->second)
                if (a < b) pairs.push_back({glm::distance(at(a), at(b)), a, b});
        }
        std::sort(pairs.begin(), pairs.end());
        for (const Pair& pair : pairs) {
            if (!isFree(pair.a) || !isFree(pair.b)) continue;
            skeleton_.addLine(pair.a, pair.b, piecesAround(graph_.nodes[pair.a], false));
        }
    }

    struct Group {
        double size = 0;
        std::vector<uint32_t> nodes;  ///< ascending
        bool operator<(const Group& o) const {
            return std::tie(size, nodes) < std::tie(o.size, o.nodes);
        }
    };

    /// Small groups of free nodes that close around a point, the smallest first.
    void findNearHubs() {
        bySide_.clear();
        for (uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            if (!isFree(n)) continue;
            for (const BorderNode::Spoke& spoke : graph_.nodes[n].spokes)
                bySide_[{spoke.before, spoke.after}].push_back(n);
        }
        std::set<Group> groups;
        for (uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            if (!isFree(n)) continue;
            std::vector<uint32_t> nodes{n};
            grow(nodes, groups);
        }
        for (const Group& group : groups) {
            if (std::all_of(group.nodes.begin(), group.nodes.end(),
                            [this](uint32_t n) { return isFree(n); }))
                addHub(group.nodes);
        }
    }

    void grow(std::vector<uint32_t>& nodes, std::set<Group>& groups) const {
        constexpr size_t kMostNodes = 6;
        constexpr size_t kMostTries = 3;
        std::set<Side> sides;
        std::set<uint32_t> pieces;
        for (const uint32_t n : nodes) {
            for (const BorderNode::Spoke& spoke : graph_.nodes[n].spokes) {
                if (!sides.insert({spoke.before, spoke.after}).second) return;
                pieces.insert(spoke.after);
            }
        }
        const auto open = std::find_if(sides.begin(), sides.end(), [&](const Side& side) {
            return !sides.contains({side.second, side.first});
        });
        if (open == sides.end()) {
            if (nodes.size() + pieces.size() != sides.size() / 2 + 2) return;
            Group group{0, nodes};
            std::sort(group.nodes.begin(), group.nodes.end());
            for (const uint32_t a : nodes)
                for (const uint32_t b : nodes)
                    group.size = std::max(group.size, glm::distance(at(a), at(b)));
            groups.insert(std::move(group));
            return;
        }
        if (nodes.size() == kMostNodes) return;
        const auto found = bySide_.find({open->second, open->first});
        if (found == bySide_.end()) return;
        std::vector<std::pair<double, uint32_t>> candidates;
        for (const uint32_t n : found->second) {
            if (std::find(nodes.begin(), nodes.end(), n) == nodes.end())
                candidates.emplace_back(glm::distance(at(n), at(nodes[0])), n);
        }
        std::sort(candidates.begin(), candidates.end());
        if (candidates.size() > kMostTries) candidates.resize(kMostTries);
        for (const auto& [distance, n] : candidates) {
            nodes.push_back(n);
            grow(nodes, groups);
            nodes.pop_back();
        }
    }

    /// All nodes left that borders hold together share one hub.
    void shareHubs() {
        UnionFind joined(graph_.nodes.size());
        for (const BorderArc& arc : graph_.arcs) {
            if (arc.from == kNone || !isFree(arc.from) || !isFree(arc.to)) continue;
            joined.unite(arc.from, arc.to);
        }
        std::map<uint32_t, std::vector<uint32_t>> groups;
        for (uint32_t n = 0; n < graph_.nodes.size(); ++n)
            if (isFree(n)) groups[joined.find(n)].push_back(n);
        for (const auto& [root, nodes] : groups)
            if (nodes.size() > 1) addHub(nodes);
    }

    void addHub(const std::vector<uint32_t>& nodes) {
        glm::dvec3 sum(0.0);
        for (const uint32_t n : nodes) sum += at(n);
        const uint32_t hub = skeleton_.addHub(sum / static_cast<double>(nodes.size()));
        for (const uint32_t n : nodes)
            skeleton_.addLine(n, hub, piecesAround(graph_.nodes[n], false));
    }

    std::span<const glm::vec3> positions_;
    const BorderGraph& graph_;
    Skeleton& skeleton_;
    std::map<Side, std::vector<uint32_t>> bySide_;  ///< free nodes that see a border so
};

}  // namespace

std::vector<uint32_t> piecesAround(const BorderNode& node, bool reversed) {
    std::vector<uint32_t> pieces;
    for (const BorderNode::Spoke& spoke : node.spokes) pieces.push_back(spoke.after);
    if (reversed) std::reverse(pieces.begin(), pieces.end());
    std::rotate(pieces.begin(), std::min_element(pieces.begin(), pieces.end()), pieces.end());
    return pieces;
}

void completeSkeleton(std::span<const glm::vec3> positions, const BorderGraph& graph,
                      HubChoice choice, Skeleton& skeleton) {
    SkeletonFinder(positions, graph, skeleton).run(choice);
}

}  // namespace sherd
