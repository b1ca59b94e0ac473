// SPDX-License-Identifier: MIT
#include "solid/wall_loops.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <optional>
#include <set>

#include "geometry/triangle.h"

namespace sherd {
namespace {

class OutlineTracer {
  public:
    OutlineTracer(const SplitSurface& surface, const MeshTopology& topology,
                  const BorderGraph& graph, const Skeleton& skeleton, const CellSpace* space)
        : surface_(surface),
          topology_(topology),
          graph_(graph),
          skeleton_(skeleton),
          space_(space) {
        result_.broken = graph.open;
    }

    WallOutlines run() {
        used_.assign(graph_.arcs.size(), 0);
        for (uint32_t a = 0; a < graph_.arcs.size(); ++a)
            if (used_[a] == 0) trace(a);
        if (space_ != nullptr) traceInner();
        return std::move(result_);
    }

  private:
    void trace(uint32_t first) {
        WallOutline outline{graph_.arcs[first].low, graph_.arcs[first].high, {}};
        uint32_t a = first;
        do {
            if (used_[a] != 0) {  // two ways lead to one arc
                giveUp(outline);
                return;
            }
            used_[a] = 1;
            addArc(a, outline);
            if (graph_.arcs[a].to == kNone) break;
            const std::optional<uint32_t> next = leadOn(a, outline);
            if (!next) {
                giveUp(outline);
                return;
            }
            a = *next;
        } while (a != first);
        result_.walls.push_back(std::move(outline));
    }

    void giveUp(const WallOutline& outline) {
        result_.broken[outline.low] = result_.broken[outline.high] = 1;
    }

    void addArc(uint32_t number, WallOutline& outline) const {
        const BorderArc& arc = graph_.arcs[number];
        for (const uint32_t h : arc.halfEdges) {
            outline.vertices.push_back({surface_.triangles[h / 3].v[h % 3], kNone, h,
                                        nextCorner(topology_.opposite[h]), arc.to == kNone,
                                        number});
        }
        if (arc.to == kNone) return;
        const uint32_t last = arc.halfEdges.back();
        const uint32_t end = nextCorner(last);
        outline.vertices.push_back({surface_.triangles[end / 3].v[end % 3], kNone, end,
                                    topology_.opposite[last], false, number});
    }

    /// The arc on which the wall goes on beyond the end of arc `a`, through the solid.
    std::optional<uint32_t> leadOn(uint32_t a, WallOutline& outline) {
        uint32_t end = graph_.arcs[a].to;
        if (skeleton_.linesAt[end].empty()) return std::nullopt;
        uint32_t line = skeleton_.linesAt[end][0];
        for (size_t steps = skeleton_.lines.size(); steps > 0; --steps) {
            crossed_.insert({line, outline.low, outline.high});
            end = skeleton_.otherEnd(line, end);
            if (!skeleton_.isHub(end)) return arcFrom(end, outline);
            outline.vertices.push_back({kNone, end - skeleton_.nodes});
            const std::optional<uint32_t> next =
                throughHub(end, line, graph_.arcs[a].from, outline);
            if (!next) return std::nullopt;
            line = *next;
        }
        return std::nullopt;
    }

    /// The line by which the wall leaves a hub: back to the node where its arc began, or the only
    /// one that both pieces have beside the one it came by.
    std::optional<uint32_t> throughHub(uint32_t hub, uint32_t line, uint32_t began,
                                       const WallOutline& outline) const {
        std::optional<uint32_t> found;
        bool ambiguous = false;
        for (const uint32_t other : skeleton_.linesAt[hub]) {
            if (other == line) continue;
            if (skeleton_.otherEnd(other, hub) == began) return other;
            const std::vector<uint32_t>& pieces = skeleton_.lines[other].pieces;
            const auto has = [&pieces](uint32_t piece) {
                return std::find(pieces.begin(), pieces.end(), piece) != pieces.end();
            };
            if (!has(outline.low) || !has(outline.high)) continue;
            if (found) ambiguous = true;
            found = other;
        }
        return ambiguous ? std::nullopt : found;
    }

    /// Walls between pieces that touch inside only: from hub to hub.
    void traceInner() {
        for (uint32_t l = 0; l < skeleton_.lines.size(); ++l) {
            const Skeleton::Line& line = skeleton_.lines[l];
            if (!skeleton_.isHub(line.from) || !skeleton_.isHub(line.to)) continue;
            for (const uint32_t low : line.pieces)
                for (const uint32_t high : line.pieces)
                    if (low < high && !crossed_.contains({l, low, high})) traceAround(l, low, high);
        }
    }

    void traceAround(uint32_t first, uint32_t low, uint32_t high) {
        WallOutline outline{low, high, {}};
        uint32_t line = first;
        uint32_t end = skeleton_.lines[first].from;
        do {
            crossed_.insert({line, low, high});
            end = skeleton_.otherEnd(line, end);
            if (!skeleton_.isHub(end)) {  // an outline that was given up
                giveUp(outline);
                return;
            }
            outline.vertices.push_back({kNone, end - skeleton_.nodes});
            const std::optional<uint32_t> next = throughHub(end, line, kNone, outline);
            if (!next || (*next != first && crossed_.contains({*next, low, high}))) {
                giveUp(outline);
                return;
            }
            line = *next;
        } while (line != first);
        const auto plane = space_->between(low, high);
        if (!plane) {
            giveUp(outline);
            return;
        }
        if (turn(outline, plane->normal) > 0)
            std::reverse(outline.vertices.begin(), outline.vertices.end());
        result_.walls.push_back(std::move(outline));
    }

    /// Positive where the outline goes counter-clockwise around a normal.
    double turn(const WallOutline& outline, const glm::dvec3& normal) const {
        glm::dvec3 sum(0.0);
        const glm::dvec3 origin = skeleton_.hubs[outline.vertices[0].hub];
        for (size_t i = 1; i + 1 < outline.vertices.size(); ++i)
            sum += glm::cross(glm::dvec3(skeleton_.hubs[outline.vertices[i].hub]) - origin,
                              glm::dvec3(skeleton_.hubs[outline.vertices[i + 1].hub]) - origin);
        return glm::dot(sum, normal);
    }

    /// The arc of the outline's two pieces that starts at a node.
    std::optional<uint32_t> arcFrom(uint32_t node, const WallOutline& outline) const {
        for (const BorderNode::Spoke& spoke : graph_.nodes[node].spokes) {
            if (spoke.leaves && spoke.after == outline.low && spoke.before == outline.high)
                return spoke.arc;
        }
        return std::nullopt;
    }

    const SplitSurface& surface_;
    const MeshTopology& topology_;
    const BorderGraph& graph_;
    const Skeleton& skeleton_;
    const CellSpace* space_;
    std::vector<uint8_t> used_;                  ///< per arc
    std::set<std::array<uint32_t, 3>> crossed_;  ///< line, lower and higher piece of an outline
    WallOutlines result_;
};

}  // namespace

WallOutlines wallOutlines(const SplitSurface& surface, const MeshTopology& topology,
                          const BorderGraph& graph, const Skeleton& skeleton,
                          const CellSpace* space) {
    return OutlineTracer(surface, topology, graph, skeleton, space).run();
}

}  // namespace sherd
