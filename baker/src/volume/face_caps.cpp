// SPDX-License-Identifier: MIT
#include "volume/face_caps.h"

#include <algorithm>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "geometry/constrained_triangulation.h"
#include "volume/border_crossings.h"
#include "volume/cap_plane.h"

namespace sherd {
namespace {

constexpr uint32_t kCorners = 3;  ///< points 0 to 2 are those of a triangle around everything

using Triangles = std::vector<CapTriangle>;

}  // namespace

class CapBuilder::Work {
  public:
    Work(CutVertices& vertices, UnionFind& merged) : vertices_(vertices), merged_(merged) {}

    void build(uint32_t i, uint32_t j, std::span<const CapEdge> border, Triangles& triangles,
               CapReport& report) {
        i_ = i;
        j_ = j;
        merged_.grow(vertices_.count());
        begin(border);
        // Points in one place and crossings are put right, then it is done again: each round has
        // fewer points, or no more crossings.
        bool crossed = false, split = false;
        while (!segments_.empty() && !triangulate()) {
            if (!result().same.empty()) {
                unite();
                begin(border);
                split = false;
            } else if (!split && splitAtCrossings()) {
                crossed = split = true;
            } else {
                begin(border);
                addFan();
                ++report.fans;
                break;
            }
        }
        report.crossed += crossed ? 1 : 0;
        for (const auto& [v, layer] : made_)
            triangles.push_back({{vertex(v[0]), vertex(v[1]), vertex(v[2])}, layer});
    }

  private:
    const TriangulationResult& result() const { return *result_; }
    uint32_t vertex(uint32_t point) const { return vertexOf_[point - kCorners]; }

    void begin(std::span<const CapEdge> border) {
        made_.clear();
        collectPoints(border);
        collectSegments(border);
    }

    void collectPoints(std::span<const CapEdge> border) {
        vertexOf_.clear();
        for (const CapEdge& e : border) {
            const uint32_t from = merged_.find(e.from), to = merged_.find(e.to);
            if (from != to) vertexOf_.insert(vertexOf_.end(), {from, to});
        }
        std::sort(vertexOf_.begin(), vertexOf_.end());
        vertexOf_.erase(std::unique(vertexOf_.begin(), vertexOf_.end()), vertexOf_.end());
        plane_.start(vertices_, i_, j_);
        constexpr int64_t kFar = int64_t{1} << 27;  // everything is within 2^25 of the middle
        plane_.addFarAway(-kFar, -kFar);
        plane_.addFarAway(3 * kFar, -kFar);
        plane_.addFarAway(-kFar, 3 * kFar);
        for (const uint32_t v : vertexOf_) plane_.add(v);
    }

    uint32_t pointOf(uint32_t v) {
        const auto it = std::lower_bound(vertexOf_.begin(), vertexOf_.end(), merged_.find(v));
        return kCorners + static_cast<uint32_t>(it - vertexOf_.begin());
    }

    void collectSegments(std::span<const CapEdge> border) {
        segments_.clear();
        for (const CapEdge& e : border) {
            if (merged_.find(e.from) == merged_.find(e.to)) continue;
            const uint32_t a = pointOf(e.from), b = pointOf(e.to);
            segments_.push_back(
                {std::min(a, b), std::max(a, b), a < b ? e.times : -e.times, e.triangle});
        }
        addUp();
    }

    /// Segments between the same points become one; those that cancel are gone.
    void addUp() {
        std::sort(segments_.begin(), segments_.end(),
                  [](const BorderSegment& s, const BorderSegment& t) {
                      return std::tie(s.a, s.b, s.triangle) < std::tie(t.a, t.b, t.triangle);
                  });
        size_t kept = 0;
        for (size_t n = 0; n < segments_.size();) {
            BorderSegment sum = segments_[n++];
            while (n < segments_.size() && segments_[n].a == sum.a && segments_[n].b == sum.b)
                sum.times += segments_[n++].times;
            if (sum.times != 0) segments_[kept++] = sum;
        }
        segments_.resize(kept);
    }

