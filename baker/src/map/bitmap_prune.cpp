// SPDX-License-Identifier: MIT
// Spurs by how far they stand out: a branch is measured from the edge of the largest disc of ink
// around its junction to its tip, not along the whole centre line. What thinning leaves in the
// corners of a square line end stands out by (sqrt(2) - 1) times half the width.
#include "map/bitmap_prune.h"

#include <algorithm>
#include <queue>

namespace sherd {

namespace {

constexpr double kSpurShare = 0.5;  ///< of the radius at the junction: above sqrt(2) - 1

struct DeadBranch {
    double standsOut = 0;
    uint32_t line = 0;
    size_t points = 0;  ///< of the line when measured: it may have grown since
};

struct Nearer {
    bool operator()(const DeadBranch& a, const DeadBranch& b) const {
        if (a.standsOut != b.standsOut) return a.standsOut > b.standsOut;
        return a.line > b.line;
    }
};

class Pruner {
  public:
    Pruner(CentreGraph& graph, double spur) : graph_(graph), spur_(spur) {}

    Pruned run() {
        for (uint32_t i = 0; i < graph_.lines.size(); ++i) consider(i);
        while (!queue_.empty()) {
            const DeadBranch branch = queue_.top();
            queue_.pop();
            const CentreLine& line = graph_.lines[branch.line];
            if (line.dead || line.points.size() != branch.points || !isDeadBranch(line)) continue;
            pruneAt(junctionOf(line));
        }
        removeSpecks();
        return pruned_;
    }

  private:
    bool isDeadBranch(const CentreLine& line) const {
        if (line.dead || !graph_.hasTwoEnds(line)) return false;
        const size_t a = graph_.degree(line.from);
        const size_t b = graph_.degree(line.to);
        return (a == 1 && b >= 3) || (b == 1 && a >= 3);
    }
    uint32_t junctionOf(const CentreLine& line) const {
        return graph_.degree(line.from) == 1 ? line.to : line.from;
    }
    uint32_t endOf(const CentreLine& line) const {
        return graph_.degree(line.from) == 1 ? line.from : line.to;
    }
    double standsOut(const CentreLine& line) const {
        return lengthOf(line) + graph_.nodes[endOf(line)].radius -
               graph_.nodes[junctionOf(line)].radius;
    }
    bool isSpur(const CentreLine& line) const {
        return isDeadBranch(line) &&
               standsOut(line) <
                   std::max(spur_, kSpurShare * graph_.nodes[junctionOf(line)].radius);
    }

    void consider(uint32_t id) {
        const CentreLine& line = graph_.lines[id];
        if (isSpur(line)) queue_.push({standsOut(line), id, line.points.size()});
    }

    /// All spurs of a junction go at once: were the corners of a line's end taken one by one, the
    /// second would have become part of the line.
    void pruneAt(uint32_t junction) {
        std::vector<uint32_t> spurs;
        for (const uint32_t id : graph_.nodes[junction].lines)
            if (isSpur(graph_.lines[id])) spurs.push_back(id);
        std::sort(spurs.begin(), spurs.end(), [&](uint32_t a, uint32_t b) {
            const double outA = standsOut(graph_.lines[a]);
            const double outB = standsOut(graph_.lines[b]);
            return outA != outB ? outA < outB : a < b;
        });
        // A star of nothing but spurs keeps its longest line.
        if (spurs.size() == graph_.degree(junction)) spurs.resize(spurs.size() - 2);
        for (const uint32_t id : spurs) remove(id);
        const std::vector<uint32_t> rest = graph_.nodes[junction].lines;
        dissolve(graph_, junction);
        for (const uint32_t id : rest)
            if (!graph_.lines[id].dead) consider(id);
    }

    void remove(uint32_t id) {
        const CentreLine& line = graph_.lines[id];
        ++pruned_.spurs;
        if (standsOut(line) > pruned_.longest) {
            pruned_.longest = standsOut(line);
            pruned_.spurAt = graph_.nodes[endOf(line)].at;
        }
        removeLine(graph_, id);
    }

    void removeSpecks() {
        for (uint32_t i = 0; i < graph_.lines.size(); ++i) {
            const CentreLine& line = graph_.lines[i];
            if (line.dead || !isSpeck(line)) continue;
            addSpeck(line.points.front().at);
            removeLine(graph_, i);
        }
    }
    bool isSpeck(const CentreLine& line) const {
        double widest = 0;
        for (const CentrePoint& point : line.points) widest = std::max(widest, point.radius);
        const double length = lengthOf(line);
        if (line.closed()) return length < spur_;
        if (graph_.degree(line.from) != 1 || graph_.degree(line.to) != 1) return false;
        const double drawn = length + line.points.front().radius + line.points.back().radius;
        return drawn < spur_ || length < widest;
    }
    void addSpeck(glm::dvec2 at) {
        if (pruned_.specks++ == 0) pruned_.speckAt = at;
    }

    CentreGraph& graph_;
    double spur_;
    std::priority_queue<DeadBranch, std::vector<DeadBranch>, Nearer> queue_;
    Pruned pruned_;
};

}  // namespace

Pruned pruneSpurs(CentreGraph& graph, double spur) {
    size_t lone = 0;
    glm::dvec2 loneAt{0.0};
    for (const CentreNode& node : graph.nodes)
        if (node.lines.empty() && lone++ == 0) loneAt = node.at;
    for (uint32_t node = 0; node < graph.nodes.size(); ++node) dissolve(graph, node);
    Pruned pruned = Pruner(graph, spur).run();
    if (lone > 0 && pruned.specks == 0) pruned.speckAt = loneAt;
    pruned.specks += lone;
    return pruned;
}

}  // namespace sherd
