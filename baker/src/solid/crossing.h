// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace sherd {

/// Whether one triangle goes through the other: an edge of one has its ends on different sides of
/// the other, decided exactly, and meets it. Triangles that only touch, or lie in one plane, do not
/// cross; so neither do neighbours by their common corners, nor those that meet less than `depth`
/// deep: rounded to floats, a surface moves by as much.
bool trianglesCross(const std::array<glm::dvec3, 3>& a, const std::array<glm::dvec3, 3>& b,
                    double depth);

}  // namespace sherd
