// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/elastic_network.h"
#include "sherd/runtime/memory.h"

namespace sherd {

/// Makes smaller networks of elastic networks. Keeps its memory.
class Aggregation {
  public:
    /// For networks up to this size; those may take memory otherwise.
    void reserve(size_t nodes, size_t edges);

    /// Gives every node an aggregate of two or three that hold together best, one of its own where
    /// it has no neighbour. Returns how many there are.
    uint32_t pairUp(const ElasticNetwork& network, Vector<uint32_t>& aggregateOf);

    /// The network of aggregates that are rigid: P^T K P with the rigid motions of each as P. All
    /// edges between two become one, at their middle.
    void merge(const ElasticNetwork& fine, std::span<const uint32_t> aggregateOf, uint32_t count,
               ElasticNetwork& coarse);

  private:
    struct Crossing {
        uint32_t a, b, edge;
    };
    struct Neighbor {
        uint32_t node;
        double weight;
    };
    Vector<Crossing> crossings_;
    Vector<uint32_t> counts_;
    Vector<uint32_t> firstNeighbor_;
    Vector<Neighbor> neighbors_;
};

}  // namespace sherd
