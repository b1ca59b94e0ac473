// SPDX-License-Identifier: MIT
#include "surface/seam_joining.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

#include "geometry/triangle.h"
#include "geometry/union_find.h"

namespace sherd {
namespace {

/// Ends of lines at one place of a seam, on one of its sides.
/// side: the half edge for an edge point, the wedge (corner class) for a mesh vertex.
struct SeamEnd {
    uint32_t id;  ///< mesh vertex or edge point
    uint32_t side;
    uint32_t line;  ///< mark of the coarsest line that ends here
    uint32_t cut;   ///< one of them, for the report
    bool open;      ///< no line goes on from here on the other side or along the seam
};

struct Join {
    uint32_t from, to;  ///< into ends
    double distance;
    bool otherLevel;
    std::vector<uint32_t> pieces;
};

class SeamJoiner {
  public:
    SeamJoiner(const MeshTopology& topology, const SplitSurface& surface,
               std::span<const UvTriangle> uv, std::span<const Cut> cuts, const LineTable& lines,
               const SeamOptions& options, ResolvedEdges& edges)
        : topology_(topology),
          surface_(surface),
          uv_(uv),
          cuts_(cuts),
          lines_(lines),
          options_(options),
          edges_(edges),
          wedges_(surface.triangles.size() * 3) {}

    SeamReport run() {
        if (cuts_.empty()) return {};
        findSeams();
        collectEnds();
        joinNearest();
        return report();
    }

  private:
    uint32_t startVertex(uint32_t h) const { return surface_.triangles[h / 3].v[h % 3]; }
    uint32_t endVertex(uint32_t h) const { return startVertex(nextCorner(h)); }
    bool isEdgePoint(uint32_t id) const { return id >= edges_.vertexCount; }

    bool isSeam(uint32_t h) const { return isSeam_[h] != 0; }

    /// Seams, and the wedges between them: corners around a vertex that are connected without
    /// crossing a seam. Only vertices with a seam have wedges worth knowing.
    void findSeams() {
        const auto halfEdges = static_cast<uint32_t>(topology_.opposite.size());
        std::vector<uint32_t> seams;
        isSeam_.assign(halfEdges, 0);
        seamsFrom_.assign(surface_.positions.size() + 1, 0);
        for (uint32_t h = 0; h < halfEdges; ++h) {
            const uint32_t o = topology_.opposite[h];
            if (o == kNone || o < h || !isUvSeam(topology_, uv_, h)) continue;
            isSeam_[h] = isSeam_[o] = 1;
            seams.push_back(h);
            ++seamsFrom_[startVertex(h) + 1];
            ++seamsFrom_[endVertex(h) + 1];
        }
        std::partial_sum(seamsFrom_.begin(), seamsFrom_.end(), seamsFrom_.begin());
        seamHalfEdges_.resize(seamsFrom_.back());
        std::vector<uint32_t> next(seamsFrom_.begin(), seamsFrom_.end() - 1);
        for (const uint32_t h : seams) {
            seamHalfEdges_[next[startVertex(h)]++] = h;
            seamHalfEdges_[next[endVertex(h)]++] = h;
        }
        for (uint32_t h = 0; h < halfEdges; ++h) {
            const uint32_t o = topology_.opposite[h];
            if (o == kNone || o < h) continue;
            const bool atStart = hasSeam(startVertex(h));
            const bool atEnd = hasSeam(endVertex(h));
            if ((!atStart && !atEnd) || isSeam(h)) continue;
            if (atStart) wedges_.unite(h, nextCorner(o));
            if (atEnd) wedges_.unite(nextCorner(h), o);
        }
    }

    bool hasSeam(uint32_t vertex) const { return seamsFrom_[vertex + 1] != seamsFrom_[vertex]; }
    /// Half edges of seams that touch a vertex.
    std::span<const uint32_t> seamsAt(uint32_t vertex) const {
        return std::span(seamHalfEdges_)
            .subspan(seamsFrom_[vertex], seamsFrom_[vertex + 1] - seamsFrom_[vertex]);
    }
    /// Ends of lines at a vertex or edge point.
    std::span<const SeamEnd> endsAt(uint32_t id) const {
        const auto [first, last] =
            std::equal_range(ends_.begin(), ends_.end(), SeamEnd{id, 0, 0, 0, false},
                             [](const SeamEnd& x, const SeamEnd& y) { return x.id < y.id; });
        return {first, last};
    }

    /// The wedge at vertex v beside half edge h, which touches v.
    uint32_t wedgeBeside(uint32_t h, uint32_t v) {
        return wedges_.find(startVertex(h) == v ? h : nextCorner(h));
    }

