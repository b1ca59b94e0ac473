// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"
#include "solid/solid_walls.h"

namespace sherd {

/// Finds walls that go through the surface or through each other.
class WallCrossings {
  public:
    explicit WallCrossings(const SplitSurface& surface);

    /// Whether a wall crosses the surface or itself.
    bool crosses(const SolidWall& wall, std::span<const glm::vec3> hubs) const;

    /// Whether a wall runs outside: over a hollow of the surface, whose rim it touches, it need not
    /// cross anything.
    bool leaves(const SolidWall& wall, std::span<const glm::vec3> hubs) const;

    /// Marks the pieces on both sides of walls that cross each other.
    void markAmong(std::span<const SolidWall> walls, std::span<const glm::vec3> hubs,
                   std::vector<uint8_t>& broken) const;

  private:
    const SplitSurface& surface_;
    TriangleBvh outer_;
    InsideTest inside_;
    double depth_;  ///< metres
};

}  // namespace sherd
