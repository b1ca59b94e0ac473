// SPDX-License-Identifier: MIT
// Points of the plane between two cells, seen from one side.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "volume/cap_space.h"

namespace sherd {

/// Projected along an axis so that turning left is counter-clockwise seen from cell j of i|j.
class CapPlane {
  public:
    /// Begins with no points.
    void start(const CapSpace& vertices, uint32_t i, uint32_t j);
    /// A vertex of the cut as the next point.
    void add(uint32_t vertex);
    /// The same for a place given by whole numbers below 2^29, not on the plane but above it.
    void addFarAway(int64_t u, int64_t v);

    /// 1 if the points a, b, c turn left, -1 right, 0 if they are collinear. Exact.
    int turn(uint32_t a, uint32_t b, uint32_t c);
    /// Projected, in grid steps.
    const glm::dvec2& place(uint32_t point) const { return places_[point]; }
    /// Where a projected place lies in the plane, lengths as they are.
    glm::dvec2 unprojected(const glm::dvec2& place) const {
        return {place.x * stretch_.x + place.y * shear_, place.y * stretch_.y};
    }

  private:
    struct Exact {
        ExactPlace::Integer u, v, w;
    };
    int exactTurn(uint32_t a, uint32_t b, uint32_t c);
    const Exact& exact(uint32_t point);

    const CapSpace* vertices_ = nullptr;
    int uAxis_ = 0, vAxis_ = 1;
    glm::dvec2 stretch_{1.0};
    double shear_ = 0;
    std::vector<uint32_t> vertexOf_;
    std::vector<glm::dvec2> places_;
    std::vector<std::optional<Exact>> exact_;
};

}  // namespace sherd
