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
    FarSide(const SplitSurface& surface, const MeshTopology& topology);

    struct Place {
        glm::dvec3 position{0.0};
        uint32_t triangle = kNone;
    };

    /// Where the ray inwards from a point of a triangle meets the surface again, if it does so from
    /// inside: the normals there must be opposed (the thesis' eta). Rays follow the surface's
    /// smooth normals, which creases interrupt.
    std::optional<Place> across(uint32_t triangle, const glm::dvec3& weights) const;

    /// Whether rays from around the middle of a triangle arrive without having crossed each other,
    /// as they do through a wall and do not through a round body; and where the middle one does.
    std::optional<Place> acrossFrom(uint32_t triangle) const;

    glm::dvec3 normalOf(uint32_t triangle) const { return normals_[triangle]; }

  private:
    glm::dvec3 cornerNormal(uint32_t corner) const;

    const SplitSurface& surface_;
    const MeshTopology& topology_;
    TriangleBvh tree_;
    std::vector<glm::dvec3> normals_;  ///< of triangles, unit or zero
};

}  // namespace sherd
