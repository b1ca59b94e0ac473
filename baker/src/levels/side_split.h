// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace sherd {

/// A triangle, what lies on its sides, and which line each side is part of.
struct SideSplit {
    std::array<uint32_t, 3> v;
    std::array<std::vector<uint32_t>, 3> inner;  ///< from corner k to corner k + 1
    std::array<uint32_t, 3> mark{};
};

/// Whether two sides are the same way there and back: then they cancel, and nothing is between.
inline bool isFlat(const SideSplit& t) {
    for (size_t k = 0; k < 3; ++k) {
        if (t.v[k] != t.v[(k + 1) % 3] || !t.inner[k].empty()) continue;
        const std::vector<uint32_t>&there = t.inner[(k + 1) % 3], &back = t.inner[(k + 2) % 3];
        return std::equal(there.begin(), there.end(), back.rbegin(), back.rend());
    }
    return false;
}

/// Triangles with the same sides and all points on them. Halving the side with the most keeps them
/// from getting thin. Seen from the other side the same triangles come out.
template <class Emit>
void subdivide(const SideSplit& t, const Emit& emit) {
    if (isFlat(t)) return;
    const auto rank = [&](size_t k) {
        return std::tuple(t.inner[k].size(), std::min(t.v[k], t.v[(k + 1) % 3]),
                          std::max(t.v[k], t.v[(k + 1) % 3]));
    };
    size_t k = 0;
    for (size_t n = 1; n < 3; ++n)
        if (rank(n) > rank(k)) k = n;
    if (t.inner[k].empty()) return emit(t);
    const size_t next = (k + 1) % 3, last = (k + 2) % 3;
    const std::vector<uint32_t>& side = t.inner[k];
    const size_t half = t.v[k] < t.v[next] ? side.size() / 2 : (side.size() - 1) / 2;
    const auto middle = static_cast<std::ptrdiff_t>(half);
    const uint32_t m = side[static_cast<size_t>(middle)];
    SideSplit first, second;
    first.v = {t.v[k], m, t.v[last]};
    first.inner = {std::vector(side.begin(), side.begin() + middle), {}, t.inner[last]};
    first.mark = {t.mark[k], 0, t.mark[last]};
    second.v = {m, t.v[next], t.v[last]};
    second.inner = {std::vector(side.begin() + middle + 1, side.end()), t.inner[next], {}};
    second.mark = {t.mark[k], t.mark[next], 0};
    subdivide(first, emit);
    subdivide(second, emit);
}

}  // namespace sherd
