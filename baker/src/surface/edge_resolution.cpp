// SPDX-License-Identifier: MIT
#include "surface/edge_resolution.h"

#include <algorithm>
#include <compare>

namespace sherd {
namespace {

struct RawPoint {
    uint32_t edge;
    LineParameter t;
    uint32_t cut;
    uint32_t end;  ///< 0: from, 1: to
};

/// The end's parameter from the edge's low to its high vertex.
LineParameter fromLow(const MeshTopology& topology, std::span<const SplitTriangle> triangles,
                      uint32_t halfEdge, LineParameter t) {
    const bool forward = topology.edges[topology.halfEdgeEdge[halfEdge]].low ==
                         triangles[halfEdge / 3].v[halfEdge % 3];
    return forward ? t : LineParameter{t.den - t.num, t.den};
}

std::vector<RawPoint> collectPoints(const MeshTopology& topology,
                                    std::span<const SplitTriangle> triangles,
                                    std::span<const Cut> cuts) {
    std::vector<RawPoint> raw;
    for (uint32_t c = 0; c < cuts.size(); ++c) {
        for (uint32_t end = 0; end < 2; ++end) {
            const CutEnd& e = end == 0 ? cuts[c].from : cuts[c].to;
            if (e.where != CutEnd::Where::edge) continue;
            const uint32_t h = 3 * cuts[c].triangle + e.k;
            raw.push_back({topology.halfEdgeEdge[h], fromLow(topology, triangles, h, e.t), c, end});
        }
    }
    std::sort(raw.begin(), raw.end(), [](const RawPoint& a, const RawPoint& b) {
        if (a.edge != b.edge) return a.edge < b.edge;
        if (a.t != b.t) return std::is_lt(a.t <=> b.t);
        return a.cut != b.cut ? a.cut < b.cut : a.end < b.end;
    });
    return raw;
}

/// Index among an edge's places (0: low vertex, 1..n: points, n + 1: high vertex) of an end of a
/// cut.
uint32_t placeOf(const ResolvedEdges& edges, const MeshTopology& topology, uint32_t edge,
                 uint32_t id) {
    if (id == topology.edges[edge].low) return 0;
    if (id == topology.edges[edge].high) return edges.pointCount(edge) + 1;
    return id - edges.vertexCount - edges.firstPoint[edge] + 1;
}

void keepLines(const MeshTopology& topology, std::span<const SplitTriangle> triangles,
               ResolvedEdges& edges) {
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t line = triangles[t].line[k];
            if (line == 0) continue;
            const uint32_t edge = topology.halfEdgeEdge[3 * t + k];
            for (uint32_t p = 0; p <= edges.pointCount(edge); ++p)
                edges.markPiece(edges.firstPiece(edge) + p, line);
        }
    }
}

}  // namespace

uint8_t edgeAlong(const Cut& cut) {
    using Where = CutEnd::Where;
    const CutEnd& a = cut.from;
    const CutEnd& b = cut.to;
    if (a.where == Where::inside || b.where == Where::inside) return 3;
    if (a.where == Where::corner && b.where == Where::corner) {
        return (a.k + 1) % 3 == b.k ? a.k : b.k;
    }
    const uint8_t k = a.where == Where::edge ? a.k : b.k;
    const auto onEdge = [k](const CutEnd& e) {
        return e.k == k || (e.where == Where::corner && e.k == (k + 1) % 3);
    };
    return onEdge(a) && onEdge(b) ? k : 3;
}

ResolvedEdges resolveEdges(const MeshTopology& topology, const SplitSurface& surface,
                           std::span<const Cut> cuts) {
    const std::span<const SplitTriangle> triangles = surface.triangles;
    const auto vertexCount = static_cast<uint32_t>(surface.positions.size());
    ResolvedEdges edges;
    edges.vertexCount = vertexCount;
    edges.cutEnds.assign(cuts.size(), {kNone, kNone});
    edges.firstPoint.assign(topology.edges.size() + 1, 0);
    for (const RawPoint& raw : collectPoints(topology, triangles, cuts)) {
        const bool known = !edges.points.empty() && edges.points.back().edge == raw.edge &&
                           edges.points.back().t == raw.t;
        if (!known) {
            edges.points.push_back({raw.edge, raw.t});
            ++edges.firstPoint[raw.edge + 1];
        }
        edges.cutEnds[raw.cut][raw.end] =
            vertexCount + static_cast<uint32_t>(edges.points.size()) - 1;
    }
    for (size_t e = 0; e < topology.edges.size(); ++e)
        edges.firstPoint[e + 1] += edges.firstPoint[e];
    edges.pieceLine.assign(edges.points.size() + topology.edges.size(), 0);
    keepLines(topology, triangles, edges);

    for (uint32_t c = 0; c < cuts.size(); ++c) {
        const Cut& cut = cuts[c];
        const auto& corners = triangles[cut.triangle].v;
        if (cut.from.where == CutEnd::Where::corner) edges.cutEnds[c][0] = corners[cut.from.k];
        if (cut.to.where == CutEnd::Where::corner) edges.cutEnds[c][1] = corners[cut.to.k];
        const uint8_t k = edgeAlong(cut);
        if (k == 3) continue;
        const uint32_t edge = topology.halfEdgeEdge[3 * cut.triangle + k];
        uint32_t first = placeOf(edges, topology, edge, edges.cutEnds[c][0]);
        uint32_t last = placeOf(edges, topology, edge, edges.cutEnds[c][1]);
        if (first > last) std::swap(first, last);
        for (uint32_t p = first; p < last; ++p)
            edges.markPiece(edges.firstPiece(edge) + p, cut.line);
    }
    return edges;
}

}  // namespace sherd
