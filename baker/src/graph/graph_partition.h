// SPDX-License-Identifier: MIT
// A graph's nodes in connected parts: of even weight, near together, with weak edges between them.
#pragma once

#include <cstdint>
#include <vector>

#include "graph/weighted_graph.h"

namespace sherd {

struct PartitionOptions {
    uint32_t parts = 2;  ///< at least 1
    /// 0 to 1: what even weights count for, against strong edges that stay within parts.
    double evenness = 0.5;
};

struct GraphPartition {
    std::vector<uint32_t> part;  ///< per node, numbered by their first nodes
    uint32_t parts = 0;       ///< as many as asked, unless there are fewer nodes or more components
    uint32_t components = 0;  ///< of the graph
};

/// Parts are connected and none is empty. Weights are 0 or more; if all are 0 nodes count alike.
/// Nothing is random: the same graph gives the same parts.
GraphPartition partitionGraph(const WeightedGraph& graph, const PartitionOptions& options);

}  // namespace sherd
