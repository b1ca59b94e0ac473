// SPDX-License-Identifier: MIT
#include "support/cut_oracle.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

namespace sherd::test {

using namespace exact;

namespace {

using Box = CutOracle::Box;

constexpr uint32_t kUnused = 0xFFFFFFFFU;

uint32_t coarser(uint32_t a, uint32_t b) {
    return a == 0 ? b : (b == 0 ? a : std::min(a, b));
}

/// Barycentric coordinates of a UV place, rounded.
std::array<double, 3> weightsAt(const std::array<Grid, 3>& corner, double u, double v) {
    const auto cross = [](double ax, double ay, double bx, double by) { return ax * by - ay * bx; };
    const auto d = [&](size_t i, size_t j) {
        return std::pair(static_cast<double>(corner[j].x - corner[i].x),
                         static_cast<double>(corner[j].y - corner[i].y));
    };
    const auto [bx, by] = d(0, 1);
    const auto [cx, cy] = d(0, 2);
    const double px = u - static_cast<double>(corner[0].x);
    const double py = v - static_cast<double>(corner[0].y);
    const double whole = cross(bx, by, cx, cy);
    const double b = cross(px, py, cx, cy) / whole;
    const double c = cross(bx, by, px, py) / whole;
    return {1 - b - c, b, c};
}

Box boxOf(const Point& a, const Point& b, const Point& c) {
    const auto [lowU, highU] = std::minmax({a.u(), b.u(), c.u()});
    const auto [lowV, highV] = std::minmax({a.v(), b.v(), c.v()});
    return {lowU - 1, lowV - 1, highU + 1, highV + 1};
}

/// A convex polygon; side i runs from point i to the next.
struct Cell {
    struct Side {
        Point from;
        Line line;
        uint32_t halfEdge;  ///< of the mesh, or kUnused: inside the triangle
        uint32_t piece;
    };
    std::vector<Side> sides;
};

/// The parts of a cell on the two sides of a line; one of them may be empty.
std::array<Cell, 2> split(const Cell& cell, const Line& line) {
    std::array<Cell, 2> halves;
    const size_t n = cell.sides.size();
    std::vector<int> side;
    for (const Cell::Side& s : cell.sides) side.push_back(sign(line.at(s.from)));
    const bool left = std::any_of(side.begin(), side.end(), [](int s) { return s > 0; });
    const bool right = std::any_of(side.begin(), side.end(), [](int s) { return s < 0; });
    if (!left || !right) {
        halves[left ? 0 : 1] = cell;
        return halves;
    }
    for (size_t i = 0; i < n; ++i) {
        const Cell::Side& s = cell.sides[i];
        const int here = side[i];
        const int there = side[(i + 1) % n];
        for (const int h : {0, 1}) {
            Cell& half = halves[static_cast<size_t>(h)];
            const int own = h == 0 ? 1 : -1;
            if (here == own || (here == 0 && there == own)) half.sides.push_back(s);
            // Leaving: the line itself is the next side.
            if (here == own && there == -own)
                half.sides.push_back({crossing(line, s.line), line, kUnused, 0});
            if (here == 0 && there == -own) half.sides.push_back({s.from, line, kUnused, 0});
            // Coming back in the middle of a side.
            if (here == -own && there == own)
                half.sides.push_back({crossing(line, s.line), s.line, s.halfEdge, s.piece});
        }
    }
    return halves;
}

}  // namespace

CutOracle::CutOracle(const SurfaceMesh& mesh, const FractureMap& map) {
    snapMesh(mesh);
    snapMap(map);
    crossSegments();
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (triangles[t].kind == Kind::skipped) continue;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t h = 3 * t + static_cast<uint32_t>(k);
            auto& edge =
                edges.try_emplace(keyOf(t, k), Edge{{kUnused, kUnused}, {}, {}}).first->second;
            edge.uses[vertices_[t][k] < vertices_[t][(k + 1) % 3] ? 0 : 1] = h;
        }
        const Box box =
            boxOf(triangles[t].corner[0], triangles[t].corner[1], triangles[t].corner[2]);
        for (const Stretch& stretch : stretches_) {
            if (!box.meets(stretch.box)) continue;
            if (triangles[t].kind == Kind::area) clip(t, stretch);
            if (triangles[t].kind == Kind::line) conduct(t, stretch);
        }
    }
    sortEdges();
}