    void collectEnds() {
        for (uint32_t c = 0; c < cuts_.size(); ++c) {
            if (edgeAlong(cuts_[c]) != 3) continue;
            for (uint32_t end = 0; end < 2; ++end) {
                const CutEnd& e = end == 0 ? cuts_[c].from : cuts_[c].to;
                const uint32_t h = 3 * cuts_[c].triangle + e.k;
                const uint32_t id = edges_.cutEnds[c][end];
                if (e.where == CutEnd::Where::inside) continue;
                const bool atVertex = e.where == CutEnd::Where::corner;
                if (atVertex ? !hasSeam(id) : !isSeam(h)) continue;
                ends_.push_back({id, atVertex ? wedges_.find(h) : h, cuts_[c].line, c, false});
            }
        }
        // Of those at one place the coarsest, then the first.
        std::sort(ends_.begin(), ends_.end(), [](const SeamEnd& x, const SeamEnd& y) {
            return std::tie(x.id, x.side, x.line, x.cut) < std::tie(y.id, y.side, y.line, y.cut);
        });
        ends_.erase(std::unique(ends_.begin(), ends_.end(),
                                [](const SeamEnd& x, const SeamEnd& y) {
                                    return x.id == y.id && x.side == y.side;
                                }),
                    ends_.end());
        for (SeamEnd& end : ends_) {
            const std::span<const SeamEnd> there = endsAt(end.id);
            if (isEdgePoint(end.id)) {
                // Open unless a line ends at the very same point on the glued side, or runs along.
                const uint32_t o = topology_.opposite[end.side];
                const bool continued = std::any_of(there.begin(), there.end(),
                                                   [&](const SeamEnd& e) { return e.side == o; });
                end.open = !continued && !pieceMarkedAt(end.id);
            } else {
                end.open = there.size() == 1 && !pieceMarkedAt(end.id);
            }
        }
    }

    bool pieceMarkedAt(uint32_t id) const {
        if (isEdgePoint(id)) {
            const uint32_t p = id - edges_.vertexCount;
            const uint32_t edge = edges_.points[p].edge;
            return edges_.pieceLine[p + edge] != 0 || edges_.pieceLine[p + edge + 1] != 0;
        }
        for (const uint32_t h : seamsAt(id)) {
            const uint32_t edge = topology_.halfEdgeEdge[h];
            const bool atLow = topology_.edges[edge].low == id;
            const uint32_t piece = edges_.firstPiece(edge) + (atLow ? 0 : edges_.pointCount(edge));
            if (edges_.pieceLine[piece] != 0) return true;
        }
        return false;
    }

    glm::dvec3 position(uint32_t id) const {
        if (!isEdgePoint(id)) return surface_.positions[id];
        const EdgePoint& p = edges_.points[id - edges_.vertexCount];
        const glm::dvec3 low = surface_.positions[topology_.edges[p.edge].low];
        const glm::dvec3 high = surface_.positions[topology_.edges[p.edge].high];
        return low + (high - low) * p.t.approximate();
    }

    /// Walks along a seam edge from place `index` (0: low, n + 1: high) in direction `step`,
    /// collecting ends of lines on the other side. `own`: the half edge on the side the walk
    /// started from, kNone behind a junction where that side has ended.
    struct Walk {
        uint32_t from;
        double distance;
        std::vector<uint32_t> pieces;
        std::vector<uint32_t> edges;  ///< walked, so that no loop is followed
    };
    void walkEdge(uint32_t halfEdge, uint32_t own, int64_t index, int64_t step, Walk walk) {
        const uint32_t edge = topology_.halfEdgeEdge[halfEdge];
        if (std::find(walk.edges.begin(), walk.edges.end(), edge) != walk.edges.end()) return;
        walk.edges.push_back(edge);
        const int64_t count = edges_.pointCount(edge);
        glm::dvec3 here = position(idAt(edge, index));
        while (index + step >= 0 && index + step <= count + 1) {
            walk.pieces.push_back(edges_.firstPiece(edge) +
                                  static_cast<uint32_t>(step > 0 ? index : index - 1));
            index += step;
            const uint32_t id = idAt(edge, index);
            const glm::dvec3 there = position(id);
            walk.distance += glm::distance(here, there);
            here = there;
            if (walk.distance > options_.joinDistance) return;
            if (index > 0 && index <= count) offer(id, own, walk);
        }
        const uint32_t vertex = idAt(edge, index);
        const uint32_t ownWedge = own == kNone ? kNone : wedgeBeside(own, vertex);
        offer(vertex, ownWedge, walk);
        walkFromVertex(vertex, ownWedge, walk);
    }

    void walkFromVertex(uint32_t vertex, uint32_t ownWedge, const Walk& walk) {
        if (walk.edges.size() > 8) return;  // tiny seam edges around a needle: far enough
        for (const uint32_t h : seamsAt(vertex)) {
            const uint32_t edge = topology_.halfEdgeEdge[h];
            uint32_t own = kNone;
            for (const uint32_t side : {h, topology_.opposite[h]}) {
                if (ownWedge != kNone && wedgeBeside(side, vertex) == ownWedge) own = side;
            }
            const bool atLow = topology_.edges[edge].low == vertex;
            walkEdge(h, own, atLow ? 0 : int64_t{edges_.pointCount(edge)} + 1, atLow ? 1 : -1,
                     walk);
        }
    }

