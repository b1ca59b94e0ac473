// SPDX-License-Identifier: MIT
// Traced cracks as an SVG fracture map.
#pragma once

#include <span>
#include <string>

#include "crack_pattern.h"

namespace sherd::samples {

struct DrawOptions {
    double tolerance = 0.0005;  ///< UV: detail finer than this is dropped
    double roundness = 0.35;    ///< 0: straight strokes, 1: fully rounded corners
    double pastRim =
        0.0005;  ///< UV: lines run this far beyond their chart, to cross its rim surely
    double pastJunction = 0.0012;  ///< UV: and this far beyond the coarser crack they end on
};

/// An SVG whose viewBox spans UV [0, 1]^2, v down. `level` names the layer.
std::string drawCracks(std::span<const CrackSegment> segments, uint32_t level,
                       const DrawOptions& options);

}  // namespace sherd::samples
