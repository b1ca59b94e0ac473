// SPDX-License-Identifier: MIT
#include "solid/border_graph.h"

#include <algorithm>

#include "geometry/triangle.h"

namespace sherd {
namespace {

uint32_t previousCorner(uint32_t corner) {
    return nextCorner(nextCorner(corner));
}

class GraphBuilder {
  public:
    GraphBuilder(const SplitSurface& surface, const MeshTopology& topology,
                 std::span<const uint32_t> piece, uint32_t pieceCount)
        : surface_(surface), topology_(topology), piece_(piece) {
        graph_.open.assign(pieceCount, 0);
        graph_.nodeOfVertex.assign(surface.positions.size(), kNone);
        arcOf_.assign(3 * surface.triangles.size(), kNone);
    }

    BorderGraph run() {
        findNodes();
        for (uint32_t h = 0; h < arcOf_.size(); ++h)
            if (isArc(h) && graph_.nodeOfVertex[start(h)] != kNone) trace(h);
        for (uint32_t h = 0; h < arcOf_.size(); ++h)
            if (isArc(h) && arcOf_[h] == kNone) trace(h);
        for (BorderNode& node : graph_.nodes) findSpokes(node);
        return std::move(graph_);
    }

  private:
    uint32_t start(uint32_t h) const { return surface_.triangles[h / 3].v[h % 3]; }
    uint32_t pieceOf(uint32_t h) const { return piece_[h / 3]; }
    bool parts(uint32_t h) const {
        const uint32_t o = topology_.opposite[h];
        return o != kNone && pieceOf(h) != pieceOf(o);
    }
    /// Whether the half edge is a link of an arc, in its direction.
    bool isArc(uint32_t h) const { return parts(h) && pieceOf(h) < pieceOf(topology_.opposite[h]); }

    void findNodes() {
        std::vector<uint32_t> degree(surface_.positions.size(), 0);
        cornerOf_.assign(surface_.positions.size(), kNone);
        for (uint32_t h = 0; h < arcOf_.size(); ++h) {
            if (topology_.degenerate[h / 3] != 0) continue;
            if (topology_.opposite[h] == kNone) graph_.open[pieceOf(h)] = 1;
            if (!parts(h)) continue;
            ++degree[start(h)];
            cornerOf_[start(h)] = h;
        }
        for (uint32_t v = 0; v < degree.size(); ++v) {
            if (degree[v] == 0 || degree[v] == 2) continue;
            graph_.nodeOfVertex[v] = static_cast<uint32_t>(graph_.nodes.size());
            graph_.nodes.push_back({v, {}, true});
        }
    }

    void trace(uint32_t first) {
        const auto number = static_cast<uint32_t>(graph_.arcs.size());
        BorderArc arc;
        arc.low = pieceOf(first);
        arc.high = pieceOf(topology_.opposite[first]);
        arc.from = graph_.nodeOfVertex[start(first)];
        for (uint32_t h = first; h != kNone && arcOf_[h] == kNone; h = following(h)) {
            arcOf_[h] = number;
            arc.halfEdges.push_back(h);
        }
        arc.to = graph_.nodeOfVertex[start(nextCorner(arc.halfEdges.back()))];
        graph_.arcs.push_back(std::move(arc));
    }

    /// The next link of an arc: around its end, through the piece on the left. kNone at a node.
    uint32_t following(uint32_t h) const {
        uint32_t c = nextCorner(h);
        if (graph_.nodeOfVertex[start(c)] != kNone) return kNone;
        while (!parts(c)) {
            if (topology_.opposite[c] == kNone) return kNone;
            c = nextCorner(topology_.opposite[c]);
        }
        return c;
    }

    void findSpokes(BorderNode& node) {
        const uint32_t first = cornerOf_[node.vertex];
        uint32_t c = first;
        do {
            const uint32_t arriving = previousCorner(c);
            const uint32_t next = topology_.opposite[arriving];
            if (next == kNone) {
                node.plain = false;
                return;
            }
            if (pieceOf(c) != pieceOf(next)) {
                BorderNode::Spoke spoke{kNone, pieceOf(next) < pieceOf(c), pieceOf(c),
                                        pieceOf(next)};
                spoke.arc = arcOf_[spoke.leaves ? next : arriving];
                node.spokes.push_back(spoke);
            }
            c = next;
        } while (c != first);
        std::vector<uint32_t> pieces;
        for (const BorderNode::Spoke& spoke : node.spokes) pieces.push_back(spoke.after);
        std::sort(pieces.begin(), pieces.end());
        node.plain = std::adjacent_find(pieces.begin(), pieces.end()) == pieces.end();
    }

    const SplitSurface& surface_;
    const MeshTopology& topology_;
    std::span<const uint32_t> piece_;
    BorderGraph graph_;
    std::vector<uint32_t> cornerOf_;  ///< per vertex on a border: a corner there
    std::vector<uint32_t> arcOf_;     ///< per half edge
};

}  // namespace

BorderGraph borderGraph(const SplitSurface& surface, const MeshTopology& topology,
                        std::span<const uint32_t> piece, uint32_t pieceCount) {
    return GraphBuilder(surface, topology, piece, pieceCount).run();
}

}  // namespace sherd
