// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace sherd {

/// Whether two closed triangles share a point, decided exactly. Degenerate ones are segments or
/// points. Two triangles meet if and only if an edge of one meets the other.
bool trianglesTouch(const std::array<glm::dvec3, 3>& a, const std::array<glm::dvec3, 3>& b);

}  // namespace sherd
