// SPDX-License-Identifier: MIT
#include "surface/triangulation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "geometry/constrained_triangulation.h"

namespace sherd {
namespace {

/// p + t (q - p), seen from `origin`.
ExactPoint pointAlong(GridPoint p, GridPoint q, LineParameter t, GridPoint origin) {
    ExactPoint r;
    r.x = Int128{t.den} * (int64_t{p.u} - origin.u) + Int128{t.num} * (int64_t{q.u} - p.u);
    r.y = Int128{t.den} * (int64_t{p.v} - origin.v) + Int128{t.num} * (int64_t{q.v} - p.v);
    r.w = t.den;
    r.setApproximation();
    return r;
}

/// A weighted sum of vertices as one of mesh vertices. All lie in one triangle of the mesh, so
/// there are at most three; what lies on a mesh edge has no weight on the third.
VertexOrigin mixOrigins(const std::array<VertexOrigin, 3>& origins, const glm::dvec3& weights) {
    std::array<uint32_t, 3> vertices{kNone, kNone, kNone};
    glm::dvec3 sum(0.0);
    int count = 0;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double weight = weights[i] * origins[static_cast<size_t>(i)].weights[k];
            if (weight == 0) continue;
            const uint32_t vertex =
                origins[static_cast<size_t>(i)].vertices[static_cast<size_t>(k)];
            const auto known = std::find(vertices.begin(), vertices.begin() + count, vertex);
            const auto at = known - vertices.begin();
            if (at == count) vertices[static_cast<size_t>(count++)] = vertex;
            sum[static_cast<int>(at)] += weight;
        }
    }
    for (int k = count; k < 3; ++k)
        vertices[static_cast<size_t>(k)] = vertices[static_cast<size_t>(std::max(count, 1) - 1)];
    return {vertices, sum / (sum.x + sum.y + sum.z)};
}

/// Cuts one triangle after the other. The exact frame is the UV grid where the triangle has area
/// there, else a unit triangle: then all points are on its border and only their order matters.
class TriangleSplitter {
  public:
    TriangleSplitter(const SplitInput& input, SplitSurface& out)
        : in_(input), out_(out), localOfNode_(input.map.nodes.size(), kNone) {}

    bool split(uint32_t triangle, std::span<const Cut> cuts, uint32_t firstCut) {
        begin(triangle);
        for (uint8_t k = 0; k < 3; ++k)
            addPoint(in_.surface.triangles[triangle_].v[k],
                     pointAlong(corner_[k], corner_[k], {0, 1}, corner_[0]), cornerWeights(k),
                     cornerLines(k));
        for (uint8_t k = 0; k < 3; ++k) addEdgePoints(k);
        for (uint32_t i = 0; i < cuts.size(); ++i) addCut(cuts[i], firstCut + i);
        for (const uint32_t node : nodes_) localOfNode_[node] = kNone;
        const TriangulationResult& result = triangulation_.run(local_);
        if (!result.valid) return false;
        for (const auto& t : result.triangles) emit(t);
        return true;
    }

  private:
    void begin(uint32_t triangle) {
        triangle_ = triangle;
        const UvTriangle& uv = in_.uv[triangle];
        mirrored_ = uv.kind == UvKind::mirrored;
        corner_ = {GridPoint{0, 0}, GridPoint{1, 0}, GridPoint{0, 1}};
        if (mirrored_ || uv.kind == UvKind::regular) {
            corner_ = uv.corner;
            if (mirrored_) {
                for (GridPoint& p : corner_) p.u = -p.u;
            }
        }
        local_.points.clear();
        local_.shape.clear();
        local_.constraints.clear();
        global_.clear();
        nodes_.clear();
        layOutShape();
    }

