// SPDX-License-Identifier: MIT
#include "pattern/power_cells.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <utility>

#include "surface/chords.h"

namespace sherd {
namespace {

using Wide = boost::multiprecision::int256_t;
using Row = std::array<int64_t, 3>;

/// Values of site i less those of site j.
Row difference(PowerCell::Values values, uint32_t i, uint32_t j) {
    return {values[i][0] - values[j][0], values[i][1] - values[j][1], values[i][2] - values[j][2]};
}

std::array<Int128, 3> cross(const Row& x, const Row& y) {
    return {Int128{x[1]} * y[2] - Int128{x[2]} * y[1], Int128{x[2]} * y[0] - Int128{x[0]} * y[2],
            Int128{x[0]} * y[1] - Int128{x[1]} * y[0]};
}

/// A weight on the perturbation of one site; the highest site with one decides.
struct Nudge {
    uint32_t site;
    int sign;
};

int decide(std::initializer_list<Nudge> nudges) {
    Nudge best{0, 0};
    for (const Nudge& n : nudges)
        if (n.sign != 0 && (best.sign == 0 || n.site > best.site)) best = n;
    return best.sign;
}

/// The sign of x . (y x z).
int determinant(const Row& x, const std::array<Int128, 3>& crossed) {
    // |x| < 2^55, |crossed| < 2^111: a double holds each within 2^-53, so the sum is off by less
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

/// Sign of f_i - f_l at corner k of the triangle.
int atCorner(PowerCell::Values values, uint32_t i, uint32_t l, uint32_t k) {
    const int sign = signOf(values[i][k] - values[l][k]);
    return sign != 0 ? sign : (i < l ? -1 : 1);
}

/// Sign of f_i - f_l where f_i = f_j on the edge from corner a to corner b.
int onEdge(PowerCell::Values values, uint32_t i, uint32_t j, uint32_t l, uint32_t a, uint32_t b) {
    const Row ij = difference(values, i, j);
    const Row il = difference(values, i, l);
    const int64_t slope = ij[a] - ij[b];
    const int side = signOf(slope);
    const int exact = signOf(Int128{ij[a]} * il[b] - Int128{ij[b]} * il[a]);
    if (exact != 0) return side * exact;
    const int64_t slopeL = il[b] - il[a];
    return side * decide({{i, signOf(slope + slopeL)}, {j, -signOf(slopeL)}, {l, -side}});
}

/// Sign of f_i - f_l where f_i = f_j = f_k.
int inside(PowerCell::Values values, uint32_t i, uint32_t j, uint32_t k, uint32_t l) {
    const Row ij = difference(values, i, j);
    const Row ik = difference(values, i, k);
    const Row il = difference(values, i, l);
    const auto sum = [](const Row& x, const Row& y) {
        const auto c = cross(x, y);
        return c[0] + c[1] + c[2];
    };
    const Int128 area = sum(ij, ik);  // the node's weights are cross(ij, ik) / area
    const int side = signOf(area);
    const int exact = determinant(il, cross(ij, ik));
    if (exact != 0) return side * exact;
    const Int128 byJ = sum(ik, il);
    const Int128 byK = sum(il, ij);
    return side *
           decide(
               {{i, signOf(byJ + byK + area)}, {j, -signOf(byJ)}, {k, -signOf(byK)}, {l, -side}});
}

}  // namespace

PowerCell::PowerCell(uint32_t site) : site_(site), sides_{{true, 0}, {true, 1}, {true, 2}} {}

bool PowerCell::keeps(Values values, const CellSide& a, const CellSide& b, uint32_t other) const {
    int sign = 0;
    if (a.edge && b.edge) {
        // Half edges k and k + 1 meet in corner k + 1.
        const uint32_t corner = (a.index + 1) % 3 == b.index ? b.index : a.index;
        sign = atCorner(values, site_, other, corner);
    } else if (a.edge || b.edge) {
        const uint32_t edge = a.edge ? a.index : b.index;
        const uint32_t j = a.edge ? b.index : a.index;
        sign = onEdge(values, site_, j, other, edge, (edge + 1) % 3);
    } else {
        sign = inside(values, site_, a.index, b.index, other);
    }
    return sign < 0;
}

void PowerCell::clip(Values values, uint32_t other) {
    const size_t n = sides_.size();
    std::vector<uint8_t> kept(n);
    size_t count = 0;
    for (size_t c = 0; c < n; ++c) {
        kept[c] = keeps(values, sides_[c], sides_[(c + 1) % n], other) ? 1 : 0;
        count += kept[c];
    }
    if (count == n) return;
    if (count == 0) {
        sides_.clear();
        return;
    }
    // The corners that stay are a run; the side before its first and the one after its last stay
    // too, and the bisector closes the gap.
    size_t first = 0;
    while (kept[first] == 0 || kept[(first + n - 1) % n] != 0) ++first;
    std::vector<CellSide> sides;
    sides.push_back({false, other});
    for (size_t k = 0; k <= count; ++k) sides.push_back(sides_[(first + k) % n]);
    sides_ = std::move(sides);
}

GridPoint PowerCell::corner(Values values, size_t n, const std::array<bool, 3>& forward) const {
    const CellSide a = sides_[n];
    const CellSide b = sides_[(n + 1) % sides_.size()];
    if (a.edge && b.edge) return onHalfEdge((a.index + 1) % 3 == b.index ? b.index : a.index, 0);
    if (a.edge || b.edge) {
        const uint32_t edge = a.edge ? a.index : b.index;
        const uint32_t low = forward[edge] ? edge : (edge + 1) % 3;
        const uint32_t high = forward[edge] ? (edge + 1) % 3 : edge;
        const Row ij = difference(values, site_, a.edge ? b.index : a.index);
        const double t = static_cast<double>(ij[low]) / static_cast<double>(ij[low] - ij[high]);
        const auto steps = static_cast<int32_t>(std::lround(std::clamp(t, 0.0, 1.0) * kGridOne));
        return onHalfEdge(edge, forward[edge] ? steps : kGridOne - steps);
    }
    std::array<uint32_t, 3> sites{site_, a.index, b.index};
    std::sort(sites.begin(), sites.end());
    const auto exact =
        cross(difference(values, sites[0], sites[1]), difference(values, sites[0], sites[2]));
    const auto area = static_cast<double>(exact[0] + exact[1] + exact[2]);
    return onFrame({static_cast<double>(exact[0]) / area, static_cast<double>(exact[1]) / area,
                    static_cast<double>(exact[2]) / area});
}

}  // namespace sherd
