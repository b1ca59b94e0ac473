// SPDX-License-Identifier: MIT
// The one integer grid that a mesh and everything that cuts it are snapped to.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "sherd/formats/result.h"

namespace sherd {

/// A point of the grid. Those of the mesh are at most kGridReach in size.
struct CutGridPoint {
    int32_t x = 0, y = 0, z = 0;
    friend bool operator==(const CutGridPoint&, const CutGridPoint&) = default;
};

/// A cube of 2^26 steps around the middle of a mesh, its side the longest side of the mesh rounded
/// up to a power of two: the same object at twice the size has the same grid points.
class CutGrid {
  public:
    static constexpr int32_t kReach = 1 << 25;  ///< of the mesh, in steps
    /// How far from the middle anything may lie that is snapped, in steps: farther sites and planes
    /// say nothing about the mesh that nearer ones could not.
    static constexpr int32_t kFarthest = 1 << 27;

    /// Around the vertices that triangles use. Errors: noTriangles; invalidData (a position that is
    /// no number, or all of them one point).
    static Result<CutGrid> around(std::span<const glm::vec3> positions,
                                  std::span<const std::array<uint32_t, 3>> triangles);

    /// In steps from the middle, not rounded.
    glm::dvec3 toGrid(const glm::dvec3& position) const { return (position - middle_) / step_; }
    glm::dvec3 toWorld(const glm::dvec3& grid) const { return middle_ + step_ * grid; }
    /// The nearest grid point. `position` lies within kFarthest.
    CutGridPoint snap(const glm::dvec3& position) const;
    double step() const { return step_; }
    /// The longest side of the mesh, in the positions' unit.
    double extent() const { return extent_; }

  private:
    glm::dvec3 middle_{0.0};
    double step_ = 1;
    double extent_ = 1;
};

}  // namespace sherd
