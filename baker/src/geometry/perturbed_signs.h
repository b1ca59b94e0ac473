// SPDX-License-Identifier: MIT
// Which of several linear functions is lowest at a point of a triangle, never a tie.
//
// Functions are given by their values at the corners of the triangle, integers below 2^58, and
// points stay implicit: a corner, the point of an edge where two functions are equal, the point
// inside where three are. Ties break by perturbing the values, function i by e_i with e_0 << e_1 <<
// ... (the lower index wins), never by moving a line where two are equal (Edelsbrunner and Muecke
// 1990, Simulation of Simplicity). A sign is that of a determinant of these integers, in doubles
// where they suffice, else in 256 bits; where it is zero, that of the perturbation's weights, which
// are minors of it: the determinant is linear in the e.
//
// `ij` stands for the values of f_i less those of f_j.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/exact_grid.h"

namespace sherd {

/// At the three corners of a triangle.
using CornerValues = std::array<int64_t, 3>;
/// At the two ends of an edge.
using EndValues = std::array<int64_t, 2>;

/// Sign of f_i - f_l at a corner.
int signAtCorner(int64_t il, uint32_t i, uint32_t l);

/// Sign of f_i - f_l where f_i = f_j on an edge, whose ends lie on different sides of that.
int signOnEdge(const EndValues& ij, const EndValues& il, uint32_t i, uint32_t j, uint32_t l);

/// Sign of f_i - f_l where f_i = f_j = f_k.
int signInTriangle(const CornerValues& ij, const CornerValues& ik, const CornerValues& il,
                   uint32_t i, uint32_t j, uint32_t k, uint32_t l);

/// The weights of the corners, times their sum, where f_i = f_j = f_k. Below 2^118.
std::array<Int128, 3> cornerWeights(const CornerValues& ij, const CornerValues& ik);

/// A weight on the perturbation of one function; the highest function with one decides.
struct Nudge {
    uint32_t index;
    int sign;
};
inline void keepHighest(Nudge& best, const Nudge& other) {
    if (other.sign != 0 && (best.sign == 0 || other.index > best.index)) best = other;
}

}  // namespace sherd
