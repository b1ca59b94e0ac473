// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/box_tree.h"
#include "measures/protrusion.h"
#include "measures/shown_triangles.h"

namespace sherd {

struct LevelCoverageOptions {
    uint32_t points = 20000;  ///< sampled inside the object
    uint32_t seed = 1;
    double skin = 1e-6;  ///< points nearer than this to a face are skipped, shares of the diagonal
    unsigned threads = 2;  ///< at most; the result does not depend on it
};

/// How completely the fragments of every level fill the object.
struct LevelCoverage {
    struct Level {
        uint32_t points = 0;   ///< sampled and not skipped
        uint32_t none = 0;     ///< of these, in no fragment
        uint32_t several = 0;  ///< of these, in more than one
    };
    struct Share {
        uint32_t points = 0;  ///< sampled inside the fragment and not skipped
        uint32_t shared = 0;  ///< of these, inside another fragment of the same level, too
    };
    std::vector<Level> levels;  ///< [0]: the object itself
    std::vector<Share> fragments;
};

/// `tree` holds the boxes of the triangles.
LevelCoverage levelCoverage(const ShownTriangles& shown, const BoxTree& tree,
                            const OriginalSolid& solid, const LevelCoverageOptions& options = {});

}  // namespace sherd
