// SPDX-License-Identifier: MIT
// A quadtree over segments, descended only as long as that separates them. Cells hold the segments
// that pass through them, not those whose boxes do, so long slanted lines cost what they cross.
// What no cell size separates (a bundle of long, nearly parallel lines) is swept along the
// direction, out of a few, in which the segments' projections overlap least: for a bundle that is
// its normal. Where even that leaves the square of them and smaller cells hold fewer, cells
// are split on.
#include "map/segment_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace sherd {

namespace {

constexpr size_t kSmallCell = 16;     ///< at most this many: all pairs
constexpr size_t kFewOverlaps = 8;    ///< a sweep over no more pairs than this per entry is made
constexpr double kUsefulSplit = 1.6;  ///< a split that multiplies the entries by more is not made

struct Box {
    int32_t minU, minV, maxU, maxV;  ///< closed
};

struct Direction {
    int64_t u, v;
};

bool boxesMeet(const Support& x, const Support& y) {
    // a < b orders by u first, so a.u <= b.u; v may run either way.
    return x.a.u <= y.b.u && y.a.u <= x.b.u && std::min(x.a.v, x.b.v) <= std::max(y.a.v, y.b.v) &&
           std::min(y.a.v, y.b.v) <= std::max(x.a.v, x.b.v);
}

bool passesThrough(const Support& s, const Box& box) {
    if (s.a.u > box.maxU || s.b.u < box.minU) return false;
    if (std::min(s.a.v, s.b.v) > box.maxV || std::max(s.a.v, s.b.v) < box.minV) return false;
    const std::array<int, 4> sides = {signOf(orientation(s.a, s.b, {box.minU, box.minV})),
                                      signOf(orientation(s.a, s.b, {box.maxU, box.minV})),
                                      signOf(orientation(s.a, s.b, {box.minU, box.maxV})),
                                      signOf(orientation(s.a, s.b, {box.maxU, box.maxV}))};
    const auto [low, high] = std::minmax_element(sides.begin(), sides.end());
    return *low <= 0 && *high >= 0;
}

class PairFinder {
  public:
    PairFinder(std::span<const Support> segments,
               const std::function<bool(uint32_t, uint32_t)>& visit)
        : segments_(segments), visit_(visit) {}

    bool descend(const std::vector<uint32_t>& items, const Box& box) {
        if (items.size() <= kSmallCell) return allPairs(items);
        if (box.maxU - box.minU < 2 || box.maxV - box.minV < 2) return sweep(bestSweep(items, box));
        const int32_t midU = box.minU + (box.maxU - box.minU) / 2;
        const int32_t midV = box.minV + (box.maxV - box.minV) / 2;
        const std::array<Box, 4> boxes = {
            Box{box.minU, box.minV, midU, midV}, Box{midU, box.minV, box.maxU, midV},
            Box{box.minU, midV, midU, box.maxV}, Box{midU, midV, box.maxU, box.maxV}};
        std::array<std::vector<uint32_t>, 4> children;
        size_t entries = 0;
        size_t largest = 0;
        for (size_t k = 0; k < 4; ++k) {
            for (const uint32_t i : items)
                if (passesThrough(segments_[i], boxes[k])) children[k].push_back(i);
            entries += children[k].size();
            largest = std::max(largest, children[k].size());
        }
        if (static_cast<double>(entries) > kUsefulSplit * static_cast<double>(items.size())) {
            const Sweep best = bestSweep(items, box);
            // Bundles that meet, as at the corners of nested outlines, part in smaller cells; lines
            // through one point never do.
            const bool parts = largest <= items.size() / 4 * 3;
            if (!parts || best.overlaps <= kFewOverlaps * entries) return sweep(best);
        }
        for (size_t k = 0; k < 4; ++k)
            if (!descend(children[k], boxes[k])) return false;
        return true;
    }

  private:
    struct Interval {
        int64_t low, high;
        uint32_t item;
    };

    bool test(uint32_t i, uint32_t j) {
        if (!boxesMeet(segments_[i], segments_[j])) return true;
        return visit_(std::min(i, j), std::max(i, j));
    }

    bool allPairs(const std::vector<uint32_t>& items) {
        for (size_t x = 0; x < items.size(); ++x)
            for (size_t y = x + 1; y < items.size(); ++y)
                if (!test(items[x], items[y])) return false;
        return true;
    }