void CutOracle::snapMesh(const SurfaceMesh& mesh) {
    const auto uv = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                 [&](const Attribute& a) { return a.semantic == mesh.uvSemantic; });
    vertices_ = mesh.triangles;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        Triangle triangle;
        for (size_t k = 0; k < 3; ++k)
            triangle.corner[k] = snap(double{uv->values[2 * mesh.corners[t][k]]},
                                      double{uv->values[2 * mesh.corners[t][k] + 1]});
        const auto& [a, b, c] = triangle.corner;
        const auto& v = mesh.triangles[t];
        triangle.turn = sign(Line(a, b).at(Point(c)));
        triangle.kind = a == b && b == c ? Kind::point : Kind::line;
        if (triangle.turn != 0) triangle.kind = Kind::area;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) triangle.kind = Kind::skipped;
        triangles.push_back(triangle);
    }
}

void CutOracle::snapMap(const FractureMap& map) {
    std::set<uint32_t> used;
    for (const FractureMap::Line& line : map.lines) used.insert(line.level);
    levels = static_cast<uint32_t>(used.size());
    for (const FractureMap::Line& line : map.lines) {
        const auto level =
            static_cast<uint32_t>(std::distance(used.begin(), used.find(line.level))) + 1;
        for (size_t i = 1; i < line.points.size(); ++i) {
            const Grid a = snap(line.points[i - 1].x, line.points[i - 1].y);
            const Grid b = snap(line.points[i].x, line.points[i].y);
            if (!(a == b)) segments_.push_back({a, b, level, Line(a, b)});
        }
    }
}

void CutOracle::crossSegments() {
    for (uint32_t i = 0; i < segments_.size(); ++i) {
        const Segment& s = segments_[i];
        std::vector<Point> points{s.a, s.b};
        for (const Segment& other : segments_) {
            for (const Grid p : {other.a, other.b}) {
                if (s.line.at(p) == 0) points.emplace_back(p);
            }
            if (sign(s.line.at(other.a)) * sign(s.line.at(other.b)) < 0 &&
                sign(other.line.at(s.a)) * sign(other.line.at(s.b)) < 0)
                points.push_back(crossing(s.line, other.line));
        }
        const int64_t dx = s.b.x - s.a.x;
        const int64_t dy = s.b.y - s.a.y;
        std::sort(points.begin(), points.end(),
                  [&](const Point& p, const Point& q) { return compareAlong(p, q, dx, dy) < 0; });
        points.erase(std::unique(points.begin(), points.end()), points.end());
        for (size_t k = 1; k < points.size(); ++k) {
            if (compareAlong(points[k - 1], s.a, dx, dy) >= 0 &&
                compareAlong(points[k], s.b, dx, dy) <= 0)
                stretches_.push_back(
                    {points[k - 1], points[k], i, boxOf(points[k - 1], points[k], points[k])});
        }
    }
}

CutOracle::EdgeKey CutOracle::keyOf(uint32_t triangle, size_t k) const {
    return std::minmax(vertices_[triangle][k], vertices_[triangle][(k + 1) % 3]);
}

std::array<Grid, 2> CutOracle::endsOf(uint32_t triangle, size_t k) const {
    const Triangle& t = triangles[triangle];
    std::array<Grid, 2> ends{t.corner[k], t.corner[(k + 1) % 3]};
    if (vertices_[triangle][k] > vertices_[triangle][(k + 1) % 3]) std::swap(ends[0], ends[1]);
    return ends;
}

