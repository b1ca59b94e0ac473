// SPDX-License-Identifier: MIT
#include "surface/surface_path.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <queue>

#include "geometry/triangle.h"

namespace sherd {
namespace {

uint32_t previousCorner(uint32_t corner) {
    return nextCorner(nextCorner(corner));
}

/// The half edges of a triangle on which a frame point lies, as a bit mask.
uint32_t edgesAt(GridPoint p) {
    return (p.v == 0 ? 1U : 0U) | (p.u + p.v == kGridOne ? 2U : 0U) | (p.u == 0 ? 4U : 0U);
}

/// Where a plane crosses the surface: the zero set of a number per vertex. Zero counts as positive,
/// so every triangle has no crossing edge or two.
class PlaneCurve {
  public:
    PlaneCurve(const SplitSurface& surface, const glm::dvec3& point, const glm::dvec3& normal)
        : surface_(surface), point_(point), normal_(normal) {}

    uint32_t start(uint32_t h) const { return surface_.triangles[h / 3].v[h % 3]; }
    uint32_t end(uint32_t h) const { return start(nextCorner(h)); }
    glm::dvec3 at(uint32_t vertex) const { return surface_.positions[vertex]; }
    double value(uint32_t vertex) const { return glm::dot(normal_, at(vertex) - point_); }
    bool positive(uint32_t vertex) const { return value(vertex) >= 0; }
    bool crosses(uint32_t h) const { return positive(start(h)) != positive(end(h)); }

    /// Where on half edge h, in steps from its start; the same from both sides.
    int32_t stepsOn(uint32_t h) const {
        const uint32_t low = std::min(start(h), end(h));
        const uint32_t high = std::max(start(h), end(h));
        const double a = value(low);
        const double t = std::clamp(a / (a - value(high)), 0.0, 1.0);
        const auto steps = static_cast<int32_t>(std::lround(t * kGridOne));
        return low == start(h) ? steps : kGridOne - steps;
    }
    glm::dvec3 placeOn(uint32_t h, int32_t steps) const {
        const double t = double{1} * steps / kGridOne;
        return at(start(h)) * (1 - t) + at(end(h)) * t;
    }

  private:
    const SplitSurface& surface_;
    glm::dvec3 point_, normal_;
};

/// One way along the curve, about to cross a half edge.
struct Walker {
    double length = 0;
    size_t number = 0;                       ///< of equally long ones the first goes on
    uint32_t halfEdge = 0;                   ///< of the triangle walked last
    int32_t steps = 0;                       ///< where on it
    bool operator<(const Walker& o) const {  // the shortest on top
        return length != o.length ? length > o.length : number > o.number;
    }
};

}  // namespace

PathTracer::PathTracer(const SplitSurface& surface, const MeshTopology& topology)
    : surface_(surface), topology_(topology), cornerOfVertex_(surface.positions.size(), kNone) {
    for (uint32_t c = 0; c < 3 * surface.triangles.size(); ++c) {
        if (topology.degenerate[c / 3] == 0) cornerOfVertex_[surface.triangles[c / 3].v[c % 3]] = c;
    }
}

glm::dvec3 PathTracer::position(uint32_t vertex) const {
    return surface_.positions[vertex];
}

PathTracer::Star PathTracer::cornersAround(uint32_t corner) const {
    Star star;
    const auto add = [&](uint32_t c) { star.push_back({c / 3, onHalfEdge(c % 3, 0)}); };
    uint32_t c = corner;
    do {
        add(c);
        const uint32_t o = topology_.opposite[previousCorner(c)];
        c = o;
    } while (c != kNone && c != corner);
    if (c == corner) return star;
    for (c = corner;;) {  // a border: the other way round too
        const uint32_t o = topology_.opposite[c];
        if (o == kNone) return star;
        c = nextCorner(o);
        add(c);
    }
}

PathTracer::Star PathTracer::starOf(const SurfacePoint& point) const {
    const uint32_t on = edgesAt(point.frame);
    const uint32_t first = 3 * point.triangle;
    if (on == 5) return cornersAround(first);
    if (on == 3) return cornersAround(first + 1);
    if (on == 6) return cornersAround(first + 2);
    Star star{{point.triangle, point.frame}};
    if (on == 0) return star;
    const uint32_t k = on == 1 ? 0 : on == 2 ? 1 : 2;
    const uint32_t o = topology_.opposite[first + k];
    if (o == kNone) return star;
    const int32_t steps = k == 0   ? point.frame.u
                          : k == 1 ? point.frame.v
                                   : kGridOne - point.frame.v;
    star.push_back({o / 3, onHalfEdge(o % 3, kGridOne - steps)});
    return star;
}

glm::dvec3 PathTracer::normalOf(const Star& star) const {
    glm::dvec3 sum(0.0);
    for (const Seen& seen : star) {
        const auto& v = surface_.triangles[seen.triangle].v;
        const glm::dvec3 normal =
            glm::cross(position(v[1]) - position(v[0]), position(v[2]) - position(v[0]));
        const double length = glm::length(normal);
        if (length > 0) sum += normal / length;
    }
    const double length = glm::length(sum);
    return length > 0 ? sum / length : glm::dvec3(0.0);
}

std::optional<SurfacePath> PathTracer::trace(const SurfacePoint& from, const SurfacePoint& to,
                                             uint32_t line) const {
    const Star start = starOf(from);
    const Star end = starOf(to);
    for (const Seen& s : start) {
        for (const Seen& e : end) {
            if (s.triangle != e.triangle) continue;
            return SurfacePath{{{s.triangle, s.frame, e.frame, line}}, false};
        }
    }
    if (auto path = byPlane(from, start, end, positionOf(surface_, to), line)) return path;
    return byEdges(start, end, line);
}

std::optional<SurfacePath> PathTracer::byPlane(const SurfacePoint& from, const Star& start,
                                               const Star& end, const glm::dvec3& target,
                                               uint32_t line) const {
    const glm::dvec3 origin = positionOf(surface_, from);
    const glm::dvec3 first = normalOf(start);
    glm::dvec3 up = first + normalOf(end);
    // From one side of a plate to the other the normals cancel: either holds then.
    if (glm::length(up) < 1e-6) up = first;
    const glm::dvec3 normal = glm::cross(target - origin, up);
    if (!(glm::dot(normal, normal) > 0)) return std::nullopt;
    const PlaneCurve curve(surface_, origin, glm::normalize(normal));

    std::priority_queue<Walker> walkers;
    std::vector<std::vector<Chord>> trails;  // by the walkers' numbers
    const auto leave = [&](Walker walker, uint32_t triangle, GridPoint entry,
                           const glm::dvec3& here, uint32_t h) {
        walker.halfEdge = h;
        walker.steps = curve.stepsOn(h);
        walker.length += glm::distance(here, curve.placeOn(h, walker.steps));
        trails[walker.number].push_back({triangle, entry, onHalfEdge(h % 3, walker.steps), line});
        walkers.push(walker);
    };
    for (const Seen& seen : start) {
        const uint32_t on = edgesAt(seen.frame);
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t h = 3 * seen.triangle + k;
            if ((on >> k & 1) != 0 || !curve.crosses(h)) continue;
            Walker walker;
            walker.number = trails.size();
            trails.emplace_back();
            leave(walker, seen.triangle, seen.frame, origin, h);
        }
    }
    // Both ways round are walked at once, the shorter first, until one arrives.
    for (size_t budget = 2 * surface_.triangles.size(); !walkers.empty() && budget > 0; --budget) {
        const Walker walker = walkers.top();
        walkers.pop();
        const uint32_t o = topology_.opposite[walker.halfEdge];
        if (o == kNone) continue;
        const uint32_t triangle = o / 3;
        const GridPoint entry = onHalfEdge(o % 3, kGridOne - walker.steps);
        const auto isHere = [triangle](const Seen& s) { return s.triangle == triangle; };
        if (std::any_of(start.begin(), start.end(), isHere)) continue;  // once around
        if (const auto arrived = std::find_if(end.begin(), end.end(), isHere);
            arrived != end.end()) {
            trails[walker.number].push_back({triangle, entry, arrived->frame, line});
            return SurfacePath{std::move(trails[walker.number]), false};
        }
        const glm::dvec3 here = curve.placeOn(walker.halfEdge, walker.steps);
        const uint32_t ahead = nextCorner(o);
        leave(walker, triangle, entry, here, curve.crosses(ahead) ? ahead : previousCorner(o));
    }
    return std::nullopt;
}

