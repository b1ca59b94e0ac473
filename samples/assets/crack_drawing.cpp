// SPDX-License-Identifier: MIT
#include "crack_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

namespace sherd::samples {
namespace {

constexpr double kViewBox = 1024;

struct Node {
    glm::dvec2 uv{0.0};
    glm::dvec2 outward{0.0};  ///< at a chart's rim: where the line leaves it
    std::vector<uint32_t> edges;
};

struct Graph {
    std::vector<Node> nodes;
    std::vector<std::array<uint32_t, 2>> edges;
};

struct Line {
    std::vector<glm::dvec2> points;
    bool closed = false;
};

/// Ends of segments that meet differ by rounding only; charts lie much farther apart.
class NodeFinder {
  public:
    explicit NodeFinder(Graph& graph) : graph_(graph) {}

    uint32_t find(const glm::dvec2& uv, const glm::dvec2& outward) {
        const auto x = static_cast<int64_t>(std::llround(uv.x / kGrid));
        const auto y = static_cast<int64_t>(std::llround(uv.y / kGrid));
        for (int64_t n = 0; n < 9; ++n) {
            const auto found = cells_.find({x + n % 3 - 1, y + n / 3 - 1});
            if (found == cells_.end()) continue;
            if (outward != glm::dvec2(0)) graph_.nodes[found->second].outward = outward;
            return found->second;
        }
        const auto node = static_cast<uint32_t>(graph_.nodes.size());
        graph_.nodes.push_back({uv, outward, {}});
        cells_.emplace(std::pair{x, y}, node);
        return node;
    }