    /// From where to where, 0 to 1, a segment runs through the box, a unit wider all around.
    static std::pair<double, double> stretchIn(const Support& s, const Box& box) {
        double from = 0;
        double to = 1;
        const auto clip = [&](int32_t a, int32_t b, int32_t low, int32_t high) {
            if (a == b) return;
            const double length = double{1} * b - a;
            const auto [x, y] = std::minmax(
                {(double{1} * low - 1 - a) / length, (double{1} * high + 1 - a) / length});
            from = std::max(from, x);
            to = std::min(to, y);
        };
        clip(s.a.u, s.b.u, box.minU, box.maxU);
        clip(s.a.v, s.b.v, box.minV, box.maxV);
        return {from, to};
    }

    /// Where along d the segments run within the box: only there their meeting counts.
    std::vector<Interval> project(const std::vector<uint32_t>& items, const Box& box,
                                  Direction d) const {
        std::vector<Interval> intervals;
        intervals.reserve(items.size());
        const int64_t slack = 2 * (std::abs(d.u) + std::abs(d.v));  // two units: more than rounding
        for (const uint32_t i : items) {
            const auto [a, b] = segments_[i];
            const int64_t start = d.u * a.u + d.v * a.v;
            const int64_t end = d.u * b.u + d.v * b.v;
            const auto [from, to] = stretchIn(segments_[i], box);
            const auto along = static_cast<double>(end - start);
            const int64_t first = start + static_cast<int64_t>(from * along);
            const int64_t last = start + static_cast<int64_t>(to * along);
            const auto [low, high] = std::minmax({start, end});
            intervals.push_back({std::max(low, std::min(first, last) - slack),
                                 std::min(high, std::max(first, last) + slack), i});
        }
        std::sort(intervals.begin(), intervals.end(), [](const Interval& x, const Interval& y) {
            return x.low != y.low ? x.low < y.low : x.item < y.item;
        });
        return intervals;
    }

    /// How many pairs of intervals overlap: for each, the later ones that start before it ends.
    static size_t overlaps(const std::vector<Interval>& sorted) {
        size_t count = 0;
        for (size_t i = 0; i < sorted.size(); ++i) {
            const auto after = std::upper_bound(
                sorted.begin(), sorted.end(), sorted[i].high,
                [](int64_t high, const Interval& interval) { return high < interval.low; });
            count += static_cast<size_t>(after - sorted.begin()) - i - 1;
        }
        return count;
    }

    std::vector<Direction> directions(const std::vector<uint32_t>& items) const {
        Direction normal{1, 0};
        int64_t longest = 0;
        for (const uint32_t i : items) {
            const auto [a, b] = segments_[i];
            const int64_t du = int64_t{b.u} - a.u;
            const int64_t dv = int64_t{b.v} - a.v;
            if (std::abs(du) + std::abs(dv) <= longest) continue;
            longest = std::abs(du) + std::abs(dv);
            normal = {-dv, du};
        }
        return {{1, 0}, {0, 1}, {1, 1}, {1, -1}, normal};
    }

    struct Sweep {
        std::vector<Interval> intervals;
        size_t overlaps = SIZE_MAX;
    };

    Sweep bestSweep(const std::vector<uint32_t>& items, const Box& box) const {
        Sweep best;
        for (const Direction d : directions(items)) {
            std::vector<Interval> intervals = project(items, box, d);
            const size_t count = overlaps(intervals);
            if (count < best.overlaps) best = {std::move(intervals), count};
        }
        return best;
    }

    bool sweep(const Sweep& best) {
        const std::vector<Interval>& all = best.intervals;
        for (size_t i = 0; i < all.size(); ++i)
            for (size_t j = i + 1; j < all.size() && all[j].low <= all[i].high; ++j)
                if (!test(all[i].item, all[j].item)) return false;
        return true;
    }

    std::span<const Support> segments_;
    const std::function<bool(uint32_t, uint32_t)>& visit_;
};

}  // namespace

bool forEachNearPair(std::span<const Support> segments,
                     const std::function<bool(uint32_t, uint32_t)>& visit) {
    Box box{kGridLimit, kGridLimit, -kGridLimit, -kGridLimit};
    for (const Support& s : segments) {
        box.minU = std::min(box.minU, s.a.u);
        box.maxU = std::max(box.maxU, s.b.u);
        box.minV = std::min({box.minV, s.a.v, s.b.v});
        box.maxV = std::max({box.maxV, s.a.v, s.b.v});
    }
    std::vector<uint32_t> all(segments.size());
    std::iota(all.begin(), all.end(), 0U);
    return PairFinder(segments, visit).descend(all, box);
}

}  // namespace sherd
