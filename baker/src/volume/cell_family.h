// SPDX-License-Identifier: MIT
// Cells as the places where one of several linear functions is lowest.
//
// The squared distances to sites, less |x|^2, are linear: Voronoi and power cells are such a
// family. So are slabs between planes p_1, p_2, ...: f_0 = 0, f_k = f_{k-1} - p_k, where p_k is
// positive beyond plane k. And where two families overlap, the cells a and b of theirs meet where
// f_a + g_b is lowest: slices in three directions, or any planes at all, are families of sums, and
// one way of cutting does for all of them. What two cells share lies in the plane where their
// functions are equal, and three such planes always meet in one line, whatever is rounded.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sherd/formats/result.h"
#include "volume/cut_grid.h"

namespace sherd {

/// x px + y py + z pz + c over grid points p.
struct LinearFunction {
    int64_t x = 0, y = 0, z = 0, c = 0;

    int64_t at(const CutGridPoint& p) const { return x * p.x + y * p.y + z * p.z + c; }
    friend LinearFunction operator+(const LinearFunction& f, const LinearFunction& g) {
        return {f.x + g.x, f.y + g.y, f.z + g.z, f.c + g.c};
    }
    friend LinearFunction operator-(const LinearFunction& f, const LinearFunction& g) {
        return {f.x - g.x, f.y - g.y, f.z - g.z, f.c - g.c};
    }
};

/// Its change over a grid step, where it changes most.
double slopeOf(const LinearFunction& f);

struct CellFamily {
    std::vector<LinearFunction> functions;
    /// Where the functions are squared distances (less what all share, each less a weight that is
    /// small): to what, in grid steps, and what lengths along the axes count for. Speeds up finding
    /// neighbours. Else empty.
    std::vector<glm::dvec3> sites;
    glm::dvec3 metric{1.0};
    bool slabs = false;  ///< f_k = f_{k-1} - p_k: each plane can be moved alone
};

/// The overlay of families: cell number a + b * |first| + c * |first| |second| + ...
class CellFunctions {
  public:
    /// Bounds of the sums, so that everything decided later fits the widths it is decided in.
    static constexpr int64_t kLargestSlope = int64_t{1} << 28;   ///< of x, y, z
    static constexpr int64_t kLargestOffset = int64_t{1} << 56;  ///< of c
    static constexpr uint32_t kMostCells = 100'000;

    /// Errors: badArgument (no cell), limitExceeded (cells, or numbers beyond the bounds).
    static Result<CellFunctions> of(std::vector<CellFamily> families);

    uint32_t count() const { return static_cast<uint32_t>(sums_.size()); }
    const LinearFunction& operator[](uint32_t cell) const { return sums_[cell]; }
    const std::vector<CellFamily>& families() const { return families_; }
    /// The member of family f that a cell is made of.
    uint32_t member(uint32_t cell, size_t f) const {
        return cell / stride_[f] % static_cast<uint32_t>(families_[f].functions.size());
    }
    uint32_t stride(size_t f) const { return stride_[f]; }

  private:
    std::vector<CellFamily> families_;
    std::vector<uint32_t> stride_;
    std::vector<LinearFunction> sums_;
};

}  // namespace sherd
