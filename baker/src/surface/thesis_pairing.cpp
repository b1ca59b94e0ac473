// SPDX-License-Identifier: MIT
#include "surface/thesis_pairing.h"

#include <algorithm>
#include <cmath>

#include "surface/edge_resolution.h"

namespace sherd {
namespace {

constexpr double kFarthestTwin = 0.01;  ///< share of the edge
/// Averages are rounded to this part of the edge.
constexpr int64_t kPlaceGrain = int64_t{1} << 40;

struct Place {
    uint32_t halfEdge;
    LineParameter t;  ///< from the edge's low vertex
    CutEnd* end;
    bool forward;
};

/// The distinct parameters among places sorted by them.
std::vector<LineParameter> distinct(std::span<const Place> places) {
    std::vector<LineParameter> result;
    for (const Place& place : places) {
        if (result.empty() || result.back() != place.t) result.push_back(place.t);
    }
    return result;
}

bool ascendsInside(std::span<const LineParameter> t) {
    for (size_t i = 0; i < t.size(); ++i) {
        if (!t[i].insideOpen() || (i > 0 && !(t[i - 1] < t[i]))) return false;
    }
    return true;
}

/// Replaces both of every pair that is near enough by its average. Returns how many; none, with a
/// and b as they were, if the order along the edge would change.
uint32_t averagePairs(std::vector<LineParameter>& a, std::vector<LineParameter>& b) {
    std::vector<LineParameter> newA = a;
    std::vector<LineParameter> newB = b;
    uint32_t moved = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        const double x = a[i].approximate();
        const double y = b[i].approximate();
        if (a[i] == b[i] || std::abs(x - y) > kFarthestTwin) continue;
        newA[i] =
            newB[i] = {std::llround((x + y) / 2 * static_cast<double>(kPlaceGrain)), kPlaceGrain};
        ++moved;
    }
    if (!ascendsInside(newA) || !ascendsInside(newB)) return 0;
    a = std::move(newA);
    b = std::move(newB);
    return moved;
}

void move(std::span<const Place> places, std::span<const LineParameter> from,
          std::span<const LineParameter> to) {
    for (const Place& place : places) {
        const auto i =
            static_cast<size_t>(std::lower_bound(from.begin(), from.end(), place.t) - from.begin());
        place.end->t = place.forward ? to[i] : LineParameter{to[i].den - to[i].num, to[i].den};
    }
}

}  // namespace

uint32_t averageSeamPairs(const MeshTopology& topology, std::span<const SplitTriangle> triangles,
                          std::span<const UvTriangle> uv, std::span<Cut> cuts) {
    std::vector<Place> places;
    for (Cut& cut : cuts) {
        if (edgeAlong(cut) != 3) continue;
        for (CutEnd* end : {&cut.from, &cut.to}) {
            if (end->where != CutEnd::Where::edge) continue;
            const uint32_t h = 3 * cut.triangle + end->k;
            if (!isUvSeam(topology, uv, h)) continue;
            const bool forward =
                topology.edges[topology.halfEdgeEdge[h]].low == triangles[h / 3].v[h % 3];
            places.push_back({h,
                              forward ? end->t : LineParameter{end->t.den - end->t.num, end->t.den},
                              end, forward});
        }
    }
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return a.halfEdge != b.halfEdge ? a.halfEdge < b.halfEdge : a.t < b.t;
    });
    const auto ofHalfEdge = [&](uint32_t h) {
        const auto low =
            std::lower_bound(places.begin(), places.end(), h,
                             [](const Place& p, uint32_t x) { return p.halfEdge < x; });
        auto high = low;
        while (high != places.end() && high->halfEdge == h) ++high;
        return std::span<const Place>(low, high);
    };
    uint32_t moved = 0;
    for (size_t i = 0; i < places.size(); ++i) {
        const uint32_t h = places[i].halfEdge;
        const uint32_t o = topology.opposite[h];
        if ((i > 0 && places[i - 1].halfEdge == h) || o < h) continue;
        const std::span<const Place> here = ofHalfEdge(h);
        const std::span<const Place> there = ofHalfEdge(o);
        const std::vector<LineParameter> a = distinct(here);
        const std::vector<LineParameter> b = distinct(there);
        if (a.size() != b.size()) continue;
        std::vector<LineParameter> newA = a;
        std::vector<LineParameter> newB = b;
        const uint32_t count = averagePairs(newA, newB);
        if (count == 0) continue;
        move(here, a, newA);
        move(there, b, newB);
        moved += count;
    }
    return moved;
}

}  // namespace sherd
