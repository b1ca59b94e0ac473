// SPDX-License-Identifier: MIT
#include "pattern/power_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "surface/chords.h"

namespace sherd {
namespace {

/// Values of site i less those of site j.
CornerValues difference(PowerCell::Values values, uint32_t i, uint32_t j) {
    return {values[i][0] - values[j][0], values[i][1] - values[j][1], values[i][2] - values[j][2]};
}

}  // namespace

PowerCell::PowerCell(uint32_t site) : site_(site), sides_{{true, 0}, {true, 1}, {true, 2}} {}

bool PowerCell::keeps(Values values, const CellSide& a, const CellSide& b, uint32_t other) const {
    const CornerValues il = difference(values, site_, other);
    int sign = 0;
    if (a.edge && b.edge) {
        // Half edges k and k + 1 meet in corner k + 1.
        const uint32_t corner = (a.index + 1) % 3 == b.index ? b.index : a.index;
        sign = signAtCorner(il[corner], site_, other);
    } else if (a.edge || b.edge) {
        const uint32_t from = a.edge ? a.index : b.index;
        const uint32_t to = (from + 1) % 3;
        const uint32_t j = a.edge ? b.index : a.index;
        const CornerValues ij = difference(values, site_, j);
        sign = signOnEdge({ij[from], ij[to]}, {il[from], il[to]}, site_, j, other);
    } else {
        sign =
            signInTriangle(difference(values, site_, a.index), difference(values, site_, b.index),
                           il, site_, a.index, b.index, other);
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
        const CornerValues ij = difference(values, site_, a.edge ? b.index : a.index);
        const double t = static_cast<double>(ij[low]) / static_cast<double>(ij[low] - ij[high]);
        const auto steps = static_cast<int32_t>(std::lround(std::clamp(t, 0.0, 1.0) * kGridOne));
        return onHalfEdge(edge, forward[edge] ? steps : kGridOne - steps);
    }
    std::array<uint32_t, 3> sites{site_, a.index, b.index};
    std::sort(sites.begin(), sites.end());
    const auto exact = cornerWeights(difference(values, sites[0], sites[1]),
                                     difference(values, sites[0], sites[2]));
    const auto area = static_cast<double>(exact[0] + exact[1] + exact[2]);
    return onFrame({static_cast<double>(exact[0]) / area, static_cast<double>(exact[1]) / area,
                    static_cast<double>(exact[2]) / area});
}

}  // namespace sherd
