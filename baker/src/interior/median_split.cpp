// SPDX-License-Identifier: MIT
// Selection by counting: how many members lie in each of many slices says in which slice the median
// is, and only there members are compared: no processor can guess how comparisons with a pivot end.
#include "interior/median_split.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>

namespace sherd {
namespace {

constexpr size_t kSlices = 1024;
constexpr size_t kFew = 64;  // members are not worth counting

struct Before {
    int axis;
    bool operator()(const SplitMember& a, const SplitMember& b) const {
        const float x = a.middle[axis], y = b.middle[axis];
        return x != y ? x < y : a.triangle < b.triangle;
    }
};

}  // namespace

void medianSplit(std::span<SplitMember> members, size_t left, std::vector<SplitMember>& scratch) {
    if (left == 0 || left >= members.size()) return;
    glm::vec3 low = members[0].middle, high = low;
    for (const SplitMember& m : members) {
        low = glm::min(low, m.middle);
        high = glm::max(high, m.middle);
    }
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const auto at = members.begin() + static_cast<std::ptrdiff_t>(left);
    const size_t slices = std::min(kSlices, members.size());
    const float perUnit = static_cast<float>(slices - 1) / size[axis];
    if (members.size() <= kFew || !(perUnit < 1e30F)) {
        std::nth_element(members.begin(), at, members.end(), Before{axis});
        return;
    }
    // A monotone function of the place, whatever its rounding.
    const auto sliceOf = [&](const SplitMember& m) {
        return static_cast<size_t>(static_cast<int32_t>((m.middle[axis] - low[axis]) * perUnit));
    };
    std::array<uint32_t, kSlices> count;  // all of it would take longer to clear than few members
    std::fill_n(count.begin(), slices, 0U);
    for (const SplitMember& m : members) ++count[sliceOf(m)];
    size_t slice = 0, below = 0;
    while (below + count[slice] <= left) below += count[slice++];
    std::array<size_t, 3> next{0, below, below + count[slice]};
    scratch.resize(std::max(scratch.size(), members.size()));
    for (const SplitMember& m : members) {
        const size_t s = sliceOf(m);
        const size_t side = static_cast<size_t>(s >= slice) + static_cast<size_t>(s > slice);
        scratch[next[side]++] = m;
    }
    std::copy_n(scratch.begin(), members.size(), members.begin());
    std::nth_element(members.begin() + static_cast<std::ptrdiff_t>(below), at,
                     members.begin() + static_cast<std::ptrdiff_t>(below + count[slice]),
                     Before{axis});
}

}  // namespace sherd
