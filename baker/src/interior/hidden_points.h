// SPDX-License-Identifier: MIT
// The hidden point M(p) of every vertex of the split surface.
#pragma once

#include <vector>

#include "geometry/inside_test.h"
#include "interior/sheet_refinement.h"
#include "surface/split_surface.h"

namespace sherd {

/// M of each vertex of the split surface. Lines do not change M, so pieces of components add up to
/// the piece of their union.
std::vector<glm::vec3> hiddenPoints(const SurfaceMesh& mesh, const SplitSurface& surface,
                                    const HiddenMap& map);

/// The point on the way from `hidden` to `p`, by halves, that is inside; p itself after 12 halves.
glm::vec3 pullInside(const InsideTest& inside, const glm::vec3& p, glm::vec3 hidden);

}  // namespace sherd