std::optional<SurfacePath> PathTracer::byEdges(const Star& start, const Star& end,
                                               uint32_t line) const {
    struct Reached {
        double length;
        Chord chord;  ///< the last one on the way
        uint32_t from;
    };
    std::map<uint32_t, Reached> reached;
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto offer = [&](uint32_t vertex, const Reached& way) {
        const auto [it, isNew] = reached.try_emplace(vertex, way);
        if (!isNew && way.length >= it->second.length) return;
        it->second = way;
        queue.push({way.length, vertex});
    };
    for (const Seen& seen : start) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t vertex = surface_.triangles[seen.triangle].v[k];
            const double length = glm::distance(
                position(vertex), positionOf(surface_, {seen.triangle, seen.frame, 0}));
            offer(vertex, {length, {seen.triangle, seen.frame, onHalfEdge(k, 0), line}, kNone});
        }
    }
    std::map<uint32_t, Seen> goal;  // vertex -> the end's triangle it is a corner of
    for (const Seen& seen : end)
        for (uint32_t k = 0; k < 3; ++k)
            goal.try_emplace(surface_.triangles[seen.triangle].v[k], seen);
    while (!queue.empty()) {
        const auto [length, vertex] = queue.top();
        queue.pop();
        if (length > reached.at(vertex).length) continue;
        if (const auto last = goal.find(vertex); last != goal.end()) {
            SurfacePath path{{}, true};
            const auto& v = surface_.triangles[last->second.triangle].v;
            const auto k = static_cast<uint32_t>(std::find(v.begin(), v.end(), vertex) - v.begin());
            path.chords.push_back(
                {last->second.triangle, onHalfEdge(k, 0), last->second.frame, line});
            for (uint32_t at = vertex; at != kNone; at = reached.at(at).from)
                path.chords.push_back(reached.at(at).chord);
            return path;
        }
        for (const Seen& around : cornersAround(cornerOfVertex_[vertex])) {
            const auto& v = surface_.triangles[around.triangle].v;
            const auto k = static_cast<uint32_t>(std::find(v.begin(), v.end(), vertex) - v.begin());
            for (const uint32_t j : {(k + 1) % 3, (k + 2) % 3}) {
                offer(v[j], {length + glm::distance(position(vertex), position(v[j])),
                             {around.triangle, onHalfEdge(k, 0), onHalfEdge(j, 0), line},
                             vertex});
            }
        }
    }
    return std::nullopt;
}

}  // namespace sherd
