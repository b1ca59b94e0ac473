// SPDX-License-Identifier: MIT
// What lies across the solid from a place of the surface (thesis 6.3.2).
#pragma once

#include <optional>
#include <vector>

#include "geometry/triangle_bvh.h"
#include "surface/mesh_topology.h"
#include "surface/split_surface.h"

namespace sherd {

class FarSide {
  public:
    /// Faces that turn more than this against each other meet at a crease: cosine of 40 degrees.
    static constexpr double kCrease = 0.77;

    FarSide(const SplitSurface& surface, const MeshTopology& topology);

    struct Place {
        glm::dvec3 position{0.0};
        uint32_t triangle = kNone;
    };

    /// Where the ray inwards from a point of a triangle meets the surface again, if it does so from
    /// inside: the normals there must be opposed (the thesis' eta). Rays follow the surface's
    /// smooth normals, which creases interrupt.
    std::optional<Place> across(uint32_t triangle, const glm::dvec3& weights) const;

    /// The same for a ray from a place of the surface against a unit normal.
    std::optional<Place> behind(const glm::dvec3& from, const glm::dvec3& normal) const;

    /// The mean normal of those faces around a corner that make one smooth surface with `normal`.
    glm::dvec3 smoothNormal(uint32_t corner, const glm::dvec3& normal) const;

    /// Whether rays from around the middle of a triangle arrive without having crossed each other,
    /// as they do through a wall and do not through a round body; and where the middle one does.
    std::optional<Place> acrossFrom(uint32_t triangle) const;

    glm::dvec3 normalOf(uint32_t triangle) const { return normals_[triangle]; }

  private:
    const SplitSurface& surface_;
    const MeshTopology& topology_;
    TriangleBvh tree_;
    double start_;                     ///< metres below the surface: where rays begin
    std::vector<glm::dvec3> normals_;  ///< of triangles, unit or zero
};

}  // namespace sherd
