// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/lanes.h"

namespace sherd {

/// Winding number of points with respect to a triangle surface, decided exactly.
///
/// A point on the surface is treated as if it were moved by an infinitesimal, always the same way,
/// so the answer is that of one of its sides. "Inside" is winding number >= 1: closed parts that
/// overlap count as one solid.
///
/// A surface that is not closed (over bit-equal positions some edge is not used as often as its
/// reverse) has no winding number of its own: six axis-parallel rays vote and the lower median of
/// their counts is taken, so a point is inside when at least four rays say so.
class InsideTest {
  public:
    /// Copies what it needs. Indices must be below positions.size(); positions finite.
    InsideTest(std::span<const glm::vec3> positions,
               std::span<const std::array<uint32_t, 3>> triangles);

    int winding(const glm::dvec3& point) const;
    bool inside(const glm::dvec3& point) const { return winding(point) >= 1; }

    /// result[i] = inside(points[i]); sizes must agree.
    void inside(std::span<const glm::vec3> points, std::span<uint8_t> result,
                unsigned threads = 1) const;

    /// Every directed edge is used as often as its reverse.
    bool closed() const { return grids_.size() == 1; }

  private:
    /// Signed crossings of the upward and of the downward ray.
    struct Crossings {
        int up = 0;
        int down = 0;
    };
    using Triangle = std::array<Lanes, 3>;  ///< corners, axes rotated so that rays run along z

    /// The triangles projected along one axis, binned in a grid of the other two.
    class Grid {
      public:
        Grid(std::span<const glm::vec3> positions,
             std::span<const std::array<uint32_t, 3>> triangles, int axis);
        Crossings crossings(const glm::dvec3& point, bool bothWays) const;

      private:
        void chooseResolution();
        void fill();
        struct Box {
            uint32_t x0, x1, y0, y1;
        };
        Box cellsOf(const Triangle& triangle) const;
        uint32_t cellX(double x) const;
        uint32_t cellY(double y) const;

        int axis_;
        glm::vec3 low_{0}, high_{0};
        glm::dvec2 cellsPerUnit_{0};
        uint32_t width_ = 1, height_ = 1;
        std::vector<Triangle> triangles_;
        std::vector<uint32_t> cellStart_;
        std::vector<uint32_t> cellTriangles_;
    };

    std::vector<Grid> grids_;  ///< one if closed, else one per axis
};

}  // namespace sherd
