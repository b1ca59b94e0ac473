// SPDX-License-Identifier: MIT
#include "pattern/site_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>
#include <unordered_map>

#include "geometry/dice.h"
#include "geometry/triangle.h"

namespace sherd {
namespace {

struct Candidate {
    uint32_t triangle = 0;
    glm::dvec3 weights{1, 0, 0};
    double density = 1;
    SitePoint point;
};

/// Chosen points in cells about as wide as the mean spacing: only near ones are looked at.
class Neighbourhood {
  public:
    explicit Neighbourhood(double width) : width_(std::max<int64_t>(1, std::llround(width))) {}

    void add(const SitePoint& p) { cells_[keyOf(cellOf(p))].push_back(p); }

    /// Squared distance to the nearest chosen point, at most that of the cells' width.
    double nearest(const SitePoint& p) const {
        const std::array<int64_t, 3> cell = cellOf(p);
        int64_t best = width_ * width_;
        for (int64_t x = -1; x <= 1; ++x)
            for (int64_t y = -1; y <= 1; ++y)
                for (int64_t z = -1; z <= 1; ++z) {
                    const auto found = cells_.find(keyOf({cell[0] + x, cell[1] + y, cell[2] + z}));
                    if (found == cells_.end()) continue;
                    for (const SitePoint& q : found->second)
                        best = std::min(best, squaredDistance(p, q));
                }
        return static_cast<double>(best);
    }

  private:
    std::array<int64_t, 3> cellOf(const SitePoint& p) const {
        return {p.x / width_, p.y / width_, p.z / width_};
    }
    static uint64_t keyOf(const std::array<int64_t, 3>& c) {
        // Cells are fewer than 2^21 a side unless a width is below 32 steps, where sharing a key
        // only costs time.
        const auto part = [](int64_t x) { return static_cast<uint64_t>(x + 1) & 0x1FFFFF; };
        return part(c[0]) | part(c[1]) << 21 | part(c[2]) << 42;
    }

    int64_t width_;
    std::unordered_map<uint64_t, std::vector<SitePoint>> cells_;
};

class Sampler {
  public:
    Sampler(const SplitSurface& surface, std::span<const uint32_t> triangles, const SiteGrid& grid,
            const SamplingOptions& options)
        : surface_(surface),
          triangles_(triangles),
          grid_(grid),
          options_(options),
          dice_(options.seed) {
        double sum = 0;
        for (const uint32_t t : triangles)
            sums_.push_back(sum += triangleArea(surface.positions, surface.triangles[t].v));
    }

    std::vector<SitePoint> run(uint32_t count) {
        const auto candidates = static_cast<int>(std::lround(1 + 15 * (1 - options_.jitter)));
        Neighbourhood near(2 * spacing(count));
        std::set<std::tuple<int64_t, int64_t, int64_t>> taken;
        std::vector<SitePoint> sites;
        // A surface smaller than the grid's steps has not enough different points.
        for (int misses = 0; sites.size() < count && misses < 1000;) {
            Candidate best;
            double farthest = -1;
            for (int c = 0; c < candidates; ++c) {
                const Candidate candidate = throwOne();
                const double distance = near.nearest(candidate.point) * candidate.density;
                if (distance <= farthest) continue;
                farthest = distance;
                best = candidate;
            }
            if (farthest < 0 || !taken.insert({best.point.x, best.point.y, best.point.z}).second) {
                ++misses;
                continue;
            }
            misses = 0;
            near.add(best.point);
            sites.push_back(best.point);
        }
        return sites;
    }

  private:
    /// The mean distance of neighbours in steps of the grid, from the size of what they cover.
    double spacing(uint32_t count) const {
        double area = 0;
        for (const uint32_t t : triangles_) {
            std::array<glm::dvec3, 3> p{};
            for (size_t k = 0; k < 3; ++k) {
                const SitePoint s = grid_.snap(surface_.positions[surface_.triangles[t].v[k]]);
                p[k] = glm::dvec3(static_cast<double>(s.x), static_cast<double>(s.y),
                                  static_cast<double>(s.z));
            }
            area += glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / 2;
        }
        return std::sqrt(area / count);
    }

    /// A point anywhere on the surface; where few are wanted most throws are void.
    Candidate throwOne() {
        constexpr int kThrows = 64;
        Candidate candidate;
        for (int i = 0; i < kThrows; ++i) {
            const double at = dice_.unit() * sums_.back();
            const auto found = std::upper_bound(sums_.begin(), sums_.end(), at);
            const auto index =
                std::min(static_cast<size_t>(found - sums_.begin()), sums_.size() - 1);
            candidate.triangle = triangles_[index];
            const double u = std::sqrt(dice_.unit());
            const double v = dice_.unit();
            candidate.weights = {1 - u, u * (1 - v), u * v};
            if (!options_.density) break;
            candidate.density = options_.density(candidate.triangle, candidate.weights);
            if (dice_.unit() < candidate.density) break;
        }
        candidate.point = grid_.snap(pointOn(surface_, candidate.triangle, candidate.weights));
        return candidate;
    }

    const SplitSurface& surface_;
    std::span<const uint32_t> triangles_;
    const SiteGrid& grid_;
    const SamplingOptions& options_;
    Dice dice_;
    std::vector<double> sums_;  ///< of areas
};

}  // namespace

std::vector<SitePoint> sampleSites(const SplitSurface& surface, std::span<const uint32_t> triangles,
                                   uint32_t count, const SiteGrid& grid,
                                   const SamplingOptions& options) {
    if (triangles.empty()) return {};
    return Sampler(surface, triangles, grid, options).run(count);
}

std::vector<double> weightedAreas(const SplitSurface& surface, std::span<const uint32_t> triangles,
                                  const Density& density) {
    std::vector<double> areas;
    areas.reserve(triangles.size());
    for (const uint32_t t : triangles) {
        const double area = triangleArea(surface.positions, surface.triangles[t].v);
        areas.push_back(density ? area * density(t, glm::dvec3(1.0 / 3)) : area);
    }
    return areas;
}

}  // namespace sherd
