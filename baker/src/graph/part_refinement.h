// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "graph/weighted_graph.h"

namespace sherd {

/// What a partition costs: the share of all strength that is cut, and how uneven weights are (the
/// variance of parts' weights over their mean's square), weighed against each other.
class PartitionCost {
  public:
    PartitionCost(const WeightedGraph& graph, uint32_t parts, double evenness);

    double of(const std::vector<uint32_t>& part) const;
    uint32_t parts() const { return parts_; }
    /// Of cutting so much more strength.
    double ofCut(double strength) const { return cut_ * strength; }
    /// Of a part's weight.
    double ofWeight(double weight) const {
        const double off = weight / mean_ - 1;
        return uneven_ * off * off;
    }

  private:
    const WeightedGraph& graph_;
    uint32_t parts_;
    double mean_ = 0;  ///< weight of a part
    double cut_ = 0, uneven_ = 0;
};

/// Moves nodes between neighbouring parts while that lowers the cost. Parts stay connected, none
/// becomes empty.
void refineParts(const WeightedGraph& graph, const PartitionCost& cost,
                 std::vector<uint32_t>& part);

}  // namespace sherd
