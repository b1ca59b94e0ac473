// SPDX-License-Identifier: MIT
// Edges of the mesh are walked from cell to cell; triangle and cell being convex, what they share
// is one polygon, of stretches of the triangle's edges in the cell and of the cell's sides in the
// triangle. Which there are follows from the crossings of edges and sides alone.
#include "volume/prism_polygons.h"

#include <algorithm>
#include <utility>

#include "geometry/no_index.h"

namespace sherd {
namespace {}  // namespace

PrismPolygons::PrismPolygons(const PrismInput& input, PrismVertices& vertices)
    : input_(input), vertices_(vertices) {}

/// From a vertex in `cell` to another; `cell` is that one's then.
bool PrismPolygons::walk(uint32_t from, uint32_t to, uint32_t& cell,
                         std::vector<Crossing>* path) const {
    const PlanePoint u = input_.planar(from), v = input_.planar(to);
    if (u == v) return true;
    for (uint32_t steps = 0;; ++steps) {
        if (steps > input_.map.cells()) return false;
        const auto sides = input_.map.sides(cell);
        const auto exit = std::find_if(sides.begin(), sides.end(), [&](const PrismMap::Side& side) {
            return input_.map.leavesOver(u, v, side);
        });
        if (exit == sides.end()) return true;
        if (exit->across == kNone) return false;
        if (path != nullptr) path->push_back({cell, static_cast<uint32_t>(exit - sides.begin())});
        cell = exit->across;
    }
}

bool PrismPolygons::locate() {
    cellOf_.assign(input_.points.size(), kNone);
    std::vector<std::vector<uint32_t>> neighbours(input_.points.size());
    for (const auto& t : input_.triangles)
        for (size_t k = 0; k < 3; ++k) neighbours[t[k]].push_back(t[(k + 1) % 3]);
    std::vector<uint32_t> open;
    uint32_t last = kNone;
    const auto set = [&](uint32_t vertex, uint32_t cell) {
        cellOf_[vertex] = cell;
        open.push_back(vertex);
    };
    for (const auto& t : input_.triangles) {
        if (cellOf_[t[0]] != kNone) continue;
        uint32_t cell = 0;
        if (last == kNone) {
            const auto holds = [&](uint32_t c) {
                const auto sides = input_.map.sides(c);
                return std::all_of(sides.begin(), sides.end(), [&](const PrismMap::Side& side) {
                    return input_.map.sideOf(input_.planar(t[0]), side) > 0;
                });
            };
            while (cell < input_.map.cells() && !holds(cell)) ++cell;
            if (cell == input_.map.cells()) return false;
        } else {
            cell = cellOf_[last];
            if (!walk(last, t[0], cell, nullptr)) return false;
        }
        last = t[0];
        set(t[0], cell);
        while (!open.empty()) {
            const uint32_t u = open.back();
            open.pop_back();
            for (const uint32_t v : neighbours[u]) {
                if (cellOf_[v] != kNone) continue;
                cell = cellOf_[u];
                if (!walk(u, v, cell, nullptr)) return false;
                set(v, cell);
            }
        }
    }
    return true;
}

/// Of the edge from its lower vertex to its higher.
std::span<const PrismPolygons::Crossing> PrismPolygons::pathOf(uint32_t u, uint32_t v) {
    const auto [key, isNew] = edges_.add({std::min(u, v), std::max(u, v), 0, 0});
    if (isNew) {
        uint32_t cell = cellOf_[std::min(u, v)];
        walk(std::min(u, v), std::max(u, v), cell, &paths_);
        pathStart_.push_back(static_cast<uint32_t>(paths_.size()));
    }
    return std::span(paths_).subspan(pathStart_[key], pathStart_[key + 1] - pathStart_[key]);
}

int PrismPolygons::turnOf(uint32_t triangle) const {
    const auto& t = input_.triangles[triangle];
    const PlanePoint a = input_.planar(t[0]), b = input_.planar(t[1]), c = input_.planar(t[2]);
    const int64_t det = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    return (det > 0) - (det < 0);
}

std::optional<uint32_t> PrismPolygons::cellOf(uint32_t triangle) {
    const auto& t = input_.triangles[triangle];
    for (size_t k = 0; k < 3; ++k)
        if (!pathOf(t[k], t[(k + 1) % 3]).empty()) return std::nullopt;
    return cellOf_[t[0]];  // cells are convex
}

bool PrismPolygons::isInside(uint32_t node, uint32_t triangle, int turn) {
    if (turn == 0) return false;
    const auto& t = input_.triangles[triangle];
    for (size_t k = 0; k < 3; ++k) {
        const PlanePoint u = input_.planar(t[k]), v = input_.planar(t[(k + 1) % 3]);
        if (input_.map.sideOf(node, u, v) != turn) return false;
    }
    return true;
}

size_t PrismPolygons::reach(uint32_t cell) {
    for (size_t n = 0; n < count_; ++n)
        if (polygons_[n].cell == cell) return n;
    if (count_ == polygons_.size()) polygons_.emplace_back();
    polygons_[count_].cell = cell;
    polygons_[count_].edges.clear();
    return count_++;
}

/// The triangle's edges, cut where they go from cell to cell.
void PrismPolygons::addSides(uint32_t triangle) {
    const auto& t = input_.triangles[triangle];
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t u = t[k], v = t[(k + 1) % 3];
        const auto path = pathOf(u, v);
        const bool along = u < v;
        uint32_t from = u, cell = cellOf_[u];
        for (size_t n = 0; n < path.size(); ++n) {
            const Crossing& crossing = along ? path[n] : path[path.size() - 1 - n];
            const PrismMap::Side& side = input_.map.sides(crossing.cell)[crossing.side];
            const uint32_t vertex = vertices_.onEdge(u, v, side.line);
            polygons_[reach(cell)].edges.push_back({from, vertex, Edge::kSkin});
            const PrismMap::Line& line = input_.map.line(side.line);
            met_.push_back({side.line, vertex,
                            input_.map.sideOf(line.from, input_.planar(u), input_.planar(v)) < 0});
            from = vertex;
            cell = along ? side.across : crossing.cell;
        }
        polygons_[reach(cell)].edges.push_back({from, v, Edge::kSkin});
    }
}

