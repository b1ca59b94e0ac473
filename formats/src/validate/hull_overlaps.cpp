// SPDX-License-Identifier: MIT
// Boxes swept along x say which hulls may meet.
#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "sherd/formats/hull_measures.h"

namespace sherd {

namespace {

/// Corners looked at: hundred thousand neighbours of bodies as they are baked. A file may hold
/// anything.
constexpr uint64_t kMostWork = 10'000'000;

struct GrownHull {
    uint32_t fragment;
    double margin;
    std::vector<glm::dvec3> points;
    glm::dvec3 low, high;
};

std::vector<GrownHull> grownHulls(const FractureSet& set) {
    std::vector<GrownHull> hulls;
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        const Range range = set.fragments[f].hulls;
        for (uint32_t h = range.first; h < range.first + range.count; ++h) {
            const Range points = set.hulls[h].points;
            const auto first = set.hullPoints.begin() + points.first;
            GrownHull hull{f, double{set.hulls[h].margin}, {first, first + points.count}, {}, {}};
            hull.low = hull.high = hull.points[0];
            for (const glm::dvec3& p : hull.points) {
                hull.low = glm::min(hull.low, p);
                hull.high = glm::max(hull.high, p);
            }
            hull.low -= hull.margin;
            hull.high += hull.margin;
            hulls.push_back(std::move(hull));
        }
    }
    return hulls;
}

/// Whether one is the other or part of it.
bool related(const FractureSet& set, uint32_t a, uint32_t b) {
    auto deeper = static_cast<int32_t>(std::max(a, b));
    const auto other = static_cast<int32_t>(std::min(a, b));
    while (deeper > other) deeper = set.fragments[static_cast<size_t>(deeper)].parent;
    return deeper == other;
}

bool boxesMeet(const GrownHull& a, const GrownHull& b) {
    return a.low.y <= b.high.y && b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

}  // namespace

ColliderOverlaps colliderOverlaps(const FractureSet& set, double tolerance) {
    const std::vector<GrownHull> hulls = grownHulls(set);
    std::vector<uint32_t> order(hulls.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return hulls[a].low.x != hulls[b].low.x ? hulls[a].low.x < hulls[b].low.x : a < b;
    });
    std::map<std::pair<uint32_t, uint32_t>, double> depths;
    ColliderOverlaps out;
    uint64_t work = 0;
    for (size_t i = 0; i < order.size() && out.complete; ++i) {
        const GrownHull& a = hulls[order[i]];
        for (size_t j = i + 1; j < order.size() && hulls[order[j]].low.x <= a.high.x; ++j) {
            const GrownHull& b = hulls[order[j]];
            if (!boxesMeet(a, b) || related(set, a.fragment, b.fragment)) continue;
            work += a.points.size() + b.points.size();
            out.complete = work < kMostWork;
            if (!out.complete) break;
            const double depth = a.margin + b.margin - hullDistance(a.points, b.points);
            if (!(depth > tolerance)) continue;
            double& deepest = depths[std::minmax(a.fragment, b.fragment)];
            deepest = std::max(deepest, depth);
        }
    }
    for (const auto& [pair, depth] : depths) out.pairs.push_back({pair.first, pair.second, depth});
    return out;
}

}  // namespace sherd
