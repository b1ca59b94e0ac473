// SPDX-License-Identifier: MIT
// What of a triangle of the mesh lies in which cell.
//
// From the cells of its corners on, the triangle is clipped by the planes of each cell it reaches
// to that cell's neighbours; a side along the plane to a neighbour says that this is reached, too
// (Yan et al. 2009, Isotropic Remeshing with Fast and Exact Computation of Restricted Voronoi
// Diagram). Corners stay implicit and signs exact, so polygons of neighbouring cells and of
// neighbouring triangles have the same corners.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "volume/cell_complex.h"
#include "volume/cut_vertex.h"

namespace sherd {

class TriangleCells {
  public:
    /// A side of a polygon: half edge `index` of the triangle, or the plane to cell `index`.
    struct Side {
        bool edge = false;
        uint32_t index = 0;
        CornerValues below{};  ///< of a plane: f_i - f_index at the triangle's corners, i the cell
    };
    struct Polygon {
        uint32_t cell = 0;
        std::vector<Side> sides;         ///< counter-clockwise
        std::vector<uint32_t> corners;   ///< vertices; number n is between sides n and n + 1
        std::vector<uint32_t> coplanar;  ///< cells the plane to which the triangle lies in, nearly
    };

    TriangleCells(const CellComplex& complex, CutVertices& vertices)
        : complex_(complex), vertices_(vertices), input_(vertices.input()) {}

    /// The polygons of a triangle whose corners are in the given cells; good until the next call.
    std::span<const Polygon> run(uint32_t triangle, const std::array<uint32_t, 3>& cornerCells);

  private:
    void reach(uint32_t cell);
    void clipBy(uint32_t l, int64_t band, Polygon& polygon);
    bool keeps(const Side& a, const Side& b, const CornerValues& il, uint32_t i, uint32_t l) const;
    uint32_t vertexOf(uint32_t cell, const Side& a, const Side& b);

    const CellComplex& complex_;
    CutVertices& vertices_;
    const CutInput& input_;
    uint32_t triangle_ = 0;
    std::vector<Polygon> polygons_;  ///< the first `count_` are of this triangle
    size_t count_ = 0;
    std::vector<Side> clipped_;
    std::vector<uint8_t> kept_;
};

}  // namespace sherd