void CutOracle::clip(uint32_t index, const Stretch& stretch) {
    Triangle& t = triangles[index];
    const Segment& segment = segments_[stretch.segment];
    std::array<Line, 3> border;
    std::array<int, 3> from{}, to{};
    const auto inside = [&](const Point& p) {
        return std::all_of(border.begin(), border.end(),
                           [&](const Line& line) { return sign(line.at(p)) * t.turn >= 0; });
    };
    for (size_t k = 0; k < 3; ++k) {
        border[k] = Line(t.corner[k], t.corner[(k + 1) % 3]);
        from[k] = sign(border[k].at(stretch.from)) * t.turn;
        to[k] = sign(border[k].at(stretch.to)) * t.turn;
        if (from[k] <= 0 && to[k] <= 0 && from[k] + to[k] != 0) return;
    }
    std::optional<Point> first, last;
    if (inside(stretch.from)) first = stretch.from;
    if (inside(stretch.to)) last = stretch.to;
    for (size_t k = 0; k < 3; ++k) {
        if (from[k] * to[k] >= 0) continue;
        const Point p = crossing(segment.line, border[k]);
        if (!inside(p)) continue;
        (from[k] < 0 ? first : last) = p;
    }
    if (!first || !last || *first == *last) return;
    for (size_t k = 0; k < 3; ++k) {
        const bool firstOn = border[k].at(*first) == 0;
        const bool lastOn = border[k].at(*last) == 0;
        const auto [low, high] = endsOf(index, k);
        if (firstOn && lastOn) markEdge(index, k, *first, *last, segment.level);
        if (firstOn) edges[keyOf(index, k)].points.push_back(parameter(low, high, *first));
        if (lastOn) edges[keyOf(index, k)].points.push_back(parameter(low, high, *last));
        if (firstOn && lastOn) return;
    }
    t.parts.push_back({*first, *last, segment.level});
}

void CutOracle::markEdge(uint32_t triangle, size_t k, const Point& from, const Point& to,
                         uint32_t level) {
    const auto [low, high] = endsOf(triangle, k);
    const auto [first, last] = std::minmax({parameter(low, high, from), parameter(low, high, to)});
    marks_[keyOf(triangle, k)].push_back({first, last, level});
}

void CutOracle::conduct(uint32_t index, const Stretch& stretch) {
    const auto& c = triangles[index].corner;
    const Line own = c[0] == c[1] ? Line(c[0], c[2]) : Line(c[0], c[1]);
    const Segment& segment = segments_[stretch.segment];
    const int from = sign(own.at(stretch.from));
    const int to = sign(own.at(stretch.to));
    if (from * to > 0) return;
    if (from * to < 0) conductAt(index, crossing(own, segment.line), segment.level);
    if (from == 0) conductAt(index, stretch.from, segment.level);
    if (to == 0) conductAt(index, stretch.to, segment.level);
}

void CutOracle::conductAt(uint32_t index, const Point& place, uint32_t level) {
    const auto& c = triangles[index].corner;
    bool met = false;
    for (size_t k = 0; k < 3; ++k) {
        const auto [low, high] = endsOf(index, k);
        if (low == high) {
            if (!(place == Point(low))) continue;
            // The whole edge shows this place.
            marks_[keyOf(index, k)].push_back({{0, 1}, {1, 1}, level});
            continue;
        }
        const Fraction t = parameter(low, high, place);
        if (t.num < 0 || t.num > t.den) continue;
        edges[keyOf(index, k)].points.push_back(t);
        met = true;
    }
    const auto [low, high] = std::minmax({c[0], c[1], c[2]});
    if (!met || place == Point(low) || place == Point(high)) return;
    uint32_t& known = strips_[index][place];
    known = coarser(known, level);
}

void CutOracle::sortEdges() {
    for (auto& [key, edge] : edges) {
        auto& points = edge.points;
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
        std::erase_if(points, [](const Fraction& t) { return t.num <= 0 || t.num >= t.den; });
        edge.pieceLevels.assign(points.size() + 1, 0);
        const auto marks = marks_.find(key);
        if (marks == marks_.end()) continue;
        for (size_t piece = 0; piece <= points.size(); ++piece) {
            const Fraction from = piece == 0 ? Fraction(0, 1) : points[piece - 1];
            const Fraction to = piece == points.size() ? Fraction(1, 1) : points[piece];
            for (const Mark& mark : marks->second) {
                if (!(from < mark.from) && !(mark.to < to))
                    edge.pieceLevels[piece] = coarser(edge.pieceLevels[piece], mark.level);
            }
        }
    }
}

void CutOracle::findComponents() {
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (triangles[t].kind == Kind::area) divide(t);
        if (triangles[t].kind == Kind::line || triangles[t].kind == Kind::point)
            divideIntoStrips(t);
    }
    glueAndCount();
}

