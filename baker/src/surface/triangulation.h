// SPDX-License-Identifier: MIT
// Thesis step 5 (Casella 2013, 4.6): every triangle that a line touches is cut into polygons,
// concave ones and ones with holes included, and these into triangles.
#pragma once

#include <span>

#include "sherd/formats/result.h"
#include "surface/edge_resolution.h"
#include "surface/split_surface.h"
#include "surface/uv_triangle.h"

namespace sherd {

struct SplitInput {
    std::span<const glm::vec3> positions;
    std::span<const std::array<uint32_t, 3>> triangles;
    const MeshTopology& topology;
    std::span<const UvTriangle> uv;  ///< empty: no cuts
    const PlanarMap& map;
    std::span<const Cut> cuts;  ///< sorted by triangle
    const ResolvedEdges& edges;
};

/// Index-degenerate triangles are left out. Error `internal` if cuts cross, which planarised maps
/// exclude.
Result<SplitSurface> splitSurface(const SplitInput& input);

}  // namespace sherd
