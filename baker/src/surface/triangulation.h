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
    const SplitSurface& surface;
    const MeshTopology& topology;    ///< of the surface
    std::span<const UvTriangle> uv;  ///< the frame of each triangle that `map` is drawn in
    const PlanarMap& map;
    std::span<const Cut> cuts;  ///< sorted by triangle
    const ResolvedEdges& edges;
};

/// A surface cut so far, cut further. Index-degenerate triangles are left out. `from`, if wanted:
/// per new triangle the one it comes from. Error `internal` if cuts cross, which planarised maps
/// exclude.
Result<SplitSurface> splitSurface(const SplitInput& input, std::vector<uint32_t>* from = nullptr);

}  // namespace sherd
