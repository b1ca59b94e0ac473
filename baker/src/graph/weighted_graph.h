// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// An undirected graph of weighted nodes with places, and links of some strength.
class WeightedGraph {
  public:
    struct Edge {
        uint32_t a = 0, b = 0;
        double strength = 0;
    };
    struct Link {
        uint32_t node = 0;
        double strength = 0;  ///< above 0
    };

    /// Edges between the same two nodes are one, as strong as all together; those of no strength
    /// (0, below, or no number) and those of a node to itself are none. places: one per node.
    WeightedGraph(std::vector<double> weights, std::vector<glm::dvec3> places,
                  std::span<const Edge> edges);

    uint32_t count() const { return static_cast<uint32_t>(weights_.size()); }
    double weight(uint32_t node) const { return weights_[node]; }
    const glm::dvec3& place(uint32_t node) const { return places_[node]; }
    double strength() const { return strength_; }  ///< of all edges
    /// Ascending by node.
    std::span<const Link> links(uint32_t node) const {
        return std::span(links_).subspan(start_[node], start_[node + 1] - start_[node]);
    }

    /// Every node weighs 1.
    void weighAlike() { weights_.assign(weights_.size(), 1); }

    /// Nodes that are joined, labelled from 0 by their first one.
    std::vector<uint32_t> components(uint32_t& count) const;
    /// The graph of some of its nodes, ascending: number n is nodes[n].
    WeightedGraph part(std::span<const uint32_t> nodes) const;

  private:
    std::vector<double> weights_;
    std::vector<glm::dvec3> places_;
    std::vector<uint32_t> start_;
    std::vector<Link> links_;
    double strength_ = 0;
};

}  // namespace sherd
