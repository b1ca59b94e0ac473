// SPDX-License-Identifier: MIT
#include "geometry/morton_order.h"

#include <algorithm>
#include <numeric>

#include "geometry/bounds.h"

namespace sherd {
namespace {

constexpr uint32_t kBitsPerAxis = 10;

/// The ten bits of x, two zeros between each.
uint32_t spread(uint32_t x) {
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

std::vector<uint32_t> mortonCodes(std::span<const glm::vec3> points) {
    Bounds bounds;
    for (const glm::vec3& p : points) bounds.add(p);
    const glm::dvec3 size = bounds.size();
    const double longest = std::max({size.x, size.y, size.z});
    const double steps = (1U << kBitsPerAxis) - 1;
    const double scale = longest > 0 ? steps / longest : 0;
    std::vector<uint32_t> codes;
    codes.reserve(points.size());
    for (const glm::vec3& p : points) {
        uint32_t code = 0;
        for (int k = 0; k < 3; ++k)
            code |= spread(static_cast<uint32_t>((p[k] - bounds.low[k]) * scale)) << k;
        codes.push_back(code);
    }
    return codes;
}

}  // namespace

MortonOrder mortonOrder(std::span<const glm::vec3> points) {
    constexpr uint32_t kDigits = 1U << kBitsPerAxis;
    const std::vector<uint32_t> codes = mortonCodes(points);
    MortonOrder order;
    std::vector<uint32_t> next(codes.size());
    order.items.resize(codes.size());
    std::iota(order.items.begin(), order.items.end(), 0U);
    for (uint32_t shift = 0; shift < 3 * kBitsPerAxis; shift += kBitsPerAxis) {
        std::vector<uint32_t> start(kDigits + 1, 0);
        for (const uint32_t code : codes) ++start[(code >> shift) % kDigits + 1];
        std::partial_sum(start.begin(), start.end(), start.begin());
        for (const uint32_t i : order.items) next[start[(codes[i] >> shift) % kDigits]++] = i;
        order.items.swap(next);
    }
    order.codes.reserve(codes.size());
    for (const uint32_t i : order.items) order.codes.push_back(codes[i]);
    return order;
}

}  // namespace sherd