  private:
    static constexpr double kGrid = 1e-7;
    Graph& graph_;
    std::map<std::pair<int64_t, int64_t>, uint32_t> cells_;
};

Graph connect(std::span<const CrackSegment> segments) {
    Graph graph;
    NodeFinder finder(graph);
    for (const CrackSegment& segment : segments) {
        const uint32_t a = finder.find(segment.from, segment.fromOutward);
        const uint32_t b = finder.find(segment.to, segment.toOutward);
        if (a == b) continue;
        const auto edge = static_cast<uint32_t>(graph.edges.size());
        graph.edges.push_back({a, b});
        graph.nodes[a].edges.push_back(edge);
        graph.nodes[b].edges.push_back(edge);
    }
    return graph;
}

/// A loose end is drawn on: over the chart's rim, or over the coarser crack it stops at.
void drawOn(const Node& node, const glm::dvec2& before, const DrawOptions& options,
            std::vector<glm::dvec2>& points) {
    if (node.edges.size() != 1) return;
    const glm::dvec2 ahead = glm::normalize(node.uv - before);
    if (node.outward != glm::dvec2(0)) {
        points.push_back(node.uv + node.outward * options.pastRim);
    } else {
        points.push_back(node.uv + ahead * options.pastJunction);
    }
}

/// Ramer-Douglas-Peucker (1972): keeps the points that lie farther than the tolerance off the
/// chord.
void simplify(std::span<const glm::dvec2> points, double tolerance, std::vector<glm::dvec2>& out) {
    const glm::dvec2 a = points.front();
    const glm::dvec2 chord = points.back() - a;
    const double length = glm::length(chord);
    double worst = tolerance;
    size_t split = 0;
    for (size_t i = 1; i + 1 < points.size(); ++i) {
        const glm::dvec2 d = points[i] - a;
        const double off =
            length > 0 ? std::abs(chord.x * d.y - chord.y * d.x) / length : glm::length(d);
        if (off > worst) {
            worst = off;
            split = i;
        }
    }
    if (split == 0) {
        out.push_back(points.back());
        return;
    }
    simplify(points.first(split + 1), tolerance, out);
    simplify(points.subspan(split), tolerance, out);
}

std::vector<glm::dvec2> simplified(std::span<const glm::dvec2> points, double tolerance) {
    std::vector<glm::dvec2> out{points.front()};
    simplify(points, tolerance, out);
    return out;
}

/// Follows a crack from a node along an edge to the next node that is not a mere bend.
Line follow(const Graph& graph, uint32_t start, uint32_t edge, std::vector<bool>& used,
            const DrawOptions& options) {
    std::vector<uint32_t> path{start};
    for (;;) {
        used[edge] = true;
        const auto& ends = graph.edges[edge];
        const uint32_t next = ends[0] == path.back() ? ends[1] : ends[0];
        path.push_back(next);
        const Node& node = graph.nodes[next];
        if (next == start || node.edges.size() != 2) break;
        edge = node.edges[0] == edge ? node.edges[1] : node.edges[0];
        if (used[edge]) break;
    }
    std::vector<glm::dvec2> points;
    points.reserve(path.size());
    for (const uint32_t node : path) points.push_back(graph.nodes[node].uv);
    points = simplified(points, options.tolerance);
    Line line;
    line.closed = path.front() == path.back();
    drawOn(graph.nodes[path.front()], points[1], options, line.points);
    line.points.insert(line.points.end(), points.begin(), points.end());
    drawOn(graph.nodes[path.back()], points[points.size() - 2], options, line.points);
    return line;
}

std::vector<Line> chain(const Graph& graph, const DrawOptions& options) {
    std::vector<Line> lines;
    std::vector<bool> used(graph.edges.size(), false);
    // Lines between ends and branches first; what is left are closed loops.
    for (const bool loops : {false, true}) {
        for (uint32_t node = 0; node < graph.nodes.size(); ++node) {
            if (!loops && graph.nodes[node].edges.size() == 2) continue;
            for (const uint32_t edge : graph.nodes[node].edges) {
                if (!used[edge]) lines.push_back(follow(graph, node, edge, used, options));
            }
        }
    }
    return lines;
}

void appendPoint(std::string& out, const glm::dvec2& uv) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.6f %.6f", uv.x * kViewBox, uv.y * kViewBox);
    out += text.data();
}

/// Straight first and last pieces keep the crossing of a chart's rim where it was traced; between
/// them, cubic Beziers with Catmull-Rom tangents, no longer than a third of the shorter neighbour.
std::string pathOf(const Line& line, const DrawOptions& options) {
    const std::vector<glm::dvec2>& p = line.points;
    std::string out = "M";
    appendPoint(out, p[0]);
    const auto tangent = [&](size_t i, double reach) {
        const glm::dvec2 across = p[i + 1] - p[i - 1];
        const double length = glm::length(across);
        return length > 0 ? across * (options.roundness * reach / length) : glm::dvec2(0);
    };
    for (size_t i = 0; i + 1 < p.size(); ++i) {
        const bool straight = i == 0 || i + 2 == p.size();
        if (!straight) {
            const double reach = glm::distance(p[i], p[i + 1]) / 3;
            out += " C";
            appendPoint(out, p[i] + tangent(i, reach));
            out += ' ';
            appendPoint(out, p[i + 1] - tangent(i + 1, reach));
            out += ' ';
        } else {
            out += " L";
        }
        appendPoint(out, p[i + 1]);
    }
    return out;
}

}  // namespace

std::string drawCracks(std::span<const CrackSegment> segments, uint32_t level,
                       const DrawOptions& options) {
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1024 1024\" width=\"1024\" "
        "height=\"1024\">\n";
    svg += "<g id=\"level " + std::to_string(level) + "\" fill=\"none\" stroke=\"" +
           (level == 1 ? "#c2185b" : "#1565c0") +
           "\" stroke-width=\"1\" stroke-linejoin=\"round\">\n";
    uint32_t number = 0;
    for (const Line& line : chain(connect(segments), options)) {
        svg += "<path id=\"crack" + std::to_string(++number) + "\" d=\"" + pathOf(line, options) +
               "\"/>\n";
    }
    return svg + "</g>\n</svg>\n";
}

}  // namespace sherd::samples
