// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/box_tree.h"
#include "measures/shown_triangles.h"

namespace sherd {

struct SelfIntersections {
    std::vector<uint64_t> ofFragment;  ///< pairs of its triangles whose insides meet
    /// Triangles piled on each other would take the square of their number: beyond a bound on the
    /// pairs looked at the search ends, and the counts are the least that there are.
    bool complete = true;
};

struct SelfIntersectionOptions {
    /// Pairs looked at for each triangle, on average, before the search ends: real models take 100.
    uint64_t pairsPerTriangle = 500;
    unsigned threads = 2;  ///< at most; the result does not depend on it
};

/// Exact. `tree` holds the boxes of the triangles.
SelfIntersections selfIntersections(const ShownTriangles& shown, const BoxTree& tree,
                                    const SelfIntersectionOptions& options = {});

}  // namespace sherd
