// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/inside_cells.h"
#include "measures/shown_triangles.h"

namespace sherd {

/// The object as it was before it was cut.
struct OriginalSolid {
    std::span<const glm::vec3> positions;
    std::span<const std::array<uint32_t, 3>> triangles;
    const InsideCells& inside;
};

/// Per fragment, in metres: how far its hidden faces reach out of the solid at most, judged by
/// their corners, the middles of their edges and their centroids.
std::vector<double> protrusions(const ShownTriangles& shown, const OriginalSolid& solid,
                                unsigned threads);

}  // namespace sherd
