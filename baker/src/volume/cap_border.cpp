// SPDX-License-Identifier: MIT
#include "volume/cap_border.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>
#include <utility>

namespace sherd {

void CapBorder::start(uint32_t i, uint32_t j, std::span<const CapEdge> edges) {
    collectPoints(edges);
    plane_.start(vertices_, i, j);
    constexpr int64_t kFar = int64_t{1} << 27;  // everything is within 2^25 of the middle
    plane_.addFarAway(-kFar, -kFar);
    plane_.addFarAway(3 * kFar, -kFar);
    plane_.addFarAway(-kFar, 3 * kFar);
    for (const uint32_t v : vertexOf_) plane_.add(v);
    segments_.clear();
    sewn_.clear();
    for (const CapEdge& e : edges) {
        if (merged_.find(e.from) == merged_.find(e.to)) continue;
        const uint32_t a = pointOf(e.from), b = pointOf(e.to);
        segments_.push_back(
            {std::min(a, b), std::max(a, b), a < b ? e.times : -e.times, e.triangle});
    }
    addUp();
}

void CapBorder::collectPoints(std::span<const CapEdge> edges) {
    vertexOf_.clear();
    for (const CapEdge& e : edges) {
        const uint32_t from = merged_.find(e.from), to = merged_.find(e.to);
        if (from != to) vertexOf_.insert(vertexOf_.end(), {from, to});
    }
    std::sort(vertexOf_.begin(), vertexOf_.end());
    vertexOf_.erase(std::unique(vertexOf_.begin(), vertexOf_.end()), vertexOf_.end());
}

uint32_t CapBorder::pointOf(uint32_t vertex) {
    const auto it = std::lower_bound(vertexOf_.begin(), vertexOf_.end(), merged_.find(vertex));
    return kCorners + static_cast<uint32_t>(it - vertexOf_.begin());
}

/// Segments between the same points become one; those that cancel are gone.
void CapBorder::addUp() {
    std::sort(segments_.begin(), segments_.end(),
              [](const BorderSegment& s, const BorderSegment& t) {
                  return std::tie(s.a, s.b, s.triangle) < std::tie(t.a, t.b, t.triangle);
              });
    size_t kept = 0;
    for (size_t n = 0; n < segments_.size();) {
        BorderSegment sum = segments_[n++];
        while (n < segments_.size() && segments_[n].a == sum.a && segments_[n].b == sum.b)
            sum.times += segments_[n++].times;
        if (sum.times != 0) segments_[kept++] = sum;
    }
    segments_.resize(kept);
}

int CapBorder::timesOf(uint32_t from, uint32_t to) const {
    const uint32_t a = std::min(from, to), b = std::max(from, to);
    const auto it = std::lower_bound(
        segments_.begin(), segments_.end(), std::pair(a, b),
        [](const BorderSegment& s, const auto& key) { return std::pair(s.a, s.b) < key; });
    if (it == segments_.end() || it->a != a || it->b != b) return 0;
    return from == a ? it->times : -it->times;
}

uint32_t CapBorder::pointAt(uint32_t vertex) {
    const auto it = std::find(vertexOf_.begin(), vertexOf_.end(), vertex);
    const auto point = kCorners + static_cast<uint32_t>(it - vertexOf_.begin());
    if (it == vertexOf_.end()) {
        vertexOf_.push_back(vertex);
        plane_.add(vertex);
    }
    return point;
}

void CapBorder::split(uint32_t segment, uint32_t through) {
    const BorderSegment whole = segments_[segment];
    for (int n = 0; n < std::abs(whole.times); ++n) {
        sewn_.push_back({whole.a, whole.b, through});
        if (whole.times < 0) std::swap(sewn_.back()[0], sewn_.back()[1]);
    }
    segments_.push_back({whole.a, through, whole.times, whole.triangle});
    segments_[segment].a = through;
}

void CapBorder::settle() {
    for (BorderSegment& s : segments_) {
        if (s.a < s.b) continue;
        std::swap(s.a, s.b);
        s.times = -s.times;
    }
    addUp();
}

}  // namespace sherd
