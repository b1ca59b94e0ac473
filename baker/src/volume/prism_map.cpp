// SPDX-License-Identifier: MIT
#include "volume/prism_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/compact_labels.h"
#include "geometry/constrained_triangulation.h"
#include "geometry/union_find.h"

namespace sherd {
namespace {

using Integer = PrismMap::Integer;

int signOf(const Integer& x) {
    return x.sign();
}

/// Coefficients of the line through two nodes, positive left of a -> b.
std::array<Integer, 3> through(const PrismMap::Node& a, const PrismMap::Node& b) {
    const Integer ax = Integer(a.x), ay = Integer(a.y), aw = Integer(a.w);
    const Integer bx = Integer(b.x), by = Integer(b.y), bw = Integer(b.w);
    return {ay * bw - aw * by, aw * bx - ax * bw, ax * by - ay * bx};
}

/// The same through the grid points that an edge of the drawing lies on: smaller numbers.
std::array<Integer, 3> through(const PlanePoint& a, const PlanePoint& b) {
    const int64_t x = a.y - b.y, y = b.x - a.x;
    return {Integer(x), Integer(y), Integer(-(Int128{x} * a.x + Int128{y} * a.y))};
}

PlanePoint planePoint(const GridPoint& p) {
    return {PrismMap::kStep * p.u - PrismMap::kMiddle, PrismMap::kStep * p.v - PrismMap::kMiddle};
}

PrismMap::Node nodeOf(const PlanarMap& map, const MapNode& node) {
    PrismMap::Node result;
    if (node.first < 0) {
        const PlanePoint p = planePoint(node.point);
        result.x = p.x;
        result.y = p.y;
    } else {
        const Support& s = map.supports[static_cast<size_t>(node.first)];
        const Support& t = map.supports[static_cast<size_t>(node.second)];
        const PlanePoint a = planePoint(s.a), b = planePoint(s.b);
        const PlanePoint c = planePoint(t.a), d = planePoint(t.b);
        const int64_t ux = b.x - a.x, uy = b.y - a.y, vx = d.x - c.x, vy = d.y - c.y;
        Int128 w = Int128{ux} * vy - Int128{uy} * vx;
        Int128 along = Int128{c.x - a.x} * vy - Int128{c.y - a.y} * vx;
        if (w < 0) {
            w = -w;
            along = -along;
        }
        result = {w * a.x + along * ux, w * a.y + along * uy, w, {}};
    }
    const auto w = static_cast<double>(result.w);
    result.place = {static_cast<double>(result.x) / w, static_cast<double>(result.y) / w};
    return result;
}

/// Whether nodes turn left, exactly.
int turnOf(const PrismMap::Node& a, const PrismMap::Node& b, const PrismMap::Node& c) {
    const glm::dvec2 ab = b.place - a.place, ac = c.place - a.place;
    const double left = ab.x * ac.y, right = ab.y * ac.x;
    // Places are below 2^32, so off by 2^-20 at most.
    const double bound =
        0x1p-18 * (std::abs(ab.x) + std::abs(ab.y) + std::abs(ac.x) + std::abs(ac.y)) + 0x1p-30 +
        0x1p-50 * (std::abs(left) + std::abs(right));
    if (left - right > bound) return 1;
    if (left - right < -bound) return -1;
    const std::array<Integer, 3> line = through(a, b);
    return signOf(line[0] * Integer(c.x) + line[1] * Integer(c.y) + line[2] * Integer(c.w));
}

}  // namespace

int PrismMap::sideOf(const PlanePoint& p, const Side& side) const {
    const glm::dvec2 a = nodes_[side.from].place, b = nodes_[side.to].place;
    const glm::dvec2 at(static_cast<double>(p.x), static_cast<double>(p.y));
    const glm::dvec2 ab = b - a, ap = at - a;
    const double left = ab.x * ap.y, right = ab.y * ap.x;
    const double bound =
        0x1p-18 * (std::abs(ab.x) + std::abs(ab.y) + std::abs(ap.x) + std::abs(ap.y)) + 0x1p-30 +
        0x1p-50 * (std::abs(left) + std::abs(right));
    if (left - right > bound) return 1;
    if (left - right < -bound) return -1;
    const Line& line = lines_[side.line];
    const int along = line.from == side.from ? 1 : -1;
    // The drawing moved by (e^2, e) is the point moved the other way.
    for (const Integer& value : {valueAt(p, side.line), Integer(-line.of[1]), Integer(-line.of[0])})
        if (const int sign = signOf(value); sign != 0) return along * sign;
    return 0;
}

PrismMap::Integer PrismMap::valueAt(const PlanePoint& p, uint32_t line) const {
    const std::array<Integer, 3>& of = lines_[line].of;
    return of[0] * p.x + of[1] * p.y + of[2];
}

int PrismMap::sideOf(uint32_t n, const PlanePoint& u, const PlanePoint& v) const {
    // Below 2^27, 2^27 and 2^53; with the node's it is 2^120.
    const int64_t x = u.y - v.y, y = v.x - u.x;
    const int64_t c = -(x * u.x + y * u.y);
    const Node& node = nodes_[n];
    const Int128 value = node.x * x + node.y * y + node.w * c;
    if (value != 0) return value > 0 ? 1 : -1;
    return y != 0 ? sherd::signOf(y) : sherd::signOf(x);
}

/// Triangles between the lines of the drawing, put together to convex cells by leaving out edges
/// that are none of its walls (Hertel and Mehlhorn 1983, Fast triangulation of simple polygons).
class PrismMapBuilder {
  public:
    explicit PrismMapBuilder(const PlanarMap& map) : map_(map) {}

