// SPDX-License-Identifier: MIT
// The hidden point M(p) of every vertex of the split surface.
#pragma once

#include <span>
#include <vector>

#include "geometry/inside_test.h"
#include "surface/split_surface.h"

namespace sherd {

struct HiddenPoints {
    std::vector<glm::vec3> points;  ///< per split vertex
    uint32_t pulledBack = 0;  ///< interpolated points outside the solid, moved towards the surface
    uint32_t onSurface = 0;   ///< of these: no inner place found, M(p) = p
};

/// M is linear on each mesh triangle, so pieces of components add up to the piece of their union.
/// Where the interpolated point leaves a solid that is not convex, it goes back towards p by
/// halves.
HiddenPoints hiddenPoints(const SplitSurface& surface, std::span<const glm::vec3> medial,
                          const InsideTest& inside, unsigned threads);

/// The point on the way from `hidden` to `p`, by halves, that is inside; p itself after 12 halves.
glm::vec3 pullInside(const InsideTest& inside, const glm::vec3& p, glm::vec3 hidden);

}  // namespace sherd
