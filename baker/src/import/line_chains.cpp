// SPDX-License-Identifier: MIT
// Modelling tools write lines as pairs of points. Reports that speak of lines need the runs that
// the artist sees, so the graph of segments is walked from every end or branch to the next; what is
// left then has degree 2 throughout and is walked as loops.
#include "import/line_chains.h"

#include <algorithm>
#include <numeric>

#include "geometry/weld.h"

namespace sherd {
namespace {

using Edge = std::array<uint32_t, 2>;

/// Ascending ends, each segment once, in order of first appearance.
std::vector<Edge> distinctEdges(const LineSegments& segments, const std::vector<uint32_t>& welded,
                                LineChains& out) {
    std::vector<Edge> edges;
    edges.reserve(segments.ends.size());
    for (const Edge& ends : segments.ends) {
        const uint32_t a = welded[ends[0]];
        const uint32_t b = welded[ends[1]];
        if (a == b) {
            ++out.withoutLength;
        } else {
            edges.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    std::vector<uint32_t> order(edges.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t x, uint32_t y) { return edges[x] < edges[y]; });
    std::vector<bool> repeats(edges.size(), false);
    for (size_t i = 1; i < order.size(); ++i) {
        repeats[order[i]] = edges[order[i]] == edges[order[i - 1]];
    }
    size_t kept = 0;
    for (size_t i = 0; i < edges.size(); ++i) {
        if (!repeats[i]) edges[kept++] = edges[i];
    }
    out.repeated = edges.size() - kept;
    edges.resize(kept);
    return edges;
}

class ChainWalker {
  public:
    ChainWalker(size_t pointCount, const std::vector<Edge>& edges)
        : edges_(edges), first_(pointCount + 1, 0), used_(edges.size(), false) {
        for (const Edge& edge : edges) {
            for (const uint32_t p : edge) ++first_[p + 1];
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        incident_.resize(first_.back());
        std::vector<size_t> next(first_.begin(), first_.end() - 1);
        for (uint32_t e = 0; e < edges.size(); ++e) {
            for (const uint32_t p : edges[e]) incident_[next[p]++] = e;
        }
    }

    std::vector<std::vector<uint32_t>> walk() {
        std::vector<std::vector<uint32_t>> chains;
        const auto points = static_cast<uint32_t>(first_.size() - 1);
        for (const bool loops : {false, true}) {
            for (uint32_t p = 0; p < points; ++p) {
                if (!loops && degree(p) == 2) continue;
                for (size_t i = first_[p]; i < first_[p + 1]; ++i) {
                    if (!used_[incident_[i]]) chains.push_back(chainFrom(p, incident_[i]));
                }
            }
        }
        return chains;
    }

  private:
    size_t degree(uint32_t point) const { return first_[point + 1] - first_[point]; }

    std::vector<uint32_t> chainFrom(uint32_t start, uint32_t edge) {
        std::vector<uint32_t> chain{start};
        for (uint32_t p = start;;) {
            used_[edge] = true;
            p = edges_[edge][0] == p ? edges_[edge][1] : edges_[edge][0];
            chain.push_back(p);
            if (degree(p) != 2 || p == start) return chain;
            const uint32_t one = incident_[first_[p]];
            edge = one == edge ? incident_[first_[p] + 1] : one;
        }
    }

    const std::vector<Edge>& edges_;
    std::vector<size_t> first_;       ///< per point: into incident_
    std::vector<uint32_t> incident_;  ///< edges around each point
    std::vector<bool> used_;
};

}  // namespace

LineChains chainSegments(const LineSegments& segments) {
    LineChains out;
    std::vector<glm::vec3> points;
    const std::vector<uint32_t> welded = PositionWelder(points).add(segments.points);
    const std::vector<Edge> edges = distinctEdges(segments, welded, out);
    for (const auto& chain : ChainWalker(points.size(), edges).walk()) {
        std::vector<glm::vec3>& line = out.lines.emplace_back();
        line.reserve(chain.size());
        for (const uint32_t p : chain) line.push_back(points[p]);
    }
    return out;
}

}  // namespace sherd
