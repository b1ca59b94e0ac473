// SPDX-License-Identifier: MIT
#include "measures/collider_measures.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "geometry/bounds.h"
#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"
#include "message_text.h"
#include "parallel/parallel_for.h"
#include "physics/polytope.h"
#include "sherd/formats/hull_measures.h"

namespace sherd {
namespace {

constexpr uint32_t kFewestPoints = 64;
constexpr uint32_t kMostPoints = 512;
/// Of its convex hull that a convex fragment fills: skins are made of flat triangles, not smooth.
constexpr double kConvex = 0.95;

struct Hull {
    std::vector<glm::dvec3> points;
    double margin = 0;
    /// At most 0 inside.
    double distance(const glm::dvec3& p) const {
        return hullGap(std::span(&p, 1), points) - margin;
    }
};

/// One fragment and its collider.
class FragmentMeasurer {
  public:
    FragmentMeasurer(const FractureSet& set, uint32_t fragment)
        : set_(set),
          fragment_(fragment),
          triangles_(fragmentTriangles(set, fragment)),
          inside_(set.geometry.positions, triangles_),
          surface_(set.geometry.positions, triangles_) {
        const Range range = set.fragments[fragment].hulls;
        for (uint32_t h = range.first; h < range.first + range.count; ++h) {
            const Range points = set.hulls[h].points;
            const auto first = set.hullPoints.begin() + points.first;
            hulls_.push_back({{first, first + points.count}, double{set.hulls[h].margin}});
        }
    }

    /// Share of points spread evenly over the fragment's inside that are in its collider.
    double coverage(uint32_t points, uint32_t seed) const {
        std::mt19937 engine(seed);
        const auto unit = [&engine] { return engine() / 4294967296.0; };
        const Bounds box = boundsOf(set_.geometry.positions, triangles_);
        const double tolerance = 1e-9 * box.diagonal();
        uint32_t found = 0, covered = 0;
        const uint32_t tries = 200 * points;  // what is thinner fills its box by less than 1 in 200
        for (uint32_t i = 0; i < tries && found < points; ++i) {
            const double x = unit(), y = unit(), z = unit();  // in a fixed order
            const glm::dvec3 p = box.low + box.size() * glm::dvec3(x, y, z);
            if (!inside_.inside(p)) continue;
            ++found;
            covered += distanceTo(p) <= tolerance ? 1 : 0;
        }
        return found > 0 ? static_cast<double>(covered) / found : 0;
    }

    /// How far corners of the outer surface lie outside of the collider at most.
    double uncovered() const {
        std::vector<uint32_t> corners;
        const size_t primitives = set_.geometry.primitives.size();
        for (size_t p = 0; p < primitives; ++p) {
            if (set_.geometry.primitives[p].exposedFrom > 0) continue;
            const Range range = set_.fragmentRanges[fragment_ * primitives + p];
            const auto first = set_.geometry.indices.begin() + range.first;
            corners.insert(corners.end(), first, first + range.count);
        }
        std::sort(corners.begin(), corners.end());
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        double most = 0;
        for (const uint32_t v : corners)
            most = std::max(most, distanceTo(set_.geometry.positions[v]));
        return most;
    }

    /// How far corners, middles of edges and of faces of the hulls lie out of the fragment at most,
    /// the margin added.
    double outside() const {
        double most = 0;
        for (const Hull& hull : hulls_) {
            const Polytope body = hullOf(hull.points);
            for (const auto& f : body.faces) {
                const glm::dvec3 &a = body.points[f[0]], &b = body.points[f[1]],
                                 &c = body.points[f[2]];
                for (const glm::dvec3& p : {a, 0.5 * (a + b), (a + b + c) / 3.0})
                    most = std::max(most, heightAbove(p) + hull.margin);
            }
        }
        return most;
    }

    bool convex() const {
        std::vector<glm::dvec3> corners;
        for (const auto& t : triangles_)
            for (const uint32_t v : t) corners.emplace_back(set_.geometry.positions[v]);
        const double hull = volumeOf(hullOf(corners));
        return set_.fragments[fragment_].volume > kConvex * hull;
    }

  private:
    double distanceTo(const glm::dvec3& p) const {
        double least = std::numeric_limits<double>::infinity();
        for (const Hull& hull : hulls_) {
            least = std::min(least, hull.distance(p));
            if (least <= 0) break;
        }
        return least;
    }

    /// Above the fragment's surface; below it, negative.
    double heightAbove(const glm::dvec3& p) const {
        const double distance = std::sqrt(surface_.closest(p).distance2);
        return inside_.inside(p) ? -distance : distance;
    }

