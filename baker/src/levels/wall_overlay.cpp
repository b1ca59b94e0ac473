// SPDX-License-Identifier: MIT
#include "levels/wall_overlay.h"

#include <algorithm>
#include <set>
#include <utility>

#include "geometry/constrained_triangulation.h"

namespace sherd {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

ExactPoint pointAlong(GridPoint p, GridPoint q, LineParameter t) {
    ExactPoint r;
    r.x = Int128{t.den} * p.u + Int128{t.num} * (int64_t{q.u} - p.u);
    r.y = Int128{t.den} * p.v + Int128{t.num} * (int64_t{q.v} - p.v);
    r.w = t.den;
    r.setApproximation();
    return r;
}

/// Of the frame's sides, those a point lies on.
uint32_t sidesOf(GridPoint p) {
    return (p.v == 0 ? 1U : 0U) | (p.u + p.v == WallOverlayInput::kSide ? 2U : 0U) |
           (p.u == 0 ? 4U : 0U);
}

class Overlay {
  public:
    explicit Overlay(const WallOverlayInput& input) : in_(input) {}

    std::optional<WallOverlay> run() {
        for (const auto& cut : in_.cuts)
            if (!fills(cut)) return std::nullopt;
        addPoints();
        for (size_t side = 0; side < 2; ++side) edges_[side] = innerEdges(in_.cuts[side]);
        for (const Edge& a : edges_[0])
            for (const Edge& b : edges_[1]) addCrossing(a, b);
        std::set<Edge> all(edges_[0].begin(), edges_[0].end());
        all.insert(edges_[1].begin(), edges_[1].end());
        const std::vector<Edge> constraints(all.begin(), all.end());
        for (const Edge& e : constraints) local_.constraints.push_back({e.first, e.second, 1});
        const TriangulationResult result = triangulate(local_);
        if (!result.valid) return std::nullopt;
        for (const auto& passage : result.passages)
            addOnEdge(constraints[passage.constraint], passage.point);
        for (const auto& t : result.triangles)
            if (!addPart(t.v)) return std::nullopt;
        return std::move(out_);
    }

  private:
    bool fills(const WallOverlayInput::Triangles& cut) const {
        Int128 area = 0;
        for (const auto& t : cut) {
            const int64_t part = orientation(in_.points[t[0]], in_.points[t[1]], in_.points[t[2]]);
            if (part <= 0) return false;
            area += part;
        }
        return area == Int128{WallOverlayInput::kSide} * WallOverlayInput::kSide;
    }

    void addPoints() {
        for (const GridPoint p : in_.points) {
            ExactPoint exact = pointAlong(p, p, {0, 1});
            exact.lines = sidesOf(p);
            local_.points.push_back(exact);
        }
        local_.shape = in_.shape;
    }

    std::set<Edge> innerEdges(const WallOverlayInput::Triangles& cut) const {
        std::set<Edge> edges;
        for (const auto& t : cut) {
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t a = t[k], b = t[(k + 1) % 3];
                if ((local_.points[a].lines & local_.points[b].lines) == 0)
                    edges.insert(std::minmax(a, b));
            }
        }
        return edges;
    }

    void addCrossing(const Edge& x, const Edge& y) {
        const GridPoint a = in_.points[x.first], b = in_.points[x.second];
        const GridPoint c = in_.points[y.first], d = in_.points[y.second];
        const int ofC = signOf(orientation(a, b, c)), ofD = signOf(orientation(a, b, d));
        if (ofC * ofD >= 0) return;
        if (signOf(orientation(c, d, a)) * signOf(orientation(c, d, b)) >= 0) return;
        const LineParameter t = *crossingParameter(a, b, c, d);
        const double share = t.approximate();
        const auto point = static_cast<uint32_t>(local_.points.size());
        local_.points.push_back(pointAlong(a, b, t));
        local_.shape.push_back(in_.shape[x.first] * (1 - share) + in_.shape[x.second] * share);
        out_.crossings.push_back({x.first, x.second, share, point});
    }

    void addOnEdge(const Edge& edge, uint32_t point) {
        const ExactPoint& a = local_.points[edge.first];
        const ExactPoint& b = local_.points[edge.second];
        const ExactPoint& p = local_.points[point];
        const double dx = b.ax - a.ax, dy = b.ay - a.ay;
        const double share = ((p.ax - a.ax) * dx + (p.ay - a.ay) * dy) / (dx * dx + dy * dy);
        out_.onEdges.push_back({edge.first, edge.second, share, point});
    }

    bool addPart(const std::array<uint32_t, 3>& v) {
        WallOverlay::Part part{v, {}};
        for (size_t side = 0; side < 2; ++side) {
            const auto& cut = in_.cuts[side];
            const auto holder =
                std::find_if(cut.begin(), cut.end(), [&](const auto& t) { return holds(t, v); });
            if (holder == cut.end()) return false;
            part.of[side] = static_cast<uint32_t>(holder - cut.begin());
        }
        out_.parts.push_back(part);
        return true;
    }

    bool holds(const std::array<uint32_t, 3>& t, const std::array<uint32_t, 3>& v) const {
        for (size_t k = 0; k < 3; ++k) {
            for (const uint32_t p : v) {
                if (p == t[k] || p == t[(k + 1) % 3]) continue;
                if (orientation(local_.points[t[k]], local_.points[t[(k + 1) % 3]],
                                local_.points[p], WallOverlayInput::kSide) < 0)
                    return false;
            }
        }
        return true;
    }

    const WallOverlayInput& in_;
    std::array<std::set<Edge>, 2> edges_;
    TriangulationInput local_;
    WallOverlay out_;
};

}  // namespace

std::optional<WallOverlay> overlayWall(const WallOverlayInput& input) {
    return Overlay(input).run();
}

}  // namespace sherd
