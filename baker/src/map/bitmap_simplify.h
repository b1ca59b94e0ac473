// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace sherd {

/// The points worth keeping so that none is further than `tolerance` from what is left. Both ends
/// stay; a closed line (first point repeated) keeps at least three different points.
std::vector<glm::dvec2> simplify(std::span<const glm::dvec2> points, double tolerance);

}  // namespace sherd
