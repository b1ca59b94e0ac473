// SPDX-License-Identifier: MIT
#include "volume/face_caps.h"

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/constrained_triangulation.h"
#include "volume/border_crossings.h"

namespace sherd {

class CapBuilder::Work {
  public:
    Work(CapSpace& vertices, UnionFind& merged)
        : vertices_(vertices), merged_(merged), border_(vertices, merged) {}

    void build(uint32_t i, uint32_t j, std::span<const CapEdge> edges,
               std::vector<CapTriangle>& triangles, CapReport& report) {
        merged_.grow(vertices_.count());
        border_.start(i, j, edges);
        made_.clear();
        // Points in one place and crossings are put right, then it is done again: each round has
        // fewer points, or no more crossings.
        bool crossed = false, split = false;
        while (!border_.segments().empty() && !triangulate()) {
            if (!result_->same.empty()) {
                unite();
                border_.start(i, j, edges);
                split = false;
            } else if (!split && splitAtCrossings(i, j)) {
                crossed = split = true;
            } else {
                border_.start(i, j, edges);
                addFan();
                ++report.fans;
                break;
            }
        }
        report.crossed += crossed ? 1 : 0;
        for (const auto& [a, b, c] : border_.sewn()) made_.push_back({{a, b, c}, 0});
        for (const auto& [v, layer] : made_) {
            triangles.push_back(
                {{border_.vertex(v[0]), border_.vertex(v[1]), border_.vertex(v[2])}, layer});
        }
    }

  private:
    /// Fills `made_`, or `result_` says what is wrong.
    bool triangulate() {
        CapPlane& plane = border_.plane();
        input_.points.resize(border_.points());
        input_.shape.resize(border_.points());
        for (uint32_t p = 0; p < border_.points(); ++p) {
            const glm::dvec2& place = plane.place(p);
            input_.points[p].ax = place.x;
            input_.points[p].ay = place.y;
            input_.shape[p] = plane.unprojected(place);
        }
        input_.turn = [&plane](uint32_t a, uint32_t b, uint32_t c) { return plane.turn(a, b, c); };
        input_.constraints.clear();
        for (const BorderSegment& s : border_.segments())
            input_.constraints.push_back({s.a, s.b, 1});
        result_ = &triangulation_.run(input_);
        if (!result_->same.empty() || !result_->valid) return false;
        splitAtPassages();
        if (!spreadWindings()) return false;
        takeTriangles();
        return true;
    }

    void unite() {
        for (const auto& [later, earlier] : result_->same)
            merged_.unite(border_.vertex(later), border_.vertex(earlier));
    }

    /// Segments that run through points between their ends.
    void splitAtPassages() {
        if (result_->passages.empty()) return;
        std::vector<TriangulationResult::Passage> passages = result_->passages;
        std::stable_sort(passages.begin(), passages.end(),
                         [](const auto& p, const auto& q) { return p.constraint < q.constraint; });
        for (const auto& [segment, through] : passages) border_.split(segment, through);
        border_.settle();
    }

    /// Winding numbers from the outside in. False: the border does not close, so it is no cap's.
    bool spreadWindings() {
        const auto& triangles = result_->triangles;
        constexpr int kUnknown = std::numeric_limits<int>::min();
        windings_.assign(triangles.size(), kUnknown);
        open_.clear();
        for (uint32_t t = 0; t < triangles.size(); ++t) {
            const auto& v = triangles[t].v;
            if (*std::min_element(v.begin(), v.end()) >= CapBorder::kCorners) continue;
            windings_[t] = 0;
            open_.push_back(t);
        }
        while (!open_.empty()) {
            const uint32_t t = open_.back();
            open_.pop_back();
            const TriangulationResult::Triangle& tri = triangles[t];
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t n = tri.neighbor[k];
                if (n == TriangulationResult::kNone) continue;
                const int step =
                    tri.mark[k] == 0 ? 0 : border_.timesOf(tri.v[k], tri.v[(k + 1) % 3]);
                const int there = windings_[t] - step;
                if (windings_[n] == kUnknown) {
                    windings_[n] = there;
                    open_.push_back(n);
                } else if (windings_[n] != there) {
                    return false;
                }
            }
        }
        return true;
    }

    void takeTriangles() {
        for (size_t t = 0; t < windings_.size(); ++t) {
            const auto& [a, b, c] = result_->triangles[t].v;
            for (int n = 1; n <= windings_[t]; ++n) made_.push_back({{a, b, c}, n});
            for (int n = -1; n >= windings_[t]; --n) made_.push_back({{c, b, a}, n});
        }
    }

    /// New points where the border crosses itself. Whether there are any.
    bool splitAtCrossings(uint32_t i, uint32_t j) {
        const std::vector<BorderSegment> segments = border_.segments();
        std::vector<std::vector<uint32_t>> through(segments.size());
        for (const auto& [s, t] : borderCrossings(segments, border_.plane())) {
            if (segments[s].triangle == CapEdge::kNone || segments[t].triangle == CapEdge::kNone)
                return false;
            const uint32_t v =
                vertices_.atCrossing(segments[s].triangle, segments[t].triangle, i, j);
            if (v == CapSpace::kNone) return false;
            merged_.grow(vertices_.count());
            const uint32_t point = border_.pointAt(merged_.find(v));
            through[s].push_back(point);
            through[t].push_back(point);
        }
        bool any = false;
        for (uint32_t s = 0; s < segments.size(); ++s) {
            sortAlong(segments[s], through[s]);
            for (const uint32_t point : through[s]) border_.split(s, point);
            any = any || !through[s].empty();
        }
        border_.settle();
        return any;
    }

    void sortAlong(const BorderSegment& segment, std::vector<uint32_t>& points) {
        const CapPlane& plane = border_.plane();
        const glm::dvec2 from = plane.place(segment.a);
        std::sort(points.begin(), points.end(), [&](uint32_t p, uint32_t q) {
            const double atP = glm::distance(from, plane.place(p));
            const double atQ = glm::distance(from, plane.place(q));
            return atP != atQ ? atP < atQ : p < q;
        });
        points.erase(std::unique(points.begin(), points.end()), points.end());
        std::erase_if(points, [&](uint32_t p) { return p == segment.a || p == segment.b; });
    }

    /// A cone over the border: closed whatever the border is.
    void addFan() {
        made_.clear();
        const uint32_t apex = border_.segments()[0].a;
        for (const BorderSegment& s : border_.segments()) {
            if (s.a == apex || s.b == apex) continue;
            for (int n = 0; n < s.times; ++n) made_.push_back({{apex, s.a, s.b}, 0});
            for (int n = 0; n > s.times; --n) made_.push_back({{apex, s.b, s.a}, 0});
        }
    }

    CapSpace& vertices_;
    UnionFind& merged_;
    CapBorder border_;
    std::vector<CapTriangle> made_;  ///< of points
    TriangulationInput input_;
    ConstrainedTriangulation triangulation_;
    const TriangulationResult* result_ = nullptr;
    std::vector<int> windings_;
    std::vector<uint32_t> open_;
};

CapBuilder::CapBuilder(CapSpace& vertices, UnionFind& merged)
    : work_(std::make_unique<Work>(vertices, merged)) {}
CapBuilder::~CapBuilder() = default;

void CapBuilder::build(uint32_t i, uint32_t j, std::span<const CapEdge> border,
                       std::vector<CapTriangle>& triangles) {
    work_->build(i, j, border, triangles, report_);
}

}  // namespace sherd