    /// Fills `made_`, or says what is wrong in `result()`.
    bool triangulate() {
        const auto count = static_cast<uint32_t>(kCorners + vertexOf_.size());
        input_.points.resize(count);
        input_.shape.resize(count);
        for (uint32_t p = 0; p < count; ++p) {
            const glm::dvec2& place = plane_.place(p);
            input_.points[p].ax = place.x;
            input_.points[p].ay = place.y;
            input_.shape[p] = plane_.unprojected(place);
        }
        input_.turn = [this](uint32_t a, uint32_t b, uint32_t c) { return plane_.turn(a, b, c); };
        input_.constraints.clear();
        for (uint32_t s = 0; s < segments_.size(); ++s)
            input_.constraints.push_back({segments_[s].a, segments_[s].b, s + 1});
        result_ = &triangulation_.run(input_);
        if (!result_->same.empty() || !result_->valid) return false;
        sewPassages();
        return spreadWindings();
    }

    void unite() {
        for (const auto& [later, earlier] : result().same)
            merged_.unite(vertex(later), vertex(earlier));
    }

    /// Where the border runs through a point between the ends of a segment, the cap has two edges
    /// and the rest of the piece one: a flat triangle joins them.
    void sew(uint32_t a, uint32_t through, uint32_t b, int times) {
        for (int n = 0; n < std::abs(times); ++n) {
            if (times > 0)
                made_.push_back({{a, b, through}, 0});
            else
                made_.push_back({{b, a, through}, 0});
        }
    }

    /// Segments cut at the points they run through.
    void sewPassages() {
        if (result().passages.empty()) return;
        std::vector<TriangulationResult::Passage> passages = result().passages;
        std::stable_sort(passages.begin(), passages.end(),
                         [](const auto& p, const auto& q) { return p.constraint < q.constraint; });
        for (const auto& [segment, through] : passages) splitSegment(segment, through);
        turnUp();
    }

    /// What is left of the segment goes on from the point; its first part becomes another.
    void splitSegment(uint32_t index, uint32_t through) {
        const BorderSegment whole = segments_[index];
        sew(whole.a, through, whole.b, whole.times);
        segments_.push_back({whole.a, through, whole.times, whole.triangle});
        segments_[index].a = through;
    }

    /// After splits: every segment from its lower point to its higher, and all added up again.
    void turnUp() {
        for (BorderSegment& s : segments_) {
            if (s.a < s.b) continue;
            std::swap(s.a, s.b);
            s.times = -s.times;
        }
        addUp();
    }

    /// The net use of an edge of the triangulation in that direction.
    int timesOf(uint32_t from, uint32_t to) const {
        const uint32_t a = std::min(from, to), b = std::max(from, to);
        const auto it = std::lower_bound(
            segments_.begin(), segments_.end(), std::pair(a, b),
            [](const BorderSegment& s, const auto& key) { return std::pair(s.a, s.b) < key; });
        if (it == segments_.end() || it->a != a || it->b != b) return 0;
        return from == a ? it->times : -it->times;
    }

    /// Winding numbers from the outside in, and the triangles where they are not 0.
    bool spreadWindings() {
        const auto& triangles = result().triangles;
        constexpr int kUnknown = INT32_MIN;
        windings_.assign(triangles.size(), kUnknown);
        open_.clear();
        for (uint32_t t = 0; t < triangles.size(); ++t) {
            const auto& v = triangles[t].v;
            if (*std::min_element(v.begin(), v.end()) >= kCorners) continue;
            windings_[t] = 0;
            open_.push_back(t);
        }
        while (!open_.empty()) {
            const uint32_t t = open_.back();
            open_.pop_back();
            for (size_t k = 0; k < 3; ++k) {
                const auto& tri = triangles[t];
                const uint32_t n = tri.neighbor[k];
                if (n == TriangulationResult::kNone) continue;
                const int step = tri.mark[k] == 0 ? 0 : timesOf(tri.v[k], tri.v[(k + 1) % 3]);
                const int there = windings_[t] - step;
                if (windings_[n] == kUnknown) {
                    windings_[n] = there;
                    open_.push_back(n);
                } else if (windings_[n] != there) {
                    return false;  // the border does not close: no cap of ours
                }
            }
        }
        for (size_t t = 0; t < triangles.size(); ++t) {
            const auto& [a, b, c] = triangles[t].v;
            for (int n = 0; n < std::abs(windings_[t]); ++n) {
                if (windings_[t] > 0)
                    made_.push_back({{a, b, c}, n + 1});
                else
                    made_.push_back({{c, b, a}, -n - 1});
            }
        }
        return true;
    }

