// SPDX-License-Identifier: MIT
// Incremental convex hull (M. Kallay, 1984) in the order of volume gained: each step takes the
// point whose pyramid over the faces it sees is largest. Taking the farthest point instead was
// tried: it spends vertices on spikes and covers less.
#include "physics/hull_selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/predicates.h"

namespace sherd {
namespace {

constexpr double kFlat = 1e-5;

uint32_t farthest(std::span<const glm::dvec3> points, const auto& distance, double& most) {
    uint32_t best = 0;
    most = -1;
    for (uint32_t i = 0; i < points.size(); ++i) {
        const double d = distance(points[i]);
        if (d > most) {
            most = d;
            best = i;
        }
    }
    return best;
}

struct Face {
    std::array<uint32_t, 3> v;
    glm::dvec3 normal;  ///< twice the area long; outwards
    double offset;
    double length;  ///< of the normal
};

/// What every point would add to the hull and how far it lies outside are kept up to date face by
/// face: asking for all of them again after every step took ten times as long.
class GreedyHull {
  public:
    GreedyHull(std::span<const glm::dvec3> points, const std::vector<uint32_t>& simplex)
        : points_(points), gain_(points.size(), 0.0) {
        for (const uint32_t v : simplex) inside_ += 0.25 * points[v];
        for (int skip = 0; skip < 4; ++skip) {
            std::array<uint32_t, 3> v{};
            for (int k = 0, n = 0; k < 4; ++k) {
                if (k != skip) v[static_cast<size_t>(n++)] = simplex[static_cast<size_t>(k)];
            }
            Face face = makeFace(v);
            if (glm::dot(face.normal, inside_) > face.offset) {
                face = makeFace({v[0], v[2], v[1]});
            }
            insert(face);
        }
        volume6_ = std::abs(faces_[0].offset - glm::dot(faces_[0].normal, points[simplex[0]]));
        for (const uint32_t v : simplex) gain_[v] = 0;
    }

    double volume() const { return volume6_ / 6; }
    /// Volume gained by each point, times 6.
    const std::vector<double>& gains() const { return gain_; }

    /// How far the point lies outside at least.
    double farness(uint32_t point) const {
        double most = 0;
        for (const Face& face : faces_)
            most = std::max(most, height(face, points_[point]) / face.length);
        return most;
    }

    void add(uint32_t vertex) {
        const glm::dvec3& p = points_[vertex];
        volume6_ += gain_[vertex];
        std::vector<std::pair<uint32_t, uint32_t>> edges;
        std::vector<Face> kept;
        for (const Face& face : faces_) {
            // Exactly: points that planes cut lie in one plane but for rounding, and of what such a
            // point sees rounding leaves no disc; edges then multiply with every step.
            if (orient3d(points_[face.v[0]], points_[face.v[1]], points_[face.v[2]], p) <= 0) {
                kept.push_back(face);
                continue;
            }
            count(face, -1);
            for (size_t k = 0; k < 3; ++k) edges.emplace_back(face.v[k], face.v[(k + 1) % 3]);
        }
        faces_ = std::move(kept);
        for (const auto& [a, b] : edges) {
            const bool isInner =
                std::find(edges.begin(), edges.end(), std::pair(b, a)) != edges.end();
            if (!isInner) insert(makeFace({a, b, vertex}));
        }
        gain_[vertex] = 0;
    }

  private:
    Face makeFace(const std::array<uint32_t, 3>& v) const {
        const glm::dvec3& a = points_[v[0]];
        const glm::dvec3 normal = glm::cross(points_[v[1]] - a, points_[v[2]] - a);
        return {v, normal, glm::dot(normal, a), std::max(glm::length(normal), 1e-300)};
    }

    static double height(const Face& face, const glm::dvec3& p) {
        return glm::dot(face.normal, p) - face.offset;
    }

    void insert(const Face& face) {
        faces_.push_back(face);
        count(face, 1);
    }

    void count(const Face& face, double sign) {
        for (size_t i = 0; i < points_.size(); ++i)
            gain_[i] += sign * std::max(0.0, height(face, points_[i]));
    }

    std::span<const glm::dvec3> points_;
    glm::dvec3 inside_{0.0};
    std::vector<Face> faces_;
    std::vector<double> gain_;
    double volume6_ = 0;
};

/// Finds the farthest of the points that count. Points come nearer as the hull grows: what was
/// measured once is the most that a distance can be, so few are measured again.
class FarthestPoint {
  public:
    FarthestPoint(std::span<const uint8_t> counts, double reach) : reach_(reach) {
        for (const uint8_t does : counts)
            most_.push_back(does != 0 ? std::numeric_limits<double>::infinity() : 0.0);
    }

