// SPDX-License-Identifier: MIT
// Lines that end at a chart border are continued by lines that end near there on the other side:
// the stretch of the seam between the two ends is marked as a fracture line (geometry: nothing is
// moved).
#pragma once

#include <glm/vec3.hpp>

#include "surface/edge_resolution.h"
#include "surface/line_table.h"
#include "surface/uv_triangle.h"

namespace sherd {

struct SeamOptions {
    double joinDistance = 0;  ///< farthest apart, along the seam, that two ends are joined; metres
    bool thesisPairing =
        false;  ///< first pair and average the points of both sides, as the thesis does
};

/// A line that ends at a seam and goes on nowhere.
struct LooseEnd {
    glm::dvec3 position;
    glm::dvec2 uv;  ///< on the side the line is drawn on
};

struct SeamReport {
    uint32_t joined = 0;
    uint32_t averaged = 0;  ///< pairs moved by `thesisPairing`
    std::vector<LooseEnd> loose;
};

SeamReport joinAcrossSeams(const MeshTopology& topology, const SplitSurface& surface,
                           std::span<const UvTriangle> uv, std::span<const Cut> cuts,
                           const LineTable& lines, const SeamOptions& options,
                           ResolvedEdges& edges);

}  // namespace sherd
