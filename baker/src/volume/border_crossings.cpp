// SPDX-License-Identifier: MIT
#include "volume/border_crossings.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>
#include <utility>

namespace sherd {

std::vector<std::pair<uint32_t, uint32_t>> borderCrossings(
    const std::vector<BorderSegment>& segments, CapPlane& plane) {
    const auto low = [&](uint32_t s) {
        return glm::min(plane.place(segments[s].a), plane.place(segments[s].b));
    };
    const auto high = [&](uint32_t s) {
        return glm::max(plane.place(segments[s].a), plane.place(segments[s].b));
    };
    const auto cross = [&](const BorderSegment& s, const BorderSegment& t) {
        return plane.turn(s.a, s.b, t.a) * plane.turn(s.a, s.b, t.b) < 0 &&
               plane.turn(t.a, t.b, s.a) * plane.turn(t.a, t.b, s.b) < 0;
    };
    std::vector<uint32_t> order(segments.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](uint32_t s, uint32_t t) {
        return std::pair(low(s).x, s) < std::pair(low(t).x, t);
    });
    std::vector<std::pair<uint32_t, uint32_t>> result;
    std::vector<uint32_t> open;  // those that reach as far as the one at hand begins
    for (const uint32_t s : order) {
        std::erase_if(open, [&](uint32_t t) { return high(t).x < low(s).x - 1; });
        for (const uint32_t t : open) {
            if (high(t).y < low(s).y - 1 || high(s).y < low(t).y - 1) continue;
            if (cross(segments[s], segments[t]))
                result.emplace_back(std::min(s, t), std::max(s, t));
        }
        open.push_back(s);
    }
    return result;
}

}  // namespace sherd