    /// The triangle in its own plane: what "well shaped" means for the pieces.
    void layOutShape() {
        const auto& v = in_.surface.triangles[triangle_].v;
        const glm::dvec3 a = in_.surface.positions[v[0]];
        const glm::dvec3 ab = glm::dvec3(in_.surface.positions[v[1]]) - a;
        const glm::dvec3 ac = glm::dvec3(in_.surface.positions[v[2]]) - a;
        const double length = glm::length(ab);
        const double height = length > 0 ? glm::length(glm::cross(ab, ac)) / length : 0;
        if (height > 0) {
            shape_ = {glm::dvec2(0, 0), glm::dvec2(length, 0),
                      glm::dvec2(glm::dot(ab, ac) / length, height)};
        } else {
            shape_ = {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)};
        }
    }

    static glm::dvec3 cornerWeights(uint8_t k) {
        glm::dvec3 w(0.0);
        w[k] = 1;
        return w;
    }
    static uint32_t edgeLine(uint8_t k) { return 1U << k; }
    static uint32_t cornerLines(uint8_t k) {
        return edgeLine(k) | edgeLine(static_cast<uint8_t>((k + 2) % 3));
    }

    uint32_t addPoint(uint32_t global, ExactPoint exact, const glm::dvec3& weights,
                      uint32_t lines) {
        exact.lines = lines;
        local_.points.push_back(exact);
        local_.shape.push_back(shape_[0] * weights[0] + shape_[1] * weights[1] +
                               shape_[2] * weights[2]);
        global_.push_back(global);
        return static_cast<uint32_t>(global_.size()) - 1;
    }

    /// The points of half edge k in order from corner k to corner k + 1, and its marked pieces.
    void addEdgePoints(uint8_t k) {
        const uint32_t edge = in_.topology.halfEdgeEdge[3 * triangle_ + k];
        const uint32_t count = in_.edges.pointCount(edge);
        const auto next = static_cast<uint8_t>((k + 1) % 3);
        const bool forward = in_.topology.edges[edge].low == in_.surface.triangles[triangle_].v[k];
        firstOnEdge_[k] = static_cast<uint32_t>(global_.size());
        uint32_t previous = k;
        for (uint32_t i = 0; i <= count; ++i) {
            uint32_t here = next;
            if (i < count) {
                const uint32_t p = in_.edges.firstPoint[edge] + (forward ? i : count - 1 - i);
                LineParameter t = in_.edges.points[p].t;
                if (!forward) t.num = t.den - t.num;
                glm::dvec3 weights(0.0);
                weights[next] = t.approximate();
                weights[k] = 1 - weights[next];
                here = addPoint(in_.edges.vertexCount + p,
                                pointAlong(corner_[k], corner_[next], t, corner_[0]), weights,
                                edgeLine(k));
            }
            const uint32_t piece = in_.edges.firstPiece(edge) + (forward ? i : count - i);
            if (const uint32_t line = in_.edges.pieceLine[piece]; line != 0) {
                local_.constraints.push_back({previous, here, line});
            }
            previous = here;
        }
    }

    void addCut(const Cut& cut, uint32_t index) {
        if (edgeAlong(cut) != 3) return;  // a marked piece already
        std::array<uint32_t, 2> ends{};
        for (uint32_t end = 0; end < 2; ++end) {
            const CutEnd& e = end == 0 ? cut.from : cut.to;
            switch (e.where) {
                case CutEnd::Where::corner:
                    ends[end] = e.k;
                    break;
                case CutEnd::Where::edge:
                    ends[end] = edgePoint(e.k, in_.edges.cutEnds[index][end]);
                    break;
                case CutEnd::Where::inside:
                    ends[end] = innerPoint(e.node);
                    break;
            }
        }
        local_.constraints.push_back({ends[0], ends[1], cut.line});
    }

    /// The local point of an edge point on half edge k.
    uint32_t edgePoint(uint8_t k, uint32_t id) const {
        const uint32_t edge = in_.topology.halfEdgeEdge[3 * triangle_ + k];
        const uint32_t place = id - in_.edges.vertexCount - in_.edges.firstPoint[edge];
        const bool forward = in_.topology.edges[edge].low == in_.surface.triangles[triangle_].v[k];
        return firstOnEdge_[k] + (forward ? place : in_.edges.pointCount(edge) - 1 - place);
    }

    uint32_t innerPoint(uint32_t node) {
        if (localOfNode_[node] != kNone) return localOfNode_[node];
        const MapNode& n = in_.map.nodes[node];
        ExactPoint exact;
        if (n.first < 0) {
            exact = pointAlong(view(n.point), view(n.point), {0, 1}, corner_[0]);
        } else {
            const Support& s = in_.map.supports[n.first];
            const Support& o = in_.map.supports[n.second];
            const LineParameter t = *crossingParameter(view(s.a), view(s.b), view(o.a), view(o.b));
            exact = pointAlong(view(s.a), view(s.b), t, corner_[0]);
        }
        const glm::dvec3 weights = barycentric(exact);
        const auto& v = in_.surface.triangles[triangle_].v;
        const auto global = static_cast<uint32_t>(out_.positions.size());
        out_.positions.emplace_back(pointOn(in_.surface, triangle_, weights));
        out_.origins.push_back(mixOrigins(
            {in_.surface.origins[v[0]], in_.surface.origins[v[1]], in_.surface.origins[v[2]]},
            weights));
        const uint32_t local = addPoint(global, exact, weights, 0);
        localOfNode_[node] = local;
        nodes_.push_back(node);
        return local;
    }

    GridPoint view(GridPoint p) const { return mirrored_ ? GridPoint{-p.u, p.v} : p; }

    /// Rounded, never negative; decides no topology.
    glm::dvec3 barycentric(const ExactPoint& p) const {
        const ExactPoint& b = local_.points[1];
        const ExactPoint& c = local_.points[2];
        const double area = b.ax * c.ay - b.ay * c.ax;
        double wb = std::clamp((p.ax * c.ay - p.ay * c.ax) / area, 0.0, 1.0);
        double wc = std::clamp((b.ax * p.ay - b.ay * p.ax) / area, 0.0, 1.0);
        if (wb + wc > 1) {
            const double sum = wb + wc;
            wb /= sum;
            wc /= sum;
        }
        return {std::max(0.0, 1 - wb - wc), wb, wc};
    }

    void emit(const TriangulationResult::Triangle& t) {
        out_.triangles.push_back({{global_[t.v[0]], global_[t.v[1]], global_[t.v[2]]},
                                  in_.surface.triangles[triangle_].source,
                                  t.mark});
    }

    const SplitInput& in_;
    SplitSurface& out_;
    uint32_t triangle_ = 0;
    bool mirrored_ = false;
    std::array<GridPoint, 3> corner_{};
    std::array<glm::dvec2, 3> shape_{};
    TriangulationInput local_;
    ConstrainedTriangulation triangulation_;
    std::vector<uint32_t> global_;           ///< split vertex of each local point
    std::array<uint32_t, 3> firstOnEdge_{};  ///< local point, per half edge
    std::vector<uint32_t> nodes_;            ///< map nodes inside the triangle
    std::vector<uint32_t> localOfNode_;      ///< of all map nodes: local point, or kNone
};

