// SPDX-License-Identifier: MIT
// The hidden point M(p) of every vertex of the split surface.
#pragma once

#include <span>
#include <vector>

#include "interior/sheet_containment.h"
#include "interior/sheet_refinement.h"
#include "surface/split_surface.h"

namespace sherd {

/// M of each vertex of the split surface. Lines do not change M, so pieces of components add up to
/// the piece of their union.
std::vector<glm::vec3> hiddenPoints(const SurfaceMesh& mesh, const SplitSurface& surface,
                                    const HiddenMap& map);

/// Whether more than half of the points are. An open surface may have hardly any inside, as a sail,
/// or lack no more than a bottom.
bool mostlyInside(const InsideTest& inside, std::span<const glm::vec3> points);

/// The point on the way from `hidden` to `p`, by halves, that is inside; p itself after 12 halves.
glm::vec3 pullInside(const SolidTest& object, const glm::vec3& p, glm::vec3 hidden);

}  // namespace sherd
