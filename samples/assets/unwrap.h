// SPDX-License-Identifier: MIT
// Texture coordinates for a shape that was not built with them: charts seen along the axes.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh.h"

namespace sherd::samples {

struct UnwrapOptions {
    /// Neighbours hold together with this weight against the best view of each triangle.
    double cohesion = 0.35;
    double steepest = 0.12;  ///< cosine between a triangle's normal and the view it is in
    uint32_t smallest = 60;  ///< triangles; smaller charts join a neighbour where they can
    double gutter = 0.006;   ///< between charts and around them, of the texture's width
};

/// Each chart is what is seen of a connected patch along one axis, upright and not mirrored; all at
/// one scale, none overlapping itself or another. Returns the chart of each triangle.
std::vector<uint32_t> unwrap(Mesh& mesh, const UnwrapOptions& options);

}  // namespace sherd::samples
