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
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "geometry/exact_point.h"

namespace sherd {

struct TriangulationInput {
    struct Constraint {
        uint32_t a, b;
        uint32_t mark;  ///< not 0
    };
    /// 0, 1, 2: the corners, counter-clockwise; the others on the border or inside; all distinct.
    std::vector<ExactPoint> points;
    std::vector<glm::dvec2>
        shape;  ///< where the points lie undistorted: guides which diagonals are taken
    std::vector<Constraint> constraints;  ///< meet each other in points only
};

struct TriangulationResult {
    struct Triangle {
        std::array<uint32_t, 3> v;     ///< counter-clockwise
        std::array<uint32_t, 3> mark;  ///< of edge v[k] v[k + 1]; 0: no constraint
    };
    std::vector<Triangle> triangles;
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