    Result<PrismMap> run() {
        addNodes();
        if (!triangulate()) {
            return fail(ErrorCode::internal,
                        "the drawing's lines could not be triangulated; please report it");
        }
        findFaces();
        linkSides();
        for (uint32_t h = 0; h < 3 * triangles_.size(); ++h) {
            const uint32_t o = opposite_[h];
            if (o != kNone && h < o && !isWall(h)) leaveOut(h);
        }
        storeCells();
        return std::move(result_);
    }

    /// Per edge of the drawing, after `run`: whether it has the same face on both sides.
    const std::vector<uint8_t>& idle() const { return idle_; }

  private:
    static constexpr uint32_t kNone = PrismMap::kNone;

    /// A triangle around everything first.
    void addNodes() {
        constexpr int64_t kFar = int64_t{1} << 30;  // the map ends at 2^29 and a bit
        for (const PlanePoint& p : {PlanePoint{-kFar, -kFar}, {3 * kFar, -kFar}, {-kFar, 3 * kFar}})
            result_.nodes_.push_back(
                {p.x, p.y, 1, {static_cast<double>(p.x), static_cast<double>(p.y)}});
        for (const MapNode& node : map_.nodes) result_.nodes_.push_back(nodeOf(map_, node));
    }

    bool triangulate() {
        TriangulationInput input;
        for (const PrismMap::Node& node : result_.nodes_) {
            ExactPoint point;
            point.ax = node.place.x;
            point.ay = node.place.y;
            input.points.push_back(point);
            input.shape.push_back(node.place);
        }
        input.turn = [this](uint32_t a, uint32_t b, uint32_t c) {
            return turnOf(result_.nodes_[a], result_.nodes_[b], result_.nodes_[c]);
        };
        for (uint32_t e = 0; e < map_.edges.size(); ++e)
            input.constraints.push_back({3 + map_.edges[e].from, 3 + map_.edges[e].to, e + 1});
        TriangulationResult done = sherd::triangulate(input);
        triangles_ = std::move(done.triangles);
        return done.valid && done.same.empty() && done.passages.empty();
    }

    uint32_t markOf(uint32_t h) const { return triangles_[h / 3].mark[h % 3]; }
    uint32_t fromOf(uint32_t h) const { return triangles_[h / 3].v[h % 3]; }
    uint32_t toOf(uint32_t h) const { return triangles_[h / 3].v[(h % 3 + 1) % 3]; }
    bool isWall(uint32_t h) const {
        return markOf(h) != 0 && opposite_[h] != kNone &&
               faceOf_[h / 3] != faceOf_[opposite_[h] / 3];
    }

    /// Triangles that no line parts are of one face.
    void findFaces() {
        const auto count = static_cast<uint32_t>(triangles_.size());
        opposite_.assign(3 * size_t{count}, kNone);
        UnionFind faces(count);
        for (uint32_t h = 0; h < 3 * count; ++h) {
            const uint32_t n = triangles_[h / 3].neighbor[h % 3];
            if (n == TriangulationResult::kNone) continue;
            for (uint32_t k = 0; k < 3; ++k)
                if (fromOf(3 * n + k) == toOf(h)) opposite_[h] = 3 * n + k;
            if (markOf(h) == 0) faces.unite(h / 3, n);
        }
        std::vector<uint32_t> roots(count);
        for (uint32_t t = 0; t < count; ++t) roots[t] = faces.find(t);
        faceOf_ = compactLabels(roots, result_.faceCount_);
        idle_.assign(map_.edges.size(), 0);
        for (uint32_t h = 0; h < 3 * count; ++h) {
            if (markOf(h) == 0 || opposite_[h] == kNone || h > opposite_[h] || isWall(h)) continue;
            idle_[markOf(h) - 1] = 1;
            ++result_.idleEdges_;
        }
    }

