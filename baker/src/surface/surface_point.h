// SPDX-License-Identifier: MIT
// Places an artist names, found on the surface.
#pragma once

#include <optional>

#include "geometry/triangle_bvh.h"
#include "sherd/baker/fracture_map.h"
#include "sherd/baker/surface_mesh.h"
#include "surface/split_surface.h"
#include "surface/uv_triangle.h"

namespace sherd {

/// A point of the surface, in the frame of one of its triangles (`chords.h`).
struct SurfacePoint {
    uint32_t triangle = 0;
    GridPoint frame;
    double distance = 0;  ///< metres from the place that was named
};

glm::dvec3 positionOf(const SplitSurface& surface, const SurfacePoint& point);

/// Finds places on a surface cut so far.
class PlaceFinder {
  public:
    /// uv: per mesh triangle, empty where the mesh has none. Triangles marked in `skip` are never
    /// hit.
    PlaceFinder(const SurfaceMesh& mesh, const SplitSurface& surface, std::span<const uint8_t> skip,
                std::span<const UvTriangle> uv);

    /// 3D: the nearest point of the surface. UV: the first triangle of the mesh that holds it.
    /// Nothing for a UV place outside every chart, nor for what is not finite.
    std::optional<SurfacePoint> find(const SurfacePlace& place) const;

    /// The point of the surface nearest to a position in the object's frame.
    std::optional<SurfacePoint> nearest(const glm::dvec3& position) const;

  private:
    const SurfaceMesh& mesh_;
    const SplitSurface& surface_;
    std::span<const uint8_t> skip_;
    std::span<const UvTriangle> uv_;
    TriangleBvh tree_;
};

}  // namespace sherd
