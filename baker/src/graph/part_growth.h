// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "graph/weighted_graph.h"

namespace sherd {

/// Nodes far from each other along the edges of a connected graph, the first one at its end; count:
/// at most all.
std::vector<uint32_t> spreadSeeds(const WeightedGraph& graph, uint32_t count);

/// Which part grows next.
enum class GrowthOrder : uint8_t {
    lightest,   ///< parts become even
    mostJoined  ///< what hangs together becomes a part
};

/// Per node the seed it is grown to, parts by what is nearest and best enclosed. The graph is
/// connected, and so is every part.
std::vector<uint32_t> growParts(const WeightedGraph& graph, const std::vector<uint32_t>& seeds,
                                GrowthOrder order);

/// Of each part the node nearest to the part's centre.
std::vector<uint32_t> middlesOf(const WeightedGraph& graph, const std::vector<uint32_t>& part,
                                uint32_t parts);

}  // namespace sherd
