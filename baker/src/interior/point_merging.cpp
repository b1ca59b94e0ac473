// SPDX-License-Identifier: MIT
// Voronoi poles are shared: what faces each other across the solid gets the same few vertices.
// Balls are not, and the sheets below both sides of a piece would cross each other again and again.
//
// Measured over 17 closed models with 13 and 58 pieces, without and with merging, crossing pairs of
// triangles and % of the object in no piece: skull 53,667 -> 12,919, 1.02 -> 0.93; bunny of 100,000
// triangles 111,070 -> 17,632, 0.54 -> 0.36; barrel 14,567 -> 6,073, 1.24 -> 0.76; worst of all
// (a coarse box) 7,079 -> 4,823, 0.59 -> 0.61. Double coverage stays within 0.08. Farther (0.015 of
// the diagonal) spoils coarse boxes; merging the balls instead leaves 27,000 on the skull; leaving
// the ends of walls where they were, 45,725.
#include "interior/point_merging.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "geometry/triangle.h"

namespace sherd {
namespace {

/// Points by cubic cells of twice the `reach` of searches, which so look into eight of them.
class PointGrid {
  public:
    PointGrid(std::span<const glm::vec3> points, double reach)
        : points_(points),
          cell_(2 * reach),
          rounding_(1e-3 * reach),
          first_(std::bit_ceil(points.size() + 1), kNone),
          next_(points.size(), kNone) {}

    /// The one added that is nearest to the point and nearer than `within`, at most the reach. Of
    /// those as near but for rounding, which regular meshes have, the lowest.
    uint32_t nearest(uint32_t point, double within) const {
        double least = within;
        forEachAround(point, [&](uint32_t, double distance) { least = std::min(least, distance); });
        if (!(least < within)) return kNone;
        uint32_t best = kNone;
        forEachAround(point, [&](uint32_t i, double distance) {
            if (distance <= least + rounding_) best = std::min(best, i);
        });
        return best;
    }
    void add(uint32_t point) {
        uint32_t& first = first_[bucketOf(glm::floor(glm::dvec3(points_[point]) / cell_))];
        next_[point] = first;
        first = point;
    }

  private:
    /// visit(point added, distance) for all within the reach, and others.
    template <class Visit>
    void forEachAround(uint32_t point, const Visit& visit) const {
        const glm::dvec3 p(points_[point]);
        const glm::dvec3 low = glm::floor(p / cell_ - 0.5);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 cell = low + glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2);
            for (uint32_t i = first_[bucketOf(cell)]; i != kNone; i = next_[i])
                visit(i, glm::distance(glm::dvec3(points_[i]), p));
        }
    }
    /// Cells that share a bucket cost time only.
    size_t bucketOf(const glm::dvec3& cell) const {
        uint64_t h = 0;
        for (int k = 0; k < 3; ++k) {
            h = (h ^ std::bit_cast<uint64_t>(cell[k] + 0.0)) * 0x9E3779B97F4A7C15ULL;
            h ^= h >> 32;
        }
        return h & (first_.size() - 1);
    }

    std::span<const glm::vec3> points_;
    double cell_;
    double rounding_;              ///< of distances
    std::vector<uint32_t> first_;  ///< per bucket
    std::vector<uint32_t> next_;   ///< in the same bucket
};

double meanEdge(const HiddenSheet& sheet) {
    double sum = 0;
    for (const HiddenSheet::Triangle& t : sheet.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec3 a(sheet.feet[t.v[k]]), b(sheet.feet[t.v[(k + 1) % 3]]);
            sum += glm::distance(a, b);
        }
    }
    return sum / static_cast<double>(std::max<size_t>(1, 3 * sheet.triangles.size()));
}

}  // namespace

std::vector<uint8_t> onBorders(const MeshTopology& topology, const Components& components,
                               const HiddenSheet& sheet) {
    std::vector<uint8_t> result(sheet.points.size(), 0);
    for (const HiddenSheet::Triangle& t : sheet.triangles) {
        for (uint32_t k = 0; k < 3; ++k) {
            if (t.along[k] == kNone) continue;
            const uint32_t o = topology.opposite[t.along[k]];
            if (o != kNone && components.leaf[o / 3] == components.leaf[t.parent]) continue;
            result[t.v[k]] = result[t.v[nextCorner(k)]] = 1;
        }
    }
    return result;
}

void mergeNearPoints(double farthest, std::span<const uint8_t> first, HiddenSheet& sheet) {
    const double reach = std::min(farthest, 2 * meanEdge(sheet));
    if (!(reach > 0)) return;
    const std::vector<glm::vec3> before(sheet.points);
    PointGrid kept(before, reach);
    for (const uint8_t turn : {1, 0}) {
        for (uint32_t v = 0; v + sheet.hubs < before.size(); ++v) {
            if ((first.empty() ? 0 : first[v]) != turn) continue;
            const double depth = glm::distance(glm::dvec3(before[v]), glm::dvec3(sheet.feet[v]));
            // Not the depth itself: at creases it is the way to the next point, but for rounding.
            const uint32_t other = kept.nearest(v, std::min(reach, 0.99 * depth));
            if (other == kNone)
                kept.add(v);
            else
                sheet.points[v] = before[other];
        }
    }
}

}  // namespace sherd
