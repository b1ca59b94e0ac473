// SPDX-License-Identifier: MIT
#include "map/centre_graph.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace sherd {

namespace {

void forget(CentreNode& node, uint32_t line) {
    node.lines.erase(std::remove(node.lines.begin(), node.lines.end(), line), node.lines.end());
}

}  // namespace

double lengthOf(const CentreLine& line) {
    double length = 0;
    for (size_t i = 1; i < line.points.size(); ++i)
        length += glm::distance(line.points[i - 1].at, line.points[i].at);
    return length;
}

void reverse(CentreLine& line) {
    std::reverse(line.points.begin(), line.points.end());
    std::swap(line.from, line.to);
}

void removeLine(CentreGraph& graph, uint32_t id) {
    CentreLine& line = graph.lines[id];
    line.dead = true;
    if (line.closed()) return;
    forget(graph.nodes[line.from], id);
    forget(graph.nodes[line.to], id);
}

void dissolve(CentreGraph& graph, uint32_t node) {
    std::vector<uint32_t>& ends = graph.nodes[node].lines;
    if (ends.size() != 2) return;
    if (ends[0] == ends[1]) {
        CentreLine& loop = graph.lines[ends[0]];
        loop.from = loop.to = kNoNode;
        ends.clear();
        return;
    }
    // The shorter is moved, so that a long line with many spurs is not copied for each.
    uint32_t keep = ends[0];
    uint32_t move = ends[1];
    if (graph.lines[keep].points.size() < graph.lines[move].points.size()) std::swap(keep, move);
    CentreLine& kept = graph.lines[keep];
    CentreLine& moved = graph.lines[move];
    if (kept.to != node) reverse(kept);
    if (moved.from != node) reverse(moved);
    kept.points.insert(kept.points.end(), moved.points.begin() + 1, moved.points.end());
    kept.to = moved.to;
    std::vector<uint32_t>& far = graph.nodes[moved.to].lines;
    std::replace(far.begin(), far.end(), move, keep);
    moved.dead = true;
    moved.points = {};
    ends.clear();
}

}  // namespace sherd
