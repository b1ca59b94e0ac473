// SPDX-License-Identifier: MIT
// Minimal triangulation by dynamic programming (Klincsek 1980; Barequet and Sharir 1995, Filling
// Gaps in the Boundary of a Polyhedron). The weight is area times the sum of the squared edges: of
// all triangulations of a plane point set it is Delaunay's that has the least (Rajan 1991), so flat
// walls get what a constrained Delaunay triangulation gives them, and ruled ones short rungs from
// side to side. Time grows with the cube of the corners, so large polygons are halved first at a
// short rung.
#include "solid/polygon_filling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "geometry/bounds.h"

namespace sherd {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();
/// Polygons of more corners are halved, where there is a rung: 80 corners take about 0.3 ms.
constexpr size_t kMostCorners = 80;
/// And of so many anyhow: these take 20 ms.
constexpr size_t kFarTooMany = 300;

class PolygonFiller {
  public:
    PolygonFiller(std::span<const PolygonCorner> corners, FillingStyle style,
                  const std::function<bool(uint32_t, uint32_t)>& allowed)
        : corners_(corners), style_(style), allowed_(allowed) {
        Bounds bounds;
        for (const PolygonCorner& corner : corners) bounds.add(corner.position);
        dear_ = std::pow(bounds.diagonal(), 4);
    }

    bool fill(const std::vector<uint32_t>& ring) {
        if (ring.size() > kMostCorners) {
            auto rung = shortRung(ring, [this](uint32_t i, uint32_t j) { return isRung(i, j); });
            if (!rung && ring.size() > kFarTooMany)
                rung = shortRung(ring, [this](uint32_t i, uint32_t j) { return isAllowed(i, j); });
            if (rung) {
                const auto [i, j] = *rung;
                std::vector<uint32_t> one(ring.begin() + i, ring.begin() + j + 1);
                std::vector<uint32_t> other(ring.begin() + j, ring.end());
                other.insert(other.end(), ring.begin(), ring.begin() + i + 1);
                return fill(one) && fill(other);
            }
        }
        return fillSmall(ring);
    }

    std::vector<std::array<uint32_t, 3>> take() { return std::move(triangles_); }

  private:
    const glm::dvec3& at(uint32_t corner) const { return corners_[corner].position; }

    /// Whether the way from i to j starts inwards, at an angle with this sine at least.
    bool isSteep(uint32_t i, uint32_t j, double sine) const {
        const glm::dvec3& inwards = corners_[i].inwards;
        const glm::dvec3 along = at(j) - at(i);
        return inwards == glm::dvec3(0.0) || glm::dot(along, inwards) > sine * glm::length(along);
    }
    bool isAllowed(uint32_t i, uint32_t j) const {
        return allowed_(std::min(i, j), std::max(i, j));
    }

    /// The shortest way from side to side that leaves a quarter of the corners on each side.
    template <class Accepts>
    std::optional<std::pair<size_t, size_t>> shortRung(const std::vector<uint32_t>& ring,
                                                       const Accepts& accepts) const {
        const size_t n = ring.size();
        std::optional<std::pair<size_t, size_t>> best;
        double least = kImpossible;
        for (size_t i = 0; i < n; ++i) {
            for (size_t j = i + n / 4; j < n && j - i <= n - n / 4; ++j) {
                const double length = glm::distance(at(ring[i]), at(ring[j]));
                if (!(length < least) || !accepts(ring[i], ring[j])) continue;
                least = length;
                best = {i, j};
            }
        }
        return best;
    }
    bool isRung(uint32_t i, uint32_t j) const {
        constexpr double kSteep = 0.3;
        return corners_[i].side != corners_[j].side && isSteep(i, j, kSteep) &&
               isSteep(j, i, kSteep) && isAllowed(i, j);
    }

    double weight(uint32_t i, uint32_t k, uint32_t j) const {
        const glm::dvec3 a = at(k) - at(i);
        const glm::dvec3 b = at(j) - at(k);
        const glm::dvec3 c = at(i) - at(j);
        const glm::dvec3 normal = glm::cross(a, b);
        const double area = glm::length(normal);
        const double sum = area * (glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c));
        const bool isDear = style_ == FillingStyle::ruled ? corners_[i].side == corners_[k].side &&
                                                                corners_[k].side == corners_[j].side
                                                          : hugs(normal, area, {i, k, j});
        return isDear ? sum + dear_ : sum;
    }

    /// Whether a triangle lies in the surface rather than leads away from it, as those over three
    /// corners of a jagged line do.
    bool hugs(const glm::dvec3& normal, double length, const std::array<uint32_t, 3>& t) const {
        const double flat = style_ == FillingStyle::even ? 0.5 : 0.2;  // 60 and 78 degrees
        return std::all_of(t.begin(), t.end(), [&](uint32_t corner) {
            return std::abs(glm::dot(normal, corners_[corner].inwards)) > flat * length;
        });
    }

    bool fillSmall(const std::vector<uint32_t>& ring) {
        const size_t n = ring.size();
        if (n < 3) return true;
        std::vector<double> cost(n * n, 0);
        std::vector<uint32_t> middle(n * n, 0);
        for (size_t width = 2; width < n; ++width) {
            for (size_t i = 0; i + width < n; ++i) {
                const size_t j = i + width;
                double& best = cost[i * n + j];
                best = kImpossible;
                const bool isBase = width == n - 1;
                if (!isBase && !isAllowed(ring[i], ring[j])) continue;
                for (size_t k = i + 1; k < j; ++k) {
                    const double sides = cost[i * n + k] + cost[k * n + j];
                    if (!(sides < best)) continue;
                    const double sum = sides + weight(ring[i], ring[k], ring[j]);
                    if (!(sum < best)) continue;
                    best = sum;
                    middle[i * n + j] = static_cast<uint32_t>(k);
                }
            }
        }
        if (cost[n - 1] == kImpossible) return false;
        collect(ring, middle, 0, n - 1);
        return true;
    }

    void collect(const std::vector<uint32_t>& ring, const std::vector<uint32_t>& middle, size_t i,
                 size_t j) {
        if (j < i + 2) return;
        const size_t k = middle[i * ring.size() + j];
        triangles_.push_back({ring[i], ring[k], ring[j]});
        collect(ring, middle, i, k);
        collect(ring, middle, k, j);
    }

    std::span<const PolygonCorner> corners_;
    FillingStyle style_;
    const std::function<bool(uint32_t, uint32_t)>& allowed_;
    double dear_;  ///< more than all the others together
    std::vector<std::array<uint32_t, 3>> triangles_;
};

}  // namespace

std::optional<std::vector<std::array<uint32_t, 3>>> fillPolygon(
    std::span<const PolygonCorner> corners, FillingStyle style,
    const std::function<bool(uint32_t, uint32_t)>& allowed) {
    std::vector<uint32_t> ring(corners.size());
    std::iota(ring.begin(), ring.end(), 0U);
    PolygonFiller filler(corners, style, allowed);
    if (!filler.fill(ring)) return std::nullopt;
    return filler.take();
}

}  // namespace sherd
