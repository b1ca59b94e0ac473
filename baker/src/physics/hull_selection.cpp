// SPDX-License-Identifier: MIT
// Incremental convex hull (M. Kallay, 1984) in the order of volume gained: each step takes the
// point whose pyramid over the faces it sees is largest. Taking the farthest point instead was
// tried: it spends vertices on spikes and covers less.
#include "physics/hull_selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

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
};

class GreedyHull {
  public:
    GreedyHull(std::span<const glm::dvec3> points, const std::vector<uint32_t>& simplex)
        : points_(points) {
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
            faces_.push_back(face);
        }
    }

    /// Volume gained by adding p, times 6.
    double gain(const glm::dvec3& p) const {
        double sum = 0;
        for (const Face& face : faces_) {
            const double height = glm::dot(face.normal, p) - face.offset;
            if (height > 0) sum += height;
        }
        return sum;
    }

    void add(uint32_t vertex) {
        const glm::dvec3& p = points_[vertex];
        std::vector<std::pair<uint32_t, uint32_t>> edges;
        std::vector<Face> kept;
        for (const Face& face : faces_) {
            if (!(glm::dot(face.normal, p) - face.offset > 0)) {
                kept.push_back(face);
                continue;
            }
            for (size_t k = 0; k < 3; ++k) edges.emplace_back(face.v[k], face.v[(k + 1) % 3]);
        }
        for (const auto& [a, b] : edges) {
            const bool isInner =
                std::find(edges.begin(), edges.end(), std::pair(b, a)) != edges.end();
            if (!isInner) kept.push_back(makeFace({a, b, vertex}));
        }
        faces_ = std::move(kept);
    }

  private:
    Face makeFace(const std::array<uint32_t, 3>& v) const {
        const glm::dvec3& a = points_[v[0]];
        const glm::dvec3 normal = glm::cross(points_[v[1]] - a, points_[v[2]] - a);
        return {v, normal, glm::dot(normal, a)};
    }

    std::span<const glm::dvec3> points_;
    glm::dvec3 inside_{0.0};
    std::vector<Face> faces_;
};

std::vector<uint32_t> selectSolid(std::span<const glm::dvec3> points,
                                  const std::vector<uint32_t>& simplex, uint32_t count) {
    std::vector<uint32_t> chosen = simplex;
    GreedyHull hull(points, simplex);
    while (chosen.size() < count) {
        double most = 0;
        const uint32_t best = farthest(
            points, [&](const glm::dvec3& p) { return hull.gain(p); }, most);
        if (!(most > 1e-9)) break;
        hull.add(best);
        chosen.push_back(best);
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
                                         uint32_t count) {
    if (span.dimension == 3) return selectSolid(points, span.simplex, count);
    if (span.dimension == 2) return selectFlat(points, span, count);
    return span.simplex;
}

}  // namespace sherd