/// The sides of a cell, as far as they are in the triangle.
void PrismPolygons::addWalls(uint32_t triangle, int turn, size_t polygon) {
    const uint32_t cell = polygons_[polygon].cell;
    const auto sides = input_.map.sides(cell);
    for (uint32_t s = 0; s < sides.size(); ++s) {
        const PrismMap::Side& side = sides[s];
        const bool along = input_.map.line(side.line).from == side.from;
        std::array<uint32_t, 2> ends{kNone, kNone};  // going along the side
        uint32_t crossings = 0;
        for (const Met& met : met_) {
            if (met.line != side.line) continue;
            ++crossings;
            // A triangle seen from behind is entered where it would be left.
            const bool first = turn == 0 ? ends[0] == kNone : (met.enters == (turn > 0)) == along;
            ends[first ? 0 : 1] = met.vertex;
        }
        if (turn != 0 && crossings < 2) {
            if (ends[0] == kNone && isInside(side.from, triangle, turn))
                ends[0] = vertices_.atNode(triangle, side.from);
            if (ends[1] == kNone && isInside(side.to, triangle, turn))
                ends[1] = vertices_.atNode(triangle, side.to);
        }
        if (ends[0] == kNone || ends[1] == kNone) continue;
        if (turn == 0) {
            // Upright: from where the triangle leaves the cell to where it enters it.
            const auto& edges = polygons_[polygon].edges;
            if (std::any_of(edges.begin(), edges.end(), [&](const Edge& e) {
                    return e.side == Edge::kSkin && e.to == ends[1];
                }))
                std::swap(ends[0], ends[1]);
        } else if (turn < 0) {
            std::swap(ends[0], ends[1]);
        }
        polygons_[polygon].edges.push_back({ends[0], ends[1], s});
        if (side.across != kNone) reach(side.across);
    }
}

/// Puts the edges one after the other.
bool PrismPolygons::link(Polygon& polygon) {
    for (size_t n = 0; n + 1 < polygon.edges.size(); ++n) {
        const auto next = std::find_if(
            polygon.edges.begin() + static_cast<std::ptrdiff_t>(n) + 1, polygon.edges.end(),
            [&](const Edge& e) { return e.from == polygon.edges[n].to; });
        if (next == polygon.edges.end()) return false;
        std::swap(polygon.edges[n + 1], *next);
    }
    return polygon.edges.size() > 2 && polygon.edges.back().to == polygon.edges.front().from;
}

std::span<const PrismPolygons::Polygon> PrismPolygons::run(uint32_t triangle) {
    count_ = 0;
    met_.clear();
    nodes_.clear();
    const int turn = turnOf(triangle);
    addSides(triangle);
    for (size_t n = 0; n < count_; ++n) {
        addWalls(triangle, turn, n);
        for (const PrismMap::Side& side : input_.map.sides(polygons_[n].cell))
            if (isInside(side.from, triangle, turn)) nodes_.push_back(side.from);
    }
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    for (size_t n = 0; n < count_; ++n)
        if (!link(polygons_[n])) return {};
    return std::span(polygons_).first(count_);
}

}  // namespace sherd