    uint32_t idAt(uint32_t edge, int64_t index) const {
        if (index == 0) return topology_.edges[edge].low;
        if (index == int64_t{edges_.pointCount(edge)} + 1) return topology_.edges[edge].high;
        return edges_.vertexCount + edges_.firstPoint[edge] + static_cast<uint32_t>(index) - 1;
    }

    void offer(uint32_t id, uint32_t ownSide, const Walk& walk) {
        for (const SeamEnd& end : endsAt(id)) {
            if (end.side == ownSide) continue;
            const bool otherLevel = lines_.level(end.line) != lines_.level(ends_[walk.from].line);
            const auto to = static_cast<uint32_t>(&end - ends_.data());
            joins_.push_back({walk.from, to, walk.distance, otherLevel, walk.pieces});
        }
    }

    void collectJoins() {
        for (uint32_t e = 0; e < ends_.size(); ++e) {
            const SeamEnd& end = ends_[e];
            if (!end.open) continue;
            const Walk walk{e, 0, {}, {}};
            if (!isEdgePoint(end.id)) {
                walkFromVertex(end.id, end.side, walk);
                continue;
            }
            const uint32_t p = end.id - edges_.vertexCount;
            const int64_t index = int64_t{p} - edges_.firstPoint[edges_.points[p].edge] + 1;
            walkEdge(end.side, end.side, index, 1, walk);
            walkEdge(end.side, end.side, index, -1, walk);
        }
        std::stable_sort(joins_.begin(), joins_.end(), [](const Join& a, const Join& b) {
            return std::tie(a.otherLevel, a.distance, a.from, a.to) <
                   std::tie(b.otherLevel, b.distance, b.from, b.to);
        });
    }

    /// First pairs of open ends, nearest first; then what is left open joins the nearest line end.
    void joinNearest() {
        collectJoins();
        std::vector<uint8_t> done(ends_.size(), 0);
        for (const bool toOpenOnly : {true, false}) {
            for (const Join& join : joins_) {
                if (done[join.from] != 0) continue;
                if (toOpenOnly && (done[join.to] != 0 || !ends_[join.to].open)) continue;
                const uint32_t line = std::max(ends_[join.from].line, ends_[join.to].line);
                for (const uint32_t piece : join.pieces) edges_.markPiece(piece, line);
                done[join.from] = 1;
                if (ends_[join.to].open) done[join.to] = 1;
                ++report_.joined;
            }
        }
        for (uint32_t e = 0; e < ends_.size(); ++e) {
            if (ends_[e].open && done[e] == 0) loose_.push_back(e);
        }
    }

    SeamReport report() {
        for (const uint32_t e : loose_) {
            const Cut& cut = cuts_[ends_[e].cut];
            const CutEnd& end = edges_.cutEnds[ends_[e].cut][0] == ends_[e].id ? cut.from : cut.to;
            const auto& corner = uv_[cut.triangle].corner;
            const GridPoint a = corner[end.k];
            const GridPoint b = corner[(end.k + 1) % 3];
            const double t = end.where == CutEnd::Where::edge ? end.t.approximate() : 0.0;
            const glm::dvec2 uv(a.u + (double{1} * b.u - a.u) * t,
                                a.v + (double{1} * b.v - a.v) * t);
            report_.loose.push_back({position(ends_[e].id), uv / double{kGridOne}});
        }
        return std::move(report_);
    }

    const MeshTopology& topology_;
    const SplitSurface& surface_;
    std::span<const UvTriangle> uv_;
    std::span<const Cut> cuts_;
    const LineTable& lines_;
    const SeamOptions& options_;
    ResolvedEdges& edges_;
    UnionFind wedges_;
    std::vector<uint8_t> isSeam_;          ///< per half edge
    std::vector<uint32_t> seamsFrom_;      ///< per vertex, and one more: into seamHalfEdges_
    std::vector<uint32_t> seamHalfEdges_;  ///< those that touch each vertex
    std::vector<SeamEnd> ends_;            ///< sorted by id, then side
    std::vector<Join> joins_;
    std::vector<uint32_t> loose_;
    SeamReport report_;
};

}  // namespace

SeamReport joinAcrossSeams(const MeshTopology& topology, const SplitSurface& surface,
                           std::span<const UvTriangle> uv, std::span<const Cut> cuts,
                           const LineTable& lines, const SeamOptions& options,
                           ResolvedEdges& edges) {
    return SeamJoiner(topology, surface, uv, cuts, lines, options, edges).run();
}

}  // namespace sherd
