// SPDX-License-Identifier: MIT
// Levels that group the pieces of the next finer one.
#pragma once

#include <span>

#include "levels/piece_choice.h"
#include "levels/piece_model.h"
#include "sherd/baker/cluster.h"
#include "sherd/baker/report.h"
#include "sherd/formats/result.h"

namespace sherd {

struct ClusterAt {
    const Cluster* cluster = nullptr;
    uint32_t above = 0;  ///< how many of the model's levels are coarser
};

struct ClusterSettings {
    double sheetTolerance = 0;  ///< metres: how far apart facing sheets may be and still hold
    unsigned threads = 1;       ///< does not change the result
};

/// Where a level is once clusters are between.
uint32_t levelAmong(std::span<const ClusterAt> clusters, uint32_t level);

/// Adds a level for each cluster, coarse to fine, `above` ascending. Of several with the same
/// levels above, each groups the groups of the next. names: of pieces at the levels so far. Errors:
/// badArgument (nothing finer to group, nothing chosen), separatesNothing.
Result<void> addClusters(std::span<const ClusterAt> clusters, const ClusterSettings& settings,
                         const std::vector<PieceName>& names, const PieceModel& model,
                         BakedObjectReport& report);

}  // namespace sherd
