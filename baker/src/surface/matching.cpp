// SPDX-License-Identifier: MIT
#include "surface/matching.h"

#include <algorithm>
#include <optional>

namespace sherd {
namespace {

/// A view of the map that is reflected (u -> -u) for mirrored triangles.
class MapView {
  public:
    MapView(const PlanarMap& map, bool mirrored) : map_(map), mirrored_(mirrored) {}

    GridPoint point(GridPoint p) const { return mirrored_ ? GridPoint{-p.u, p.v} : p; }
    GridPoint supportA(uint32_t s) const { return point(map_.supports[s].a); }
    GridPoint supportB(uint32_t s) const { return point(map_.supports[s].b); }

    /// -1, 0, 1: the node's side of p -> q.
    int side(uint32_t node, GridPoint p, GridPoint q) const {
        const MapNode& n = map_.nodes[node];
        if (n.first < 0) return signOf(orientation(p, q, point(n.point)));
        return sideOfCrossing(p, q, supportA(n.first), supportB(n.first), supportA(n.second),
                              supportB(n.second));
    }

    /// The parameter along p -> q of a node that lies on that line.
    LineParameter parameter(uint32_t node, GridPoint p, GridPoint q) const {
        const MapNode& n = map_.nodes[node];
        if (n.first < 0) return gridParameter(p, q, point(n.point));
        const auto t = crossingParameter(p, q, supportA(n.first), supportB(n.first));
        return t ? *t : *crossingParameter(p, q, supportA(n.second), supportB(n.second));
    }

  private:
    const PlanarMap& map_;
    bool mirrored_;
};

enum class Along : uint8_t { before, within, after };

/// A node on the line through a triangle: before it, within (closed), or after.
struct NodePlace {
    Along along = Along::within;
    CutEnd end;
};

NodePlace placeNode(const MapView& view, const std::array<GridPoint, 3>& corner, uint32_t node,
                    GridPoint a, GridPoint b) {
    std::array<int, 3> side{};
    for (size_t k = 0; k < 3; ++k) {
        const GridPoint p = corner[k];
        const GridPoint q = corner[(k + 1) % 3];
        side[k] = view.side(node, p, q);
        // Outside edge k: the line still has to enter its half plane, or has left it.
        if (side[k] < 0) return {crossOf(p, q, a, b) > 0 ? Along::before : Along::after, {}};
    }
    NodePlace place;
    for (uint8_t k = 0; k < 3; ++k) {
        const auto next = static_cast<uint8_t>((k + 1) % 3);
        if (side[k] != 0) continue;
        if (side[(k + 2) % 3] == 0) {  // on this edge and the one before: their corner
            place.end = {CutEnd::Where::corner, k, {}, 0};
            return place;
        }
        if (side[next] == 0) {
            place.end = {CutEnd::Where::corner, next, {}, 0};
            return place;
        }
        place.end = {CutEnd::Where::edge, k, view.parameter(node, corner[k], corner[next]), 0};
        return place;
    }
    place.end = {CutEnd::Where::inside, 0, {}, node};
    return place;
}

/// The part of a map edge inside a regular triangle, if it is more than a point.
std::optional<Cut> clip(const PlanarMap& map, const MapView& view,
                        const std::array<GridPoint, 3>& corner, uint32_t mapEdge) {
    const MapEdge& edge = map.edges[mapEdge];
    const GridPoint a = view.supportA(edge.support);
    const GridPoint b = view.supportB(edge.support);
    const LineCrossing line = lineThroughTriangle(corner, a, b);
    if (!line.crosses) return std::nullopt;
    const NodePlace from = placeNode(view, corner, edge.from, a, b);
    if (from.along == Along::after) return std::nullopt;
    const NodePlace to = placeNode(view, corner, edge.to, a, b);
    if (to.along == Along::before) return std::nullopt;
    Cut cut;
    cut.from = from.along == Along::before ? line.entry : from.end;
    cut.to = to.along == Along::after ? line.exit : to.end;
    if (cut.from == cut.to) return std::nullopt;
    cut.mapEdge = mapEdge;
    return cut;
}

/// A triangle whose corners lie on one UV line: low <= middle <= high along it. Every UV place of
/// it lies on the long edge and on one of the short ones; a line through it runs between those two.
class CollinearTriangle {
  public:
    explicit CollinearTriangle(const std::array<GridPoint, 3>& corner) : corner_(corner) {
        std::sort(order_.begin(), order_.end(),
                  [&](uint8_t x, uint8_t y) { return corner[x] < corner[y]; });
    }
    GridPoint low() const { return corner_[order_[0]]; }
    GridPoint middle() const { return corner_[order_[1]]; }
    GridPoint high() const { return corner_[order_[2]]; }

