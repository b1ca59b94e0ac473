// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "map/svg_curves.h"

namespace sherd {

/// Smooth cubic curves through `points` (their ends exactly, the others within `tolerance`), added
/// to `outline`, which ends at the first of them.
void fitCurves(std::span<const glm::dvec2> points, double tolerance, Outline& outline);

}  // namespace sherd
