// SPDX-License-Identifier: MIT
#include "map/bitmap_trace.h"

#include <algorithm>
#include <array>
#include <bit>

#include "map/bitmap_thinning.h"

namespace sherd {

namespace {

constexpr uint8_t kJunction = 2;  ///< three neighbours or more
constexpr uint8_t kWalked = 4;

class Tracer {
  public:
    Tracer(Raster<uint8_t>& thinned, const InkRadius& radius, size_t limit)
        : mask_(thinned), radius_(radius), limit_(limit) {}

    std::optional<CentreGraph> trace() {
        markJunctions();
        for (uint32_t j = 0; j < junctions_.size(); ++j)
            if (clusterOf_[j] == kNoNode) gatherCluster(j);
        for (size_t j = 0; j < junctions_.size(); ++j)
            for (int k = 0; k < 8; ++k) {
                const size_t next = junctions_[j] + mask_.step(k);
                if (isFree(next)) walk(clusterOf_[j], junctions_[j], next);
                if (graph_.lines.size() > limit_) return std::nullopt;
            }
        if (!traceOpenLines()) return std::nullopt;
        traceClosedLines();
        if (graph_.lines.size() > limit_) return std::nullopt;
        return std::move(graph_);
    }

  private:
    bool isInk(size_t i) const { return (mask_.values[i] & kInk) != 0; }
    bool isJunction(size_t i) const { return (mask_.values[i] & kJunction) != 0; }
    bool isFree(size_t i) const { return mask_.values[i] == kInk; }
    int degree(size_t i) const { return std::popcount(neighbourhood(mask_, i)); }

    CentrePoint pointAt(size_t i) const {
        return {{mask_.xOf(i) + 0.5, mask_.yOf(i) + 0.5}, radius_.at(i)};
    }

    template <class Visit>
    void eachTexel(const Visit& visit) {
        for (int y = 0; y < mask_.height; ++y)
            for (int x = 0; x < mask_.width; ++x) {
                const size_t i = mask_.index(x, y);
                if (mask_.values[i] != 0) visit(i);
            }
    }

    /// In ascending order, so that they can be found again.
    void markJunctions() {
        eachTexel([&](size_t i) {
            if (degree(i) < 3) return;
            mask_.values[i] |= kJunction;
            junctions_.push_back(i);
        });
        clusterOf_.assign(junctions_.size(), kNoNode);
    }

    uint32_t& clusterAt(size_t texel) {
        const auto found = std::lower_bound(junctions_.begin(), junctions_.end(), texel);
        return clusterOf_[static_cast<size_t>(found - junctions_.begin())];
    }

    uint32_t addNode(const CentrePoint& point) {
        graph_.nodes.push_back({point.at, point.radius, {}});
        return static_cast<uint32_t>(graph_.nodes.size() - 1);
    }

    /// One node for the texels connected to junction `first`, at the one deepest in the ink.
    void gatherCluster(uint32_t first) {
        const uint32_t node = addNode(pointAt(junctions_[first]));
        clusterOf_[first] = node;
        std::vector<size_t> open{junctions_[first]};
        while (!open.empty()) {
            const size_t at = open.back();
            open.pop_back();
            const CentrePoint point = pointAt(at);
            if (point.radius > graph_.nodes[node].radius) {
                graph_.nodes[node].at = point.at;
                graph_.nodes[node].radius = point.radius;
            }
            for (int k = 0; k < 8; ++k) {
                const size_t next = at + mask_.step(k);
                if (!isJunction(next) || clusterAt(next) != kNoNode) continue;
                clusterAt(next) = node;
                open.push_back(next);
            }
        }
    }

    /// Follows the texels from `next` on, coming from `before`, to the next node.
    void walk(uint32_t from, size_t before, size_t next) {
        CentreLine line;
        line.from = from;
        line.points.push_back({graph_.nodes[from].at, graph_.nodes[from].radius});
        for (;;) {
            if (isJunction(next)) {
                line.to = clusterAt(next);
                line.points.push_back({graph_.nodes[line.to].at, graph_.nodes[line.to].radius});
                break;
            }
            mask_.values[next] |= kWalked;
            line.points.push_back(pointAt(next));
            const size_t after = otherNeighbour(next, before);
            if (after == next) {
                line.to = addNode(line.points.back());
                break;
            }
            before = next;
            next = after;
        }
        // A texel that touches one cluster twice goes nowhere.
        if (line.from == line.to && line.points.size() <= 3) return;
        addLine(std::move(line));
    }

    /// The neighbour of a texel with at most two that is not `before`; the texel itself if none is.
    size_t otherNeighbour(size_t texel, size_t before) const {
        for (int k = 0; k < 8; ++k) {
            const size_t n = texel + mask_.step(k);
            if (isInk(n) && n != before) return n;
        }
        return texel;
    }

    void addLine(CentreLine line) {
        const auto id = static_cast<uint32_t>(graph_.lines.size());
        if (!line.closed()) {
            graph_.nodes[line.from].lines.push_back(id);
            graph_.nodes[line.to].lines.push_back(id);
        }
        graph_.lines.push_back(std::move(line));
    }

    bool traceOpenLines() {
        eachTexel([&](size_t i) {
            if (!isFree(i) || degree(i) > 1 || graph_.lines.size() > limit_) return;
            mask_.values[i] |= kWalked;
            const uint32_t node = addNode(pointAt(i));
            if (degree(i) == 1) walk(node, i, otherNeighbour(i, i));
        });
        return graph_.lines.size() <= limit_ && graph_.nodes.size() <= 4 * limit_;
    }

    void traceClosedLines() {
        eachTexel([&](size_t start) {
            if (!isFree(start)) return;
            CentreLine line;
            size_t before = start;
            size_t at = start;
            do {
                mask_.values[at] |= kWalked;
                line.points.push_back(pointAt(at));
                const size_t next = otherNeighbour(at, before);
                before = at;
                at = next;
            } while (at != start && isFree(at));
            line.points.push_back(line.points.front());
            addLine(std::move(line));
        });
    }

    Raster<uint8_t>& mask_;
    const InkRadius& radius_;
    size_t limit_;
    std::vector<size_t> junctions_;    ///< texels, ascending
    std::vector<uint32_t> clusterOf_;  ///< their nodes
    CentreGraph graph_;
};

}  // namespace

std::optional<CentreGraph> traceLines(Raster<uint8_t>& thinned, const InkRadius& radius,
                                      size_t limit) {
    return Tracer(thinned, radius, limit).trace();
}

}  // namespace sherd
