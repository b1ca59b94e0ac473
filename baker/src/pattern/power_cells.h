// SPDX-License-Identifier: MIT
// The cells of sites restricted to one triangle, decided exactly.
//
// Over a triangle the squared distance to a site, less what all sites share, is a linear function:
// three integers, its values at the corners. Cells are where a site's function is lowest. Cell
// corners stay implicit (edge and two sites, or three sites); every decision is one of
// `perturbed_signs.h`, so ties go to the lower index. Clipping the triangle by
// one bisector after another follows Yan et al. 2009, Isotropic Remeshing with Fast and Exact
// Computation of Restricted Voronoi Diagram; unlike there, what a cell shares with its neighbour is
// the same implicit points, so nothing gapes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/exact_grid.h"
#include "geometry/perturbed_signs.h"
#include "pattern/site_grid.h"

namespace sherd {

/// A side of a cell: half edge `index` of the triangle, or the bisector with site `index`.
struct CellSide {
    bool edge = false;
    uint32_t index = 0;
};

/// A convex cell as its sides in order, counter-clockwise; corner n lies between sides n and n + 1.
class PowerCell {
  public:
    using Values = std::span<const CornerValues>;  ///< per site: squared distances of the corners

    /// The whole triangle.
    explicit PowerCell(uint32_t site);

    /// Keeps what is nearer to the cell's site than to `other`.
    void clip(Values values, uint32_t other);

    bool empty() const { return sides_.empty(); }
    uint32_t site() const { return site_; }
    const std::vector<CellSide>& sides() const { return sides_; }
    /// The corner between sides n and n + 1 in the triangle's frame (`chords.h`), rounded; decides
    /// no topology. The same from each cell that has it, and on an edge from both sides of that.
    /// forward: per half edge, whether it runs from its lower vertex to its higher.
    GridPoint corner(Values values, size_t n, const std::array<bool, 3>& forward) const;

  private:
    /// Whether the corner between two sides is nearer to the cell's site than to `other`.
    bool keeps(Values values, const CellSide& a, const CellSide& b, uint32_t other) const;

    uint32_t site_;
    std::vector<CellSide> sides_;
};

}  // namespace sherd