/// The lines under the parts, and one through each end of a part that lies on no other line.
std::vector<Line> CutOracle::cellLines(const Triangle& t) const {
    std::vector<Line> lines;
    const auto add = [&](const Line& line) {
        const Line reduced = line.reduced();
        if (std::find(lines.begin(), lines.end(), reduced) == lines.end()) lines.push_back(reduced);
    };
    const auto lineOf = [&](const Part& part) {
        for (const Segment& s : segments_) {
            if (s.line.at(part.from) == 0 && s.line.at(part.to) == 0) return s.line;
        }
        return Line();
    };
    for (const Part& part : t.parts) add(lineOf(part));
    const size_t drawn = lines.size();
    for (const Part& part : t.parts) {
        for (const Point& p : {part.from, part.to}) {
            const auto through = std::count_if(lines.begin(), lines.end(),
                                               [&](const Line& l) { return l.at(p) == 0; });
            if (through > 1 || p.w != 1) continue;
            const Grid grid{static_cast<int64_t>(p.x), static_cast<int64_t>(p.y)};
            const Line flat(grid, {grid.x + 1, grid.y});
            const Line steep(grid, {grid.x, grid.y + 1});
            const auto on = std::find_if(lines.begin(), lines.begin() + static_cast<long>(drawn),
                                         [&](const Line& l) { return l.at(p) == 0; });
            add(parallel(flat, *on) ? steep : flat);
        }
    }
    return lines;
}

void CutOracle::divide(uint32_t index) {
    const Triangle& t = triangles[index];
    Cell whole;
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t h = 3 * index + static_cast<uint32_t>(k);
        const auto [low, high] = endsOf(index, k);
        const bool forward = low == t.corner[k];
        const auto& points = edges[keyOf(index, k)].points;
        const auto n = static_cast<uint32_t>(points.size());
        const Line line(t.corner[k], t.corner[(k + 1) % 3]);
        for (uint32_t i = 0; i <= n; ++i) {
            const uint32_t piece = forward ? i : n - i;
            const Point from =
                i == 0 ? Point(t.corner[k]) : pointAt(low, high, points[forward ? i - 1 : n - i]);
            whole.sides.push_back({from, line, h, piece});
        }
    }
    std::vector<Cell> cells{whole};
    for (const Line& line : cellLines(t)) {
        std::vector<Cell> next;
        for (const Cell& cell : cells) {
            for (Cell& half : split(cell, line)) {
                if (!half.sides.empty()) next.push_back(std::move(half));
            }
        }
        cells = std::move(next);
    }

    const auto first = static_cast<uint32_t>(samples.size());
    std::map<std::pair<Point, Point>, uint32_t> cellAt;
    for (uint32_t c = 0; c < cells.size(); ++c) {
        const auto& sides = cells[c].sides;
        double u = 0, v = 0;
        for (const Cell::Side& s : sides) {
            u += s.from.u() / static_cast<double>(sides.size());
            v += s.from.v() / static_cast<double>(sides.size());
        }
        for (size_t i = 0; i < sides.size(); ++i) {
            const Point& from = sides[i].from;
            const Point& to = sides[(i + 1) % sides.size()].from;
            if (sides[i].halfEdge != kUnused) {
                cellsAtPiece_[{sides[i].halfEdge, sides[i].piece}].push_back(first + c);
                continue;
            }
            const auto [there, isNew] = cellAt.try_emplace(std::minmax(from, to), first + c);
            if (isNew) continue;
            uint32_t level = 0;
            for (const Part& part : t.parts) {
                const int64_t dx = static_cast<int64_t>(sides[i].line.b);
                const int64_t dy = -static_cast<int64_t>(sides[i].line.a);
                if (sides[i].line.at(part.from) != 0 || sides[i].line.at(part.to) != 0) continue;
                const bool along = compareAlong(part.from, part.to, dx, dy) < 0;
                const Point& low = along ? part.from : part.to;
                const Point& high = along ? part.to : part.from;
                const bool covers =
                    compareAlong(low, from, dx, dy) <= 0 && compareAlong(from, high, dx, dy) <= 0 &&
                    compareAlong(low, to, dx, dy) <= 0 && compareAlong(to, high, dx, dy) <= 0;
                if (covers) level = coarser(level, part.level);
            }
            unions_.push_back({there->second, first + c, level});
        }
        addCell(index, weightsAt(t.corner, u, v));
    }
}

void CutOracle::addCell(uint32_t triangle, const std::array<double, 3>& weights) {
    samples.push_back({triangle, weights, static_cast<uint32_t>(samples.size())});
}

