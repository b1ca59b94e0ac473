// SPDX-License-Identifier: MIT
// A solid cut by planes, for colliders: its skin exactly, its caps only as far as volumes need
// them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "physics/polytope.h"

namespace sherd {

/// Triangles whose directed edges cancel. Caps are fans around any point of their plane: they may
/// fold and reach out of the solid, but as signed areas they are the caps, so volumes are exact
/// (the boundary of a chain), and no polygon has to be triangulated. The skin is real: its corners
/// and those where planes meet in the solid are all that a convex hull needs.
class SolidChain {
  public:
    SolidChain() = default;
    SolidChain(std::vector<glm::dvec3> points, std::vector<std::array<uint32_t, 3>> skin)
        : points_(std::move(points)), skin_(std::move(skin)), skinPoints_(points_.size()) {}

    /// The parts where the half-space holds, and where it does not.
    std::pair<SolidChain, SolidChain> split(const HalfSpace& wall) const;

    /// Corners of the skin on either side, as the parts of `split` have them.
    std::pair<std::vector<glm::dvec3>, std::vector<glm::dvec3>> splitPoints(
        const HalfSpace& wall) const;

    std::span<const glm::dvec3> skinPoints() const { return std::span(points_).first(skinPoints_); }
    const std::vector<glm::dvec3>& points() const { return points_; }
    const std::vector<std::array<uint32_t, 3>>& skin() const { return skin_; }
    double volume() const;

  private:
    class Half;
    std::vector<glm::dvec3> points_;  ///< those of the skin first
    std::vector<std::array<uint32_t, 3>> skin_, caps_;
    size_t skinPoints_ = 0;
};

}  // namespace sherd
