// SPDX-License-Identifier: MIT
#include "geometry/perturbed_signs.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <initializer_list>

namespace sherd {
namespace {

using Wide = boost::multiprecision::int256_t;

int decide(std::initializer_list<Nudge> nudges) {
    Nudge best{0, 0};
    for (const Nudge& n : nudges) keepHighest(best, n);
    return best.sign;
}

/// The sign of x . crossed.
int dotSign(const CornerValues& x, const std::array<Int128, 3>& crossed) {
    // |x| < 2^58, |crossed| < 2^118: a double holds each within 2^-53, so the sum is off by less
    // than 2^-50 of its terms.
    double sum = 0;
    double size = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double term = static_cast<double>(x[k]) * static_cast<double>(crossed[k]);
        sum += term;
        size += std::abs(term);
    }
    if (std::abs(sum) > 0x1p-50 * size) return sum > 0 ? 1 : -1;
    Wide exact = 0;
    for (size_t k = 0; k < 3; ++k) exact += Wide(x[k]) * Wide(crossed[k]);
    return exact.sign();
}

Int128 crossSum(const CornerValues& x, const CornerValues& y) {
    const std::array<Int128, 3> c = cornerWeights(x, y);
    return c[0] + c[1] + c[2];
}

}  // namespace

std::array<Int128, 3> cornerWeights(const CornerValues& x, const CornerValues& y) {
    return {Int128{x[1]} * y[2] - Int128{x[2]} * y[1], Int128{x[2]} * y[0] - Int128{x[0]} * y[2],
            Int128{x[0]} * y[1] - Int128{x[1]} * y[0]};
}

int signAtCorner(int64_t il, uint32_t i, uint32_t l) {
    const int sign = signOf(il);
    return sign != 0 ? sign : (i < l ? -1 : 1);
}

int signOnEdge(const EndValues& ij, const EndValues& il, uint32_t i, uint32_t j, uint32_t l) {
    const int64_t slope = ij[0] - ij[1];
    const int side = signOf(slope);
    const int exact = signOf(Int128{ij[0]} * il[1] - Int128{ij[1]} * il[0]);
    if (exact != 0) return side * exact;
    const int64_t slopeL = il[1] - il[0];
    return side * decide({{i, signOf(slope + slopeL)}, {j, -signOf(slopeL)}, {l, -side}});
}

int signInTriangle(const CornerValues& ij, const CornerValues& ik, const CornerValues& il,
                   uint32_t i, uint32_t j, uint32_t k, uint32_t l) {
    const std::array<Int128, 3> weights = cornerWeights(ij, ik);
    const Int128 area = weights[0] + weights[1] + weights[2];
    const int side = signOf(area);
    const int exact = dotSign(il, weights);
    if (exact != 0) return side * exact;
    const Int128 byJ = crossSum(ik, il);
    const Int128 byK = crossSum(il, ij);
    return side *
           decide(
               {{i, signOf(byJ + byK + area)}, {j, -signOf(byJ)}, {k, -signOf(byK)}, {l, -side}});
}

}  // namespace sherd