    /// New points where the border crosses itself. Whether there are any.
    bool splitAtCrossings() {
        std::vector<std::vector<uint32_t>> through(segments_.size());
        for (const auto& [s, t] : borderCrossings(segments_, plane_)) {
            if (segments_[s].triangle == CapEdge::kNone || segments_[t].triangle == CapEdge::kNone)
                return false;
            const uint32_t v =
                vertices_.atCrossing(segments_[s].triangle, segments_[t].triangle, i_, j_);
            if (v == CutVertices::kNone) return false;
            merged_.grow(vertices_.count());
            const uint32_t point = pointAt(merged_.find(v));
            through[s].push_back(point);
            through[t].push_back(point);
        }
        const auto before = static_cast<uint32_t>(segments_.size());
        for (uint32_t s = 0; s < before; ++s) {
            sortAlong(segments_[s], through[s]);
            for (const uint32_t point : through[s]) splitSegment(s, point);
        }
        const bool any = segments_.size() > before;
        turnUp();
        return any;
    }

    /// The point that is a vertex, a new one where there is none.
    uint32_t pointAt(uint32_t v) {
        const auto it = std::find(vertexOf_.begin(), vertexOf_.end(), v);
        if (it == vertexOf_.end()) {
            vertexOf_.push_back(v);
            plane_.add(v);
            return static_cast<uint32_t>(kCorners + vertexOf_.size()) - 1;
        }
        return static_cast<uint32_t>(kCorners + (it - vertexOf_.begin()));
    }

    void sortAlong(const BorderSegment& segment, std::vector<uint32_t>& points) const {
        const glm::dvec2 from = plane_.place(segment.a);
        std::sort(points.begin(), points.end(), [&](uint32_t p, uint32_t q) {
            const double atP = glm::distance(from, plane_.place(p));
            const double atQ = glm::distance(from, plane_.place(q));
            return atP != atQ ? atP < atQ : p < q;
        });
        points.erase(std::unique(points.begin(), points.end()), points.end());
        std::erase_if(points, [&](uint32_t p) { return p == segment.a || p == segment.b; });
    }

    /// A cone over the border: closed whatever the border is.
    void addFan() {
        const uint32_t apex = segments_[0].a;
        for (const BorderSegment& s : segments_) {
            if (s.a != apex && s.b != apex) {
                for (int n = 0; n < std::abs(s.times); ++n) {
                    if (s.times > 0)
                        made_.push_back({{apex, s.a, s.b}, 0});
                    else
                        made_.push_back({{apex, s.b, s.a}, 0});
                }
            }
        }
    }

    CutVertices& vertices_;
    UnionFind& merged_;
    uint32_t i_ = 0, j_ = 0;
    CapPlane plane_;
    std::vector<uint32_t> vertexOf_;  ///< point - kCorners: vertex; ascending but for crossings
    std::vector<BorderSegment> segments_;
    Triangles made_;  ///< of points
    TriangulationInput input_;
    ConstrainedTriangulation triangulation_;
    const TriangulationResult* result_ = nullptr;
    std::vector<int> windings_;
    std::vector<uint32_t> open_;
};

CapBuilder::CapBuilder(CutVertices& vertices, UnionFind& merged)
    : work_(std::make_unique<Work>(vertices, merged)) {}
CapBuilder::~CapBuilder() = default;

void CapBuilder::build(uint32_t i, uint32_t j, std::span<const CapEdge> border,
                       std::vector<CapTriangle>& triangles) {
    work_->build(i, j, border, triangles, report_);
}

}  // namespace sherd