    /// One farther than the reach; nothing: there is none.
    std::optional<uint32_t> next(const GreedyHull& hull) {
        while (!most_.empty()) {
            const auto top = std::max_element(most_.begin(), most_.end());
            if (*top <= reach_) break;
            const auto point = static_cast<uint32_t>(top - most_.begin());
            const double farness = hull.farness(point);
            if (farness >= *top) return point;
            *top = farness;
            const double second = *std::max_element(most_.begin(), most_.end());
            if (farness > reach_ && farness >= second) return point;
        }
        return std::nullopt;
    }

  private:
    double reach_;
    std::vector<double> most_;  ///< per point: no farther than this
};

/// The point that is to be in the hull next; nothing: none has to.
std::optional<uint32_t> nextPoint(const GreedyHull& hull, size_t chosen, const SelectionGoal& goal,
                                  FarthestPoint& farthestPoint) {
    const std::vector<double>& gains = hull.gains();
    const auto best = std::max_element(gains.begin(), gains.end());
    if (!(*best > 1e-9)) return std::nullopt;
    if (chosen < goal.count || hull.volume() < goal.volume)
        return static_cast<uint32_t>(best - gains.begin());
    const std::optional<uint32_t> far = farthestPoint.next(hull);
    // What adds nothing lies on the hull but for rounding.
    return far && gains[*far] > 1e-9 ? far : std::nullopt;
}

std::vector<uint32_t> selectSolid(std::span<const glm::dvec3> points,
                                  const std::vector<uint32_t>& simplex, const SelectionGoal& goal) {
    std::vector<uint32_t> chosen = simplex;
    GreedyHull hull(points, simplex);
    FarthestPoint farthestPoint(goal.counts, goal.reach);
    while (chosen.size() < std::max(goal.count, goal.most)) {
        const std::optional<uint32_t> next = nextPoint(hull, chosen.size(), goal, farthestPoint);
        if (!next) break;
        hull.add(*next);
        chosen.push_back(*next);
    }
    return chosen;
}

/// The same in a plane: the area between a new corner and the edge it replaces.
std::vector<uint32_t> selectFlat(std::span<const glm::dvec3> points, const Span& span,
                                 uint32_t count) {
    std::vector<uint32_t> ring = span.simplex;
    const glm::dvec3& n = span.direction;
    const auto area = [&](uint32_t a, uint32_t b, const glm::dvec3& p) {
        return glm::dot(n, glm::cross(points[b] - points[a], p - points[a]));
    };
    if (area(ring[0], ring[1], points[ring[2]]) < 0) std::swap(ring[1], ring[2]);
    while (ring.size() < count) {
        double most = 1e-9;
        size_t edge = 0;
        uint32_t best = 0;
        for (size_t k = 0; k < ring.size(); ++k) {
            for (uint32_t i = 0; i < points.size(); ++i) {
                const double outside = -area(ring[k], ring[(k + 1) % ring.size()], points[i]);
                if (!(outside > most)) continue;
                most = outside;
                edge = k;
                best = i;
            }
        }
        if (most <= 1e-9) break;
        ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(edge) + 1, best);
    }
    return ring;
}

}  // namespace

Span spanOf(std::span<const glm::dvec3> points) {
    Span out;
    double most = 0;
    const uint32_t a = farthest(
        points, [&](const glm::dvec3& p) { return -p.x - 1e-3 * p.y - 1e-6 * p.z + 10; }, most);
    const uint32_t b = farthest(
        points, [&](const glm::dvec3& p) { return glm::length(p - points[a]); }, most);
    out.simplex = {a};
    if (most < kFlat) return out;
    out.dimension = 1;
    out.direction = glm::normalize(points[b] - points[a]);
    out.simplex.push_back(b);
    const auto fromLine = [&](const glm::dvec3& p) {
        return glm::length(glm::cross(out.direction, p - points[a]));
    };
    const uint32_t c = farthest(points, fromLine, most);
    if (most < kFlat) return out;
    out.dimension = 2;
    out.simplex.push_back(c);
    out.direction = glm::normalize(glm::cross(points[b] - points[a], points[c] - points[a]));
    const auto fromPlane = [&](const glm::dvec3& p) {
        return std::abs(glm::dot(out.direction, p - points[a]));
    };
    const uint32_t d = farthest(points, fromPlane, most);
    if (most < kFlat) return out;
    out.dimension = 3;
    out.simplex.push_back(d);
    return out;
}

std::vector<uint32_t> selectHullVertices(std::span<const glm::dvec3> points, const Span& span,
                                         const SelectionGoal& goal) {
    if (span.dimension == 3) return selectSolid(points, span.simplex, goal);
    if (span.dimension == 2) return selectFlat(points, span, goal.count);
    return span.simplex;
}

}  // namespace sherd
