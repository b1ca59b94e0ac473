// SPDX-License-Identifier: MIT
#include "solid/wall_loops.h"

#include <algorithm>
#include <map>
#include <optional>

#include "geometry/triangle.h"

namespace sherd {
namespace {

class OutlineTracer {
  public:
    OutlineTracer(const SplitSurface& surface, const MeshTopology& topology,
                  const BorderGraph& graph, const Skeleton& skeleton)
        : surface_(surface), topology_(topology), graph_(graph), skeleton_(skeleton) {
        result_.broken = graph.open;
        for (uint32_t n = 0; n < graph.nodes.size(); ++n)
            if (skeleton.hubOf[n] != kNone) nodesOfHub_[skeleton.hubOf[n]].push_back(n);
    }

    WallOutlines run() {
        used_.assign(graph_.arcs.size(), 0);
        for (uint32_t a = 0; a < graph_.arcs.size(); ++a)
            if (used_[a] == 0) trace(a);
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
    std::optional<uint32_t> leadOn(uint32_t a, WallOutline& outline) const {
        const uint32_t node = graph_.arcs[a].to;
        if (const uint32_t partner = skeleton_.partner[node]; partner != kNone)
            return arcFrom(partner, outline);
        const uint32_t hub = skeleton_.hubOf[node];
        if (hub == kNone) return std::nullopt;
        outline.vertices.push_back({kNone, hub});
        if (graph_.arcs[a].from != kNone && skeleton_.hubOf[graph_.arcs[a].from] == hub) return a;
        std::optional<uint32_t> found;
        for (const uint32_t other : nodesOfHub_.at(hub)) {
            const std::optional<uint32_t> arc = arcFrom(other, outline);
            if (!arc) continue;
            if (found) return std::nullopt;
            found = arc;
        }
        return found;
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
    std::map<uint32_t, std::vector<uint32_t>> nodesOfHub_;
    std::vector<uint8_t> used_;  ///< per arc
    WallOutlines result_;
};

}  // namespace

WallOutlines wallOutlines(const SplitSurface& surface, const MeshTopology& topology,
                          const BorderGraph& graph, const Skeleton& skeleton) {
    return OutlineTracer(surface, topology, graph, skeleton).run();
}

}  // namespace sherd
