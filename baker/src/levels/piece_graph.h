// SPDX-License-Identifier: MIT
// What holds the pieces of an object together.
#pragma once

#include <vector>

#include "graph/weighted_graph.h"
#include "levels/piece_model.h"

namespace sherd {

struct PieceGraph {
    std::vector<double> volumes;             ///< per leaf, cubic metres, 0 or more
    std::vector<glm::dvec3> centres;         ///< of mass
    std::vector<WeightedGraph::Edge> bonds;  ///< between leaves, square metres
};

/// sheetTolerance: metres, how far apart facing sheets may be and still hold. The result does not
/// depend on the number of threads.
PieceGraph pieceGraph(const PieceModel& model, double sheetTolerance, unsigned threads);

/// The graph of what leaves are grouped to, without bonds between groups of different `within`.
/// group, within: per leaf, numbered from 0.
WeightedGraph groupGraph(const PieceGraph& leaves, const std::vector<uint32_t>& group,
                         const std::vector<uint32_t>& within);

}  // namespace sherd
