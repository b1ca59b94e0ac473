// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// A stretch of a seam, the same line of the surface on two charts.
struct SeamLabel {
    std::array<glm::dvec2, 2> at;      ///< a point in the middle of the stretch, on each chart
    std::array<glm::dvec2, 2> inward;  ///< from there, into each chart; unit length or zero
    double length = 0;                 ///< of the shorter side, page units
};

/// Of every stretch between two places where seams meet, long ones in parts; longest first.
std::vector<SeamLabel> seamLabels(std::span<const SurfaceMesh> meshes);

}  // namespace sherd
