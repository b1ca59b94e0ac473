// SPDX-License-Identifier: MIT
// A wall that was cut in two ways, once for each side: both cuts at once.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "geometry/exact_grid.h"

namespace sherd {

struct WallOverlayInput {
    static constexpr int32_t kSide = 1 << 26;  ///< of the frame (0, 0), (kSide, 0), (0, kSide)
    using Triangles = std::vector<std::array<uint32_t, 3>>;

    std::vector<GridPoint> points;  ///< distinct; the frame's corners first
    std::vector<glm::dvec2> shape;  ///< where they lie undistorted: guides which diagonals are
                                    ///< taken
    std::array<Triangles, 2> cuts;  ///< counter-clockwise, each filling the frame
};

struct WallOverlay {
    struct OnEdge {
        uint32_t a, b;  ///< an edge of one of the cuts
        double share;   ///< of the way from a to b
        uint32_t point;
    };
    struct Part {
        std::array<uint32_t, 3> v;
        std::array<uint32_t, 2> of;  ///< of each cut the triangle that holds it
    };
    std::vector<OnEdge> crossings;  ///< per point beyond the input's: one of the edges it is on
    std::vector<OnEdge> onEdges;    ///< all that lies within edges, in order from a to b
    std::vector<Part> parts;
};

/// Nothing if a cut does not fill the frame: rounded to the grid its triangles turned over.
std::optional<WallOverlay> overlayWall(const WallOverlayInput& input);

}  // namespace sherd