    const FractureSet& set_;
    uint32_t fragment_;
    std::vector<std::array<uint32_t, 3>> triangles_;
    InsideTest inside_;
    TriangleBvh surface_;
    std::vector<Hull> hulls_;
};

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void summarise(const FractureSet& set, BakedObjectReport& report) {
    for (uint32_t level = 0; level < report.levels.size(); ++level) {
        BakedColliders all;
        std::vector<double> coverages;
        for (const uint32_t f : fragmentsAtLevel(set, level)) {
            const BakedCollider& one = *report.fragments[f].collider;
            all.hulls += one.hulls;
            coverages.push_back(one.coverage);
            all.overlap = std::max(all.overlap, one.overlap);
            all.outside = std::max(all.outside, one.outside);
            all.uncovered = std::max(all.uncovered, one.uncovered);
        }
        all.leastCoverage =
            coverages.empty() ? 0 : *std::min_element(coverages.begin(), coverages.end());
        all.coverage = median(std::move(coverages));
        report.levels[level].colliders = all;
    }
}

/// "3, 17, 18, ..."
std::string listed(const std::vector<uint32_t>& fragments) {
    constexpr size_t kMost = 8;
    std::string list;
    for (size_t i = 0; i < std::min(fragments.size(), kMost); ++i)
        list += (i > 0 ? ", " : "") + std::to_string(fragments[i]);
    return list + (fragments.size() > kMost ? ", ..." : "");
}

void find(const char* code, const std::string& message, const std::vector<uint32_t>& fragments,
          BakedObjectReport& report) {
    if (fragments.empty()) return;
    report.findings.push_back(
        {code, message, "fragments " + listed(fragments), static_cast<uint32_t>(fragments.size())});
}

double sizeOf(const FractureSet& set, uint32_t fragment) {
    const glm::dvec3 size =
        boundsOf(set.geometry.positions, fragmentTriangles(set, fragment)).size();
    return std::max({size.x, size.y, size.z});
}

/// What colliders should hold and do not.
void judge(const FractureSet& set, uint32_t points, BakedObjectReport& report) {
    constexpr double kDeepest = 1e-5, kConvexCoverage = 0.9, kMedian = 0.7;
    constexpr double kUncovered = 2e-3, kUncoveredShare = 0.03;
    // What chance does to a share of so many points, three times over.
    const double chance = 3 * std::sqrt(kConvexCoverage * (1 - kConvexCoverage) / points);
    std::vector<uint32_t> deep, thin, bare, levels;
    for (uint32_t f = 0; f < report.fragments.size(); ++f) {
        const BakedCollider& collider = *report.fragments[f].collider;
        if (collider.overlap > kDeepest * report.diagonal) deep.push_back(f);
        if (!collider.convex) continue;
        if (collider.coverage < kConvexCoverage - chance) thin.push_back(f);
        if (collider.uncovered > std::max(kUncovered, kUncoveredShare * sizeOf(set, f)))
            bare.push_back(f);
    }
    for (uint32_t level = 1; level < report.levels.size(); ++level)
        if (report.levels[level].colliders->coverage < kMedian) levels.push_back(level);
    find("collider-overlap",
         "colliders of neighbours are inside each other by more than 1e-5 of the diagonal; they "
         "pass through each other until they are apart",
         deep, report);
    find("collider-coverage",
         "colliders hold less than 90 % of pieces that are convex; allow them more vertices", thin,
         report);
    find("collider-uncovered",
         "the surface of convex pieces reaches out of their colliders; allow them more vertices or "
         "a smaller margin",
         bare, report);
    if (levels.empty()) return;
    report.findings.push_back(
        {"collider-median",
         "half of the pieces' colliders hold less than 70 % of them; allow them more convex parts",
         "level " + listed(levels), static_cast<uint32_t>(levels.size())});
}

}  // namespace

void measureColliders(const FractureSet& set, const ColliderMeasureOptions& options,
                      BakedObjectReport& report) {
    const auto count = static_cast<uint32_t>(report.fragments.size());
    const uint32_t points =
        std::clamp(options.points / std::max(count, 1U), kFewestPoints, kMostPoints);
    parallelRuns(count, 1, options.threads, [&](size_t f, size_t) {
        const FragmentMeasurer measurer(set, static_cast<uint32_t>(f));
        BakedCollider collider;
        collider.hulls = set.fragments[f].hulls.count;
        collider.coverage = measurer.coverage(points, options.seed + static_cast<uint32_t>(f));
        collider.uncovered = measurer.uncovered();
        collider.outside = measurer.outside();
        collider.convex = measurer.convex();
        report.fragments[f].collider = collider;
    });
    for (const ColliderOverlap& overlap : colliderOverlaps(set, 0).pairs) {
        for (const uint32_t f : {overlap.a, overlap.b}) {
            double& deepest = report.fragments[f].collider->overlap;
            deepest = std::max(deepest, overlap.depth);
        }
    }
    summarise(set, report);
    judge(set, points, report);
}

}  // namespace sherd
