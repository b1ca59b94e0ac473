// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "physics/polytope.h"

namespace sherd {

/// The smallest width of the points across any of the half-spaces.
double thinnestExtent(std::span<const glm::dvec3> points, std::span<const HalfSpace> halfSpaces);

/// Every point moved inwards to where `margin` more of room is left on all sides: the corners of
/// the offset hull nearest to them. As many points as before.
std::vector<glm::dvec3> shrinkHull(std::span<const glm::dvec3> points,
                                   std::span<const HalfSpace> halfSpaces, double margin);

}  // namespace sherd
