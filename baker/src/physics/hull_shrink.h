// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// n . x <= offset, n unit.
struct HalfSpace {
    glm::dvec3 normal;
    double offset;
};

/// The half-spaces through faces of the convex hull of a few points (tens) of about unit size.
std::vector<HalfSpace> supportingHalfSpaces(std::span<const glm::dvec3> points);

/// The smallest width of the points across any of the half-spaces.
double thinnestExtent(std::span<const glm::dvec3> points, std::span<const HalfSpace> halfSpaces);

/// Every point moved inwards to where `margin` more of room is left on all sides: the corners of
/// the offset hull nearest to them. As many points as before.
std::vector<glm::dvec3> shrinkHull(std::span<const glm::dvec3> points,
                                   std::span<const HalfSpace> halfSpaces, double margin);

}  // namespace sherd
