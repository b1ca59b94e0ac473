// SPDX-License-Identifier: MIT
// How a page lies on the surface: every triangle's corners in the coordinates of the drawing.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "sherd/baker/projection.h"
#include "surface/split_surface.h"
#include "surface/uv_triangle.h"

namespace sherd {

/// A plane through space: a position's page coordinates are ((p - origin) . right, (p - origin) .
/// down).
struct PagePlane {
    glm::dvec3 origin{0.0};
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 down{0, -1, 0};

    glm::dvec2 at(const glm::dvec3& position) const;
};

/// The page as it fits the object's bounding rectangle, seen along `axis` (zero: onto its largest
/// side).
PagePlane fitPage(const SplitSurface& surface, const glm::dvec3& axis);

/// The axis along which the object extends least or most.
glm::dvec3 shortestAxis(const SplitSurface& surface);
glm::dvec3 longestAxis(const SplitSurface& surface);

struct PageFrames {
    std::vector<UvTriangle> triangles;
    int tilesU = 1;  ///< copies of the page side by side that the frames reach into
};

PageFrames framesOnPlane(const SplitSurface& surface, const PagePlane& plane);

/// The pages on the six sides of the bounding box, by `boxSide`.
std::array<PagePlane, 6> boxPlanes(const SplitSurface& surface);

/// The side of the bounding box that a mesh triangle faces most: 2 k for +axis k, 2 k + 1 for -axis
/// k. By the uncut triangle, so that its pieces never part ways.
uint8_t boxSide(const SurfaceMesh& mesh, uint32_t triangle);

/// Precondition: the projection is not by UV.
PageFrames projectedFrames(const SurfaceMesh& mesh, const SplitSurface& surface,
                           const Projection& projection);

}  // namespace sherd