    /// The place at parameter `alongLong` of low -> high; `alongShort` gives its parameter on a
    /// short edge from the first to the second of two grid points.
    template <class AlongShort>
    std::optional<Cut> cutAt(LineParameter alongLong, AlongShort&& alongShort) const {
        if (!alongLong.insideClosed()) return std::nullopt;
        const bool atLow = alongLong.num == 0;
        const bool atHigh = alongLong.num == alongLong.den;
        if (atLow || atHigh) {
            // Only where two corners share that UV point does the line pass: along the edge of
            // them.
            const uint8_t end = atLow ? order_[0] : order_[2];
            if (corner_[end] != middle()) return std::nullopt;
            return Cut{0, cornerEnd(end), cornerEnd(order_[1]), 1, 0};
        }
        Cut cut;
        cut.from = edgeEnd(order_[0], order_[2], alongLong);
        const LineParameter atMiddle = gridParameter(low(), high(), middle());
        if (alongLong == atMiddle) {
            cut.to = cornerEnd(order_[1]);
        } else if (alongLong < atMiddle) {
            cut.to = edgeEnd(order_[0], order_[1], alongShort(low(), middle()));
        } else {
            cut.to = edgeEnd(order_[1], order_[2], alongShort(middle(), high()));
        }
        return cut;
    }

  private:
    static CutEnd cornerEnd(uint8_t k) { return {CutEnd::Where::corner, k, {}, 0}; }
    static CutEnd edgeEnd(uint8_t from, uint8_t to, LineParameter t) {
        if (to == (from + 1) % 3) return {CutEnd::Where::edge, from, t, 0};
        return {CutEnd::Where::edge, to, {t.den - t.num, t.den}, 0};
    }

    std::array<GridPoint, 3> corner_;
    std::array<uint8_t, 3> order_{0, 1, 2};
};

void conduct(const PlanarMap& map, uint32_t mapEdge, const CollinearTriangle& triangle,
             std::vector<Cut>& cuts) {
    const MapEdge& edge = map.edges[mapEdge];
    const MapView view(map, false);
    const GridPoint a = view.supportA(edge.support);
    const GridPoint b = view.supportB(edge.support);
    const auto add = [&](const std::optional<Cut>& cut) {
        if (!cut) return;
        cuts.push_back(*cut);
        cuts.back().mapEdge = mapEdge;
    };
    const int fromSide = view.side(edge.from, triangle.low(), triangle.high());
    const int toSide = view.side(edge.to, triangle.low(), triangle.high());
    if (fromSide == 0 && toSide == 0) {  // along the triangle's own line: it passes at its ends
        for (const uint32_t node : {edge.from, edge.to}) {
            const auto at = [&](GridPoint p, GridPoint q) { return view.parameter(node, p, q); };
            add(triangle.cutAt(at(triangle.low(), triangle.high()), at));
        }
        return;
    }
    if (fromSide * toSide > 0) return;
    const auto at = [&](GridPoint p, GridPoint q) { return *crossingParameter(p, q, a, b); };
    add(triangle.cutAt(at(triangle.low(), triangle.high()), at));
}

}  // namespace

void matchInTriangle(const PlanarMap& map, std::span<const uint32_t> candidates, uint32_t index,
                     const UvTriangle& triangle, std::vector<Cut>& cuts) {
    const size_t first = cuts.size();
    if (triangle.kind == UvKind::collinear) {
        const CollinearTriangle collinear(triangle.corner);
        for (const uint32_t e : candidates) conduct(map, e, collinear, cuts);
    } else if (triangle.kind != UvKind::point) {
        const MapView view(map, triangle.kind == UvKind::mirrored);
        const std::array<GridPoint, 3> corner = orientedCorners(triangle);
        for (const uint32_t e : candidates) {
            if (const std::optional<Cut> cut = clip(map, view, corner, e)) cuts.push_back(*cut);
        }
    }
    for (size_t i = first; i < cuts.size(); ++i) cuts[i].triangle = index;
}

std::vector<Cut> matchAll(const PlanarMap& map, std::span<const uint32_t> marks,
                          std::span<const UvTriangle> triangles, std::span<const uint8_t> skip) {
    MapIndex mapIndex(map);
    std::vector<Cut> cuts;
    std::vector<uint32_t> candidates;
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (skip[t] != 0) continue;
        const auto& c = triangles[t].corner;
        const GridPoint low{std::min({c[0].u, c[1].u, c[2].u}), std::min({c[0].v, c[1].v, c[2].v})};
        const GridPoint high{std::max({c[0].u, c[1].u, c[2].u}),
                             std::max({c[0].v, c[1].v, c[2].v})};
        mapIndex.query(low, high, candidates);
        if (!candidates.empty()) matchInTriangle(map, candidates, t, triangles[t], cuts);
    }
    for (Cut& cut : cuts) cut.line = marks[map.edges[cut.mapEdge].line];
    return cuts;
}

}  // namespace sherd