    void linkSides() {
        for (uint32_t h = 0; h < opposite_.size(); ++h) {
            next_.push_back(h / 3 * 3 + (h % 3 + 1) % 3);
            previous_.push_back(h / 3 * 3 + (h % 3 + 2) % 3);
        }
        gone_.assign(opposite_.size(), 0);
    }

    bool staysConvex(uint32_t before, uint32_t after) const {
        if (fromOf(before) == toOf(after)) return false;  // back along the same edge
        return turnOf(result_.nodes_[fromOf(before)], result_.nodes_[fromOf(after)],
                      result_.nodes_[toOf(after)]) >= 0;
    }

    /// The edge, if the cell that it leaves is convex.
    void leaveOut(uint32_t h) {
        const uint32_t o = opposite_[h];
        if (!staysConvex(previous_[h], next_[o]) || !staysConvex(previous_[o], next_[h])) return;
        gone_[h] = gone_[o] = 1;
        const auto join = [this](uint32_t before, uint32_t after) {
            next_[before] = after;
            previous_[after] = before;
        };
        join(previous_[h], next_[o]);
        join(previous_[o], next_[h]);
    }

    void storeCells() {
        std::vector<uint32_t> cellOf(next_.size(), kNone), sideHalf, lineOf(next_.size(), kNone);
        for (uint32_t h = 0; h < next_.size(); ++h) {
            if (gone_[h] != 0 || cellOf[h] != kNone) continue;
            const auto cell = static_cast<uint32_t>(result_.faces_.size());
            for (uint32_t g = h; cellOf[g] == kNone; g = next_[g]) {
                cellOf[g] = cell;
                sideHalf.push_back(g);
                const uint32_t o = opposite_[g];
                if (o == kNone || lineOf[o] == kNone) addLine(g);
                lineOf[g] = o == kNone || lineOf[o] == kNone ? result_.lines() - 1 : lineOf[o];
            }
            result_.faces_.push_back(faceOf_[h / 3]);
            result_.start_.push_back(static_cast<uint32_t>(sideHalf.size()));
        }
        for (const uint32_t h : sideHalf) {
            const uint32_t o = opposite_[h];
            result_.sides_.push_back(
                {fromOf(h), toOf(h), o == kNone ? kNone : cellOf[o], lineOf[h]});
        }
    }

    void addLine(uint32_t h) {
        PrismMap::Line line;
        line.from = fromOf(h);
        line.to = toOf(h);
        line.wall = isWall(h);
        if (const uint32_t mark = markOf(h); mark != 0) {
            const MapEdge& edge = map_.edges[mark - 1];
            const Support& support = map_.supports[edge.support];
            const bool along = 3 + edge.from == line.from;
            line.of = through(planePoint(along ? support.a : support.b),
                              planePoint(along ? support.b : support.a));
        } else {
            line.of = through(result_.nodes_[line.from], result_.nodes_[line.to]);
        }
        result_.lines_.push_back(std::move(line));
    }

    const PlanarMap& map_;
    PrismMap result_;
    std::vector<TriangulationResult::Triangle> triangles_;
    std::vector<uint32_t> faceOf_;                      ///< per triangle
    std::vector<uint32_t> opposite_, next_, previous_;  ///< per half edge 3 t + k
    std::vector<uint8_t> gone_;
    std::vector<uint8_t> idle_;
};

namespace {

/// Without the edges that part nothing, and the nodes that only these have.
PlanarMap withoutIdle(const PlanarMap& map, const std::vector<uint8_t>& idle) {
    PlanarMap result;
    result.supports = map.supports;
    std::vector<uint32_t> number(map.nodes.size(), PrismMap::kNone);
    const auto rename = [&](uint32_t& node) {
        uint32_t& now = number[node];
        if (now == PrismMap::kNone) {
            now = static_cast<uint32_t>(result.nodes.size());
            result.nodes.push_back(map.nodes[node]);
        }
        node = now;
    };
    for (uint32_t e = 0; e < map.edges.size(); ++e) {
        if (idle[e] != 0) continue;
        result.edges.push_back(map.edges[e]);
        rename(result.edges.back().from);
        rename(result.edges.back().to);
    }
    return result;
}

}  // namespace

/// Cells around dangling lines would only cut the skin into more triangles.
Result<PrismMap> PrismMap::of(const PlanarMap& map) {
    PrismMapBuilder builder(map);
    Result<PrismMap> all = builder.run();
    if (!all || all->idleEdges_ == 0) return all;
    const PlanarMap walls = withoutIdle(map, builder.idle());
    Result<PrismMap> result = PrismMapBuilder(walls).run();
    if (result) result->idleEdges_ = all->idleEdges_;
    return result;
}

}  // namespace sherd
