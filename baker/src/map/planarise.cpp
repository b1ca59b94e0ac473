// SPDX-License-Identifier: MIT
// The arrangement of the drawn segments, exactly.
//
//   1. lines -> runs       snapped to the grid; collinear overlaps become one support
//   2. runs -> crossings   near pairs from a quadtree, decided on integers
//   3. order               each support's points sorted by exact parameter; equal ones are one node
//   4. nodes and edges     numbered by position and support, never by order of discovery
//
// A crossing that falls on a grid point is a grid node from the start, so an implicit crossing
// never equals a grid point, and two implicit ones are equal only if they meet on a common support.
#include <algorithm>
#include <optional>

#include "geometry/union_find.h"
#include "map/planar_map.h"
#include "map/segment_pairs.h"
#include "map/segment_runs.h"

namespace sherd {

namespace {

/// A drawing with more crossings than this is a mistake, and its memory would not be.
constexpr size_t kMaxCrossings = size_t{1} << 23;
/// Pairs looked at before giving up: about a minute.
constexpr uint64_t kMaxPairs = uint64_t{1} << 33;

struct GridTouch {
    uint32_t support;
    GridPoint point;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads a defaulted <=>
    friend auto operator<=>(const GridTouch&, const GridTouch&) = default;
};

struct Crossing {
    uint32_t first, second;  ///< supports, first < second
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads a defaulted <=>
    friend auto operator<=>(const Crossing&, const Crossing&) = default;
};

struct Crossings {
    std::vector<GridTouch> touches;
    std::vector<Crossing> implicit;
};

template <class T>
void sortUnique(std::vector<T>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// Adds the point that supports i and j share, if any.
void cross(std::span<const Support> supports, uint32_t i, uint32_t j, Crossings& out) {
    const auto [a, b] = supports[i];
    const auto [c, d] = supports[j];
    if (a == c || a == d || b == c || b == d) return;  // shared ends are nodes of both already
    const int sideC = signOf(orientation(a, b, c));
    const int sideD = signOf(orientation(a, b, d));
    if (sideC * sideD > 0) return;
    const int sideA = signOf(orientation(c, d, a));
    const int sideB = signOf(orientation(c, d, b));
    if (sideA * sideB > 0) return;
    const std::optional<LineParameter> t = crossingParameter(a, b, c, d);
    if (!t) return;  // two runs of one line share no point
    if (const std::optional<GridPoint> point = gridPointAt(a, b, *t)) {
        out.touches.push_back({i, *point});
        out.touches.push_back({j, *point});
    } else {
        out.implicit.push_back({i, j});
    }
}

Result<Crossings> findCrossings(const SegmentRuns& runs, std::span<const Support> supports) {
    Crossings out;
    uint64_t pairs = 0;
    const bool whole = forEachNearPair(supports, [&](uint32_t i, uint32_t j) {
        cross(supports, i, j, out);
        return ++pairs < kMaxPairs && out.touches.size() + out.implicit.size() < kMaxCrossings;
    });
    if (!whole)
        return fail(ErrorCode::limitExceeded, "the fracture lines cross each other more than " +
                                                  std::to_string(kMaxCrossings) +
                                                  " times; draw fewer lines");
    for (uint32_t s = 0; s < runs.runs.size(); ++s) {
        const SegmentRun& run = runs.runs[s];
        out.touches.push_back({s, run.support.b});
        for (uint32_t p = 0; p < run.pieceCount; ++p)
            out.touches.push_back({s, runs.pieces[run.firstPiece + p].from});
    }
    sortUnique(out.touches);
    sortUnique(out.implicit);
    return out;
}

/// A node's place on a support.
struct Stop {
    LineParameter t;
    double approximate;
    uint32_t node;
};

bool stopsBefore(const Stop& x, const Stop& y) {
    // Parameters lie in [0, 1]: their approximations err by less than 2^-51 each.
    constexpr double kSure = 0x1p-49;
    const double difference = x.approximate - y.approximate;
    if (difference < -kSure) return true;
    if (difference > kSure) return false;
    return x.t < y.t;
}

struct Stops {
    std::vector<size_t> first;  ///< per support, and one past the end
    std::vector<Stop> stops;
};

/// All nodes of each support in order. Grid nodes are numbered 0.., then implicit ones.
Stops orderStops(std::span<const Support> supports, const Crossings& crossings,
                 std::span<const GridPoint> gridPoints) {
    Stops out;
    out.first.assign(supports.size() + 1, 0);
    for (const GridTouch& touch : crossings.touches) ++out.first[touch.support + 1];
    for (const Crossing& crossing : crossings.implicit) {
        ++out.first[crossing.first + 1];
        ++out.first[crossing.second + 1];
    }
    std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
    out.stops.resize(out.first.back());

    std::vector<size_t> next(out.first.begin(), out.first.end() - 1);
    const auto add = [&](uint32_t support, LineParameter t, size_t node) {
        out.stops[next[support]++] = {t, t.approximate(), static_cast<uint32_t>(node)};
    };
    for (const GridTouch& touch : crossings.touches) {
        const auto [a, b] = supports[touch.support];
        const auto at = std::lower_bound(gridPoints.begin(), gridPoints.end(), touch.point);
        add(touch.support, gridParameter(a, b, touch.point),
            static_cast<size_t>(at - gridPoints.begin()));
    }
    for (size_t k = 0; k < crossings.implicit.size(); ++k) {
        const auto [i, j] = crossings.implicit[k];
        const Support& x = supports[i];
        const Support& y = supports[j];
        add(i, *crossingParameter(x.a, x.b, y.a, y.b), gridPoints.size() + k);
        add(j, *crossingParameter(y.a, y.b, x.a, x.b), gridPoints.size() + k);
    }
    for (size_t s = 0; s < supports.size(); ++s)
        std::sort(out.stops.begin() + static_cast<ptrdiff_t>(out.first[s]),
                  out.stops.begin() + static_cast<ptrdiff_t>(out.first[s + 1]), stopsBefore);
    return out;
}

/// Where several supports meet in one point, their pairwise crossings are one node: the lowest
/// number stands for all.
UnionFind uniteEqualStops(const Stops& stops, size_t nodeCount) {
    UnionFind same(nodeCount);
    for (size_t s = 0; s + 1 < stops.first.size(); ++s)
        for (size_t k = stops.first[s] + 1; k < stops.first[s + 1]; ++k)
            if (stops.stops[k - 1].t == stops.stops[k].t)
                same.unite(stops.stops[k - 1].node, stops.stops[k].node);
    return same;
}

/// Fills in the nodes; returns the final number of each provisional one.
std::vector<uint32_t> numberNodes(const Crossings& crossings, std::span<const GridPoint> gridPoints,
                                  UnionFind& same, PlanarMap& map) {
    std::vector<uint32_t> number(gridPoints.size() + crossings.implicit.size());
    for (uint32_t i = 0; i < number.size(); ++i) {
        const uint32_t root = same.find(i);
        number[i] = root == i ? static_cast<uint32_t>(map.nodes.size()) : number[root];
        if (root != i) continue;
        MapNode node;
        if (i < gridPoints.size()) {
            node.point = gridPoints[i];
        } else {
            const auto [first, second] = crossings.implicit[i - gridPoints.size()];
            node.first = static_cast<int32_t>(first);
            node.second = static_cast<int32_t>(second);
        }
        map.nodes.push_back(node);
    }
    return number;
}

void addEdges(const SegmentRuns& runs, const Stops& stops, std::span<const uint32_t> number,
              PlanarMap& map) {
    for (uint32_t s = 0; s < runs.runs.size(); ++s) {
        const RunPiece* piece = &runs.pieces[runs.runs[s].firstPiece];
        for (size_t k = stops.first[s] + 1; k < stops.first[s + 1]; ++k) {
            const uint32_t from = number[stops.stops[k - 1].node];
            const uint32_t to = number[stops.stops[k].node];
            if (from == to) continue;
            if (map.nodes[from].first < 0 && map.nodes[from].point == piece->to) ++piece;
            map.edges.push_back({from, to, s, piece->level, piece->line});
        }
    }
}

}  // namespace

Result<PlanarMap> planarise(const FractureMap& input) {
    Result<SegmentRuns> runs = collectRuns(input);
    if (!runs) return tl::unexpected(runs.error());

    PlanarMap map;
    map.warnings = std::move(runs->warnings);
    for (const SegmentRun& run : runs->runs) map.supports.push_back(run.support);

    const Result<Crossings> crossings = findCrossings(*runs, map.supports);
    if (!crossings) return tl::unexpected(crossings.error());
    std::vector<GridPoint> gridPoints;
    gridPoints.reserve(crossings->touches.size());
    for (const GridTouch& touch : crossings->touches) gridPoints.push_back(touch.point);
    sortUnique(gridPoints);

    const Stops stops = orderStops(map.supports, *crossings, gridPoints);
    UnionFind same = uniteEqualStops(stops, gridPoints.size() + crossings->implicit.size());
    const std::vector<uint32_t> number = numberNodes(*crossings, gridPoints, same, map);
    addEdges(*runs, stops, number, map);
    return map;
}

glm::dvec2 nodeUv(const PlanarMap& map, uint32_t node) {
    const MapNode& n = map.nodes[node];
    if (n.first < 0) return glm::dvec2(n.point.u, n.point.v) / static_cast<double>(kGridOne);
    const auto [a, b] = map.supports[static_cast<size_t>(n.first)];
    const auto [c, d] = map.supports[static_cast<size_t>(n.second)];
    const std::optional<LineParameter> t = crossingParameter(a, b, c, d);
    const glm::dvec2 start(a.u, a.v);
    const glm::dvec2 end(b.u, b.v);
    return (start + (t ? t->approximate() : 0.0) * (end - start)) / static_cast<double>(kGridOne);
}

}  // namespace sherd
