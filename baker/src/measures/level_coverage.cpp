// SPDX-License-Identifier: MIT
// One exact ray for each point: every triangle that it meets is told to the fragments that show it,
// on all levels at once.
#include "measures/level_coverage.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <mutex>
#include <random>

#include "geometry/bounds.h"
#include "geometry/morton_order.h"
#include "geometry/ray_crossing.h"
#include "geometry/triangle_bvh.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

constexpr size_t kPointsPerRun = 2048;

/// Points inside the object, evenly over its volume. Gives up, with fewer, on an object that fills
/// less than a thousandth of its box.
std::vector<glm::vec3> pointsInside(const OriginalSolid& solid, const Bounds& box,
                                    const LevelCoverageOptions& options) {
    std::mt19937 engine(options.seed);
    const auto unit = [&engine] { return engine() / 4294967296.0; };
    std::vector<glm::vec3> points;
    std::vector<glm::vec3> tried(4096);
    std::vector<uint8_t> inside(tried.size());
    const uint64_t tries = uint64_t{1000} * options.points;
    for (uint64_t done = 0; done < tries && points.size() < options.points; done += tried.size()) {
        for (glm::vec3& p : tried) {
            const double x = unit(), y = unit(), z = unit();  // in a fixed order
            p = glm::vec3(box.low + box.size() * glm::dvec3(x, y, z));
        }
        parallelRuns(tried.size(), tried.size() / 16, options.threads,
                     [&](size_t first, size_t last) {
                         for (size_t i = first; i < last; ++i)
                             inside[i] = solid.inside.inside(glm::dvec3(tried[i])) ? 1 : 0;
                     });
        for (size_t i = 0; i < tried.size() && points.size() < options.points; ++i)
            if (inside[i] != 0) points.push_back(tried[i]);
    }
    return points;
}

/// Judges points one by one and keeps count.
class PointJudge {
  public:
    PointJudge(const ShownTriangles& shown, const BoxTree& tree, int axis, double skin)
        : shown_(shown), tree_(tree), axis_(axis), skin_(skin) {
        counts_.levels.resize(shown.set().levels.size());
        counts_.fragments.resize(shown.set().fragments.size());
        holders_.resize(counts_.levels.size());
    }

    void judge(const glm::dvec3& point) {
        findCrossings(point);
        bool clear = true;
        for (uint32_t level = 0; level < holders_.size(); ++level) {
            fillHolders(level);
            clear = clear && holders_[level].size() == 1;
        }
        // Only points that would be held against a fragment are worth the look.
        if (!clear && nearFace(point)) return;
        for (uint32_t level = 0; level < holders_.size(); ++level) count(level);
    }

    const LevelCoverage& counts() const { return counts_; }

