// SPDX-License-Identifier: MIT
// Constrained triangulation of one triangle with points on its border and inside.
//
// Points are inserted one by one (Lawson 1977), constraint edges recovered by flipping (Sloan 1993,
// A fast algorithm for generating constrained Delaunay triangulations). Every decision on topology
// is exact; only the choice between two valid diagonals uses floating point, and the number of
// flips is bounded, so rounding can cost beauty but neither validity nor termination.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/exact_point.h"

namespace sherd {

struct TriangulationInput {
    struct Constraint {
        uint32_t a, b;
        uint32_t mark;  ///< not 0
    };
    /// 0, 1, 2: the corners, counter-clockwise; the others on the border or inside.
    std::vector<ExactPoint> points;
    /// Decides instead of the points' exact coordinates where these do not fit: 1 if points a, b, c
    /// turn left, -1 right, 0 collinear. Of `points` only ax and ay are used then.
    std::function<int(uint32_t, uint32_t, uint32_t)> turn;
    std::vector<glm::dvec2>
        shape;  ///< where the points lie undistorted: guides which diagonals are taken
    std::vector<Constraint> constraints;  ///< meet each other in points only
};

struct TriangulationResult {
    struct Triangle {
        std::array<uint32_t, 3> v;         ///< counter-clockwise
        std::array<uint32_t, 3> mark;      ///< of edge v[k] v[k + 1]; 0: no constraint
        std::array<uint32_t, 3> neighbor;  ///< across edge v[k] v[k + 1]; kNone: none
    };
    static constexpr uint32_t kNone = 0xFFFFFFFFU;
    /// A constraint runs through a point between its ends. In order along each constraint.
    struct Passage {
        uint32_t constraint, point;
    };
    std::vector<Triangle> triangles;
    /// Points found in the place of an earlier one, which stands for them: later, earlier.
    std::vector<std::pair<uint32_t, uint32_t>> same;
    std::vector<Passage> passages;
    bool valid = false;  ///< false: constraints cross, the input broke its promise
};

TriangulationResult triangulate(const TriangulationInput& input);

/// The same for many inputs in a row, in memory that is kept.
class ConstrainedTriangulation {
  public:
    ConstrainedTriangulation();
    ~ConstrainedTriangulation();
    /// Good until the next call.
    const TriangulationResult& run(const TriangulationInput& input);

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

}  // namespace sherd
