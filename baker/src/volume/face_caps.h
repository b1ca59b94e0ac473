// SPDX-License-Identifier: MIT
// The face between two cells, as far as it is inside the mesh: a cap of both, built once.
//
// A cap's border is known as directed edges: the sections of triangles by the face's plane and the
// stretches of the cells' edges inside the mesh. They add up to closed loops, so the plane has a
// winding number everywhere, and the cap is where it is not 0: each triangle of a triangulation
// constrained by the border as often as its winding number says, reversed where that is negative.
// Whatever the mesh (overlapping, touching, crossing itself), border and cap then cancel, and a
// piece of a closed mesh is closed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/union_find.h"
#include "volume/cap_border.h"
#include "volume/cap_space.h"
#include "volume/cap_triangle.h"

namespace sherd {

struct CapReport {
    uint32_t crossed = 0;  ///< caps whose border crosses itself
    uint32_t fans = 0;     ///< caps that could not be triangulated: closed, but folded
};

class CapBuilder {
  public:
    /// Vertices found to be in one place are united in `merged`.
    CapBuilder(CapSpace& vertices, UnionFind& merged);
    ~CapBuilder();

    /// Appends the triangles of the cap i|j, i < j, counter-clockwise seen from j. Vertices that
    /// `merged` unites by then or later are the same.
    void build(uint32_t i, uint32_t j, std::span<const CapEdge> border,
               std::vector<CapTriangle>& triangles);

    const CapReport& report() const { return report_; }

  private:
    class Work;
    std::unique_ptr<Work> work_;
    CapReport report_;
};

}  // namespace sherd