  private:
    glm::vec3 turned(const glm::vec3& p) const {
        return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3], p[axis_]};
    }

    /// The triangles that the ray from the point along the axis meets.
    void findCrossings(const glm::dvec3& point) {
        crossings_.clear();
        const int x = (axis_ + 1) % 3, y = (axis_ + 2) % 3;
        const glm::dvec3 q(point[x], point[y], point[axis_]);
        const std::vector<glm::vec3>& positions = shown_.set().geometry.positions;
        const auto wants = [&](const FloatBox& box) {
            return (static_cast<int>(box.low[x] <= q.x) & static_cast<int>(q.x <= box.high[x]) &
                    static_cast<int>(box.low[y] <= q.y) & static_cast<int>(q.y <= box.high[y]) &
                    static_cast<int>(q.z <= box.high[axis_])) != 0;
        };
        tree_.any(wants, [&](uint32_t triangle) {
            const auto& v = shown_.triangles()[triangle].v;
            const std::array<glm::vec3, 3> corners = {
                turned(positions[v[0]]), turned(positions[v[1]]), turned(positions[v[2]])};
            const int turn = lineCrossing(corners, q);
            if (turn != 0 && liesAbove(corners, q, turn)) crossings_.push_back({triangle, turn});
            return false;
        });
    }

    /// The fragments of the level whose faces wind around the point.
    void fillHolders(uint32_t level) {
        met_.clear();
        for (const Crossing& c : crossings_) {
            const ShownTriangles::Triangle& t = shown_.triangles()[c.triangle];
            const uint32_t f = shown_.fragmentAt(level, t.leaf);
            if (t.exposedFrom <= shown_.levelOf(f)) met_.push_back({f, c.sign});
        }
        std::sort(met_.begin(), met_.end(),
                  [](const Met& a, const Met& b) { return a.fragment < b.fragment; });
        holders_[level].clear();
        for (size_t i = 0; i < met_.size();) {
            const uint32_t f = met_[i].fragment;
            int winding = 0;
            for (; i < met_.size() && met_[i].fragment == f; ++i) winding += met_[i].sign;
            if (winding >= 1) holders_[level].push_back(f);
        }
    }

    void count(uint32_t level) {
        const bool several = holders_[level].size() > 1;
        LevelCoverage::Level& entry = counts_.levels[level];
        ++entry.points;
        entry.none += holders_[level].empty() ? 1 : 0;
        entry.several += several ? 1 : 0;
        for (const uint32_t f : holders_[level]) {
            if (shown_.levelOf(f) != level) continue;  // counted where it appears
            ++counts_.fragments[f].points;
            counts_.fragments[f].shared += several ? 1 : 0;
        }
    }

    bool nearFace(const glm::dvec3& point) const {
        const auto within = [&](const FloatBox& box) {
            for (int k = 0; k < 3; ++k)
                if (point[k] < box.low[k] - skin_ || point[k] > box.high[k] + skin_) return false;
            return true;
        };
        return tree_.any(within, [&](uint32_t triangle) {
            const auto p = shown_.places(triangle);
            const glm::dvec3 d = closestOnTriangle(point, p[0], p[1], p[2]) - point;
            return glm::dot(d, d) <= skin_ * skin_;
        });
    }

    struct Crossing {
        uint32_t triangle;
        int sign;  ///< +1: the ray leaves through it
    };
    struct Met {
        uint32_t fragment;
        int sign;
    };
    const ShownTriangles& shown_;
    const BoxTree& tree_;
    int axis_;  ///< of the rays
    double skin_;
    LevelCoverage counts_;
    std::vector<Crossing> crossings_;
    std::vector<Met> met_;
    std::vector<std::vector<uint32_t>> holders_;  ///< per level
};

void add(const LevelCoverage& part, LevelCoverage& whole) {
    for (size_t k = 0; k < whole.levels.size(); ++k) {
        whole.levels[k].points += part.levels[k].points;
        whole.levels[k].none += part.levels[k].none;
        whole.levels[k].several += part.levels[k].several;
    }
    for (size_t f = 0; f < whole.fragments.size(); ++f) {
        whole.fragments[f].points += part.fragments[f].points;
        whole.fragments[f].shared += part.fragments[f].shared;
    }
}

}  // namespace

LevelCoverage levelCoverage(const ShownTriangles& shown, const BoxTree& tree,
                            const OriginalSolid& solid, const LevelCoverageOptions& options) {
    LevelCoverage coverage;
    coverage.levels.resize(shown.set().levels.size());
    coverage.fragments.resize(shown.set().fragments.size());
    const Bounds box = boundsOf(solid.positions, solid.triangles);
    if (!(box.diagonal() > 0)) return coverage;
    const std::vector<glm::vec3> points = pointsInside(solid, box, options);
    // Rays beside each other meet the same triangles.
    const std::vector<uint32_t> order = mortonOrder(points).items;
    // Along the shortest side they cross the fewest.
    const glm::dvec3 size = box.size();
    const int axis = size.x <= size.y && size.x <= size.z ? 0 : (size.y <= size.z ? 1 : 2);
    std::mutex mutex;
    parallelRuns(points.size(), kPointsPerRun, options.threads, [&](size_t first, size_t last) {
        PointJudge judge(shown, tree, axis, options.skin * box.diagonal());
        for (size_t i = first; i < last; ++i) judge.judge(points[order[i]]);
        const std::scoped_lock lock(mutex);
        add(judge.counts(), coverage);
    });
    return coverage;
}

}  // namespace sherd
