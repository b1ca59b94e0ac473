// SPDX-License-Identifier: MIT
#pragma once

#include "map/bitmap_refine.h"
#include "map/centre_graph.h"

namespace sherd {

/// Gives every loose end of a line back what thinning took: to where the drawn line ends, or to the
/// picture's border if that is near.
void extendEnds(CentreGraph& graph, const InkField& field);

}  // namespace sherd