/// Strips between the places a line is conducted at, in the order of grid points.
void CutOracle::divideIntoStrips(uint32_t index) {
    const auto& c = triangles[index].corner;
    const Grid low = std::min({c[0], c[1], c[2]});
    const Grid high = std::max({c[0], c[1], c[2]});
    const auto first = static_cast<uint32_t>(samples.size());
    const int64_t dx = high.x - low.x;
    const int64_t dy = high.y - low.y;
    std::vector<std::pair<Point, uint32_t>> cuts;
    if (const auto it = strips_.find(index); it != strips_.end())
        cuts.assign(it->second.begin(), it->second.end());
    std::sort(cuts.begin(), cuts.end(), [&](const auto& x, const auto& y) {
        return compareAlong(x.first, y.first, dx, dy) < 0;
    });
    const auto share = [&](const Point& p) {
        const auto d = static_cast<double>(dx * dx + dy * dy);
        if (d == 0) return 0.0;
        return ((p.u() - static_cast<double>(low.x)) * static_cast<double>(dx) +
                (p.v() - static_cast<double>(low.y)) * static_cast<double>(dy)) /
               d;
    };
    for (size_t i = 0; i <= cuts.size(); ++i) {
        // About the middle of the strip: half way between its two places on the border of the
        // triangle.
        const double s = (i == 0 ? 0 : share(cuts[i - 1].first)) * 0.51 +
                         (i == cuts.size() ? 1 : share(cuts[i].first)) * 0.49;
        std::array<double, 3> weights{};
        int met = 0;
        for (size_t k = 0; k < 3; ++k) {
            const double a = share(c[k]);
            const double b = share(c[(k + 1) % 3]);
            if (a == b || (s - a) * (s - b) >= 0) continue;
            weights[k] += (b - s) / (b - a) / 2;
            weights[(k + 1) % 3] += (s - a) / (b - a) / 2;
            ++met;
        }
        if (high == low) weights = {1.0 / 3, 1.0 / 3, 1.0 / 3};
        if (high != low && met != 2) weights = {2, -1, 0};  // through a corner: no place to name
        addCell(index, weights);
        if (i > 0)
            unions_.push_back({first + static_cast<uint32_t>(i) - 1,
                               first + static_cast<uint32_t>(i), cuts[i - 1].second});
    }
    for (size_t k = 0; k < 3; ++k) {
        const auto [a, b] = endsOf(index, k);
        const auto& points = edges[keyOf(index, k)].points;
        for (uint32_t piece = 0; piece <= points.size(); ++piece) {
            // Which strip a piece belongs to: as many as lie before its middle.
            const Fraction from = piece == 0 ? Fraction(0, 1) : points[piece - 1];
            const Fraction to = piece == points.size() ? Fraction(1, 1) : points[piece];
            const Point p = pointAt(a, b, from);
            const Point q = pointAt(a, b, to);
            const Point& before = compareAlong(p, q, dx, dy) < 0 ? q : p;
            uint32_t strip = 0;
            for (const auto& cut : cuts)
                strip += compareAlong(cut.first, before, dx, dy) < 0 ? 1 : 0;
            const uint32_t h = 3 * index + static_cast<uint32_t>(k);
            cellsAtPiece_[{h, piece}].push_back(first + strip);
        }
    }
}

void CutOracle::glueAndCount() {
    for (const auto& [key, edge] : edges) {
        for (uint32_t piece = 0; piece < edge.pieceLevels.size(); ++piece) {
            std::vector<uint32_t> sides;
            for (const uint32_t h : edge.uses) {
                if (h == kUnused) continue;
                const auto& cells = cellsAtPiece_[{h, piece}];
                sides.push_back(cells.front());
            }
            if (sides.size() == 2) unions_.push_back({sides[0], sides[1], edge.pieceLevels[piece]});
        }
    }
    for (uint32_t level = 1; level <= levels; ++level) {
        std::vector<uint32_t> parent(samples.size());
        std::iota(parent.begin(), parent.end(), 0U);
        const auto find = [&](uint32_t i) {
            while (parent[i] != i) i = parent[i] = parent[parent[i]];
            return i;
        };
        for (const Union& u : unions_) {
            if (u.level == 0 || u.level > level) parent[find(u.a)] = find(u.b);
        }
        uint32_t count = 0;
        for (uint32_t i = 0; i < parent.size(); ++i) {
            count += parent[i] == i ? 1 : 0;
            parent[i] = find(i);
        }
        components.push_back(parent);
        counts.push_back(count);
    }
}

}  // namespace sherd::test