void addVerticesAndEdgePoints(const SplitInput& input, SplitSurface& out) {
    const SplitSurface& before = input.surface;
    out.meshVertices = before.meshVertices;
    const size_t inner = std::min(input.map.nodes.size(), 2 * input.cuts.size());
    out.positions.reserve(before.positions.size() + input.edges.points.size() + inner);
    out.origins.reserve(before.positions.size() + input.edges.points.size() + inner);
    out.positions.assign(before.positions.begin(), before.positions.end());
    out.origins.assign(before.origins.begin(), before.origins.end());
    for (const EdgePoint& p : input.edges.points) {
        const auto [low, high] = input.topology.edges[p.edge];
        const double t = p.t.approximate();
        const glm::dvec3 a = before.positions[low];
        const glm::dvec3 b = before.positions[high];
        out.positions.emplace_back(a * (1 - t) + b * t);
        out.origins.push_back(
            mixOrigins({before.origins[low], before.origins[high], {}}, {1 - t, t, 0}));
    }
}

}  // namespace

Result<SplitSurface> splitSurface(const SplitInput& input, std::vector<uint32_t>* from) {
    const std::vector<SplitTriangle>& triangles = input.surface.triangles;
    SplitSurface out;
    addVerticesAndEdgePoints(input, out);
    out.triangles.reserve(triangles.size() + 4 * input.cuts.size());
    TriangleSplitter splitter(input, out);
    uint32_t cut = 0;
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        const uint32_t firstCut = cut;
        while (cut < input.cuts.size() && input.cuts[cut].triangle == t) ++cut;
        if (input.topology.degenerate[t] != 0) continue;
        bool untouched = firstCut == cut;
        std::array<uint32_t, 3> line{};
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t edge = input.topology.halfEdgeEdge[3 * t + k];
            untouched = untouched && input.edges.pointCount(edge) == 0;
            line[k] = input.edges.pieceLine[input.edges.firstPiece(edge)];
        }
        if (untouched) {
            out.triangles.push_back({triangles[t].v, triangles[t].source, line});
        } else if (!splitter.split(t, input.cuts.subspan(firstCut, cut - firstCut), firstCut)) {
            return fail(
                ErrorCode::internal,
                "cuts cross inside a triangle; this is a mistake in Sherd, please report it",
                "triangle " + std::to_string(triangles[t].source));
        }
        if (from != nullptr) from->resize(out.triangles.size(), t);
    }
    return out;
}

}  // namespace sherd
