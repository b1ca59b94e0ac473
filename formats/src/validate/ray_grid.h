// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sherd {

/// Winding numbers by signed crossings of axis-parallel rays.
///
/// Triangles are binned in a grid across the ray's axis. Coordinates across the axis are rounded to
/// 29 bits of the extent once, so that sides are decided exactly in 64 bits; a ray through an edge
/// or a corner is decided as if shifted by (e, e^2) (Edelsbrunner and Muecke 1990), which counts
/// every crossing once. Depth along the ray is in doubles: points nearer to the surface than
/// rounding may fall on either side.
class RayGrid {
  public:
    struct Crossing {
        uint32_t label = 0;
        int32_t sign = 0;  ///< +1: the ray leaves through it
    };

    /// Triangles of `positions`; `labels` (one each) may be empty. `axis`: 0 to 2.
    RayGrid(const std::vector<glm::vec3>& positions,
            const std::vector<std::array<uint32_t, 3>>& triangles,
            const std::vector<uint32_t>& labels, int axis);

    /// How often the surface encloses the point, over all labels.
    int winding(const glm::dvec3& point) const;

    /// All crossings of the ray from `point` towards larger coordinates.
    void crossings(const glm::dvec3& point, std::vector<Crossing>& out) const;

  private:
    struct Flat {
        std::array<int32_t, 3> u{};
        std::array<int32_t, 3> v{};
        std::array<float, 3> depth{};
        int32_t sign = 0;
        uint32_t label = 0;
    };
    bool snap(const glm::dvec3& point, int32_t& u, int32_t& v) const;
    uint32_t cellOf(int32_t coordinate) const;
    template <class Visit>
    void visitCrossings(const glm::dvec3& point, Visit visit) const;

    int axis_;
    glm::dvec3 low_{0};
    glm::dvec3 scale_{0};
    uint32_t cells_ = 1;  ///< per side
    std::vector<Flat> triangles_;
    std::vector<uint32_t> cellStart_;
    std::vector<uint32_t> cellItems_;
};

}  // namespace sherd
