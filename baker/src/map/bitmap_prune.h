// SPDX-License-Identifier: MIT
#pragma once

#include "map/centre_graph.h"

namespace sherd {

/// What was taken for noise, for the warnings.
struct Pruned {
    size_t spurs = 0;
    glm::dvec2 spurAt{0.0};  ///< the longest one's end
    double longest = 0;
    size_t specks = 0;
    glm::dvec2 speckAt{0.0};  ///< the first one
};

/// Removes dead branches that stand out of the rest of the drawing by less than `spur` texels, or
/// by less than half the width of what they stand on; then whole drawings no longer than that.
/// Nodes of two lines are dissolved.
Pruned pruneSpurs(CentreGraph& graph, double spur);

}  // namespace sherd
