// SPDX-License-Identifier: MIT
#include "map/gap_closing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace sherd {
namespace {

glm::dvec2 nearestOn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    const glm::dvec2 ab = b - a;
    const double length = glm::dot(ab, ab);
    const double t = length > 0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
    return a + ab * t;
}

glm::dvec2 onGrid(const glm::dvec2& p) {
    return {static_cast<double>(std::llround(p.x * kGridOne)) / kGridOne,
            static_cast<double>(std::llround(p.y * kGridOne)) / kGridOne};
}

struct DanglingEnd {
    uint32_t node, edge;
};

std::vector<DanglingEnd> danglingEnds(const PlanarMap& map) {
    std::vector<uint32_t> degree(map.nodes.size(), 0);
    std::vector<uint32_t> edgeAt(map.nodes.size(), 0);
    for (uint32_t e = 0; e < map.edges.size(); ++e) {
        for (const uint32_t node : {map.edges[e].from, map.edges[e].to}) {
            ++degree[node];
            edgeAt[node] = e;
        }
    }
    std::vector<DanglingEnd> ends;
    for (uint32_t node = 0; node < degree.size(); ++node)
        if (degree[node] == 1) ends.push_back({node, edgeAt[node]});
    return ends;
}

struct Target {
    glm::dvec2 place;
    uint32_t line;
    double distance;
};

std::optional<Target> nearestWithin(const PlanarMap& map, MapIndex& index, const DanglingEnd& end,
                                    double reach) {
    const MapEdge& own = map.edges[end.edge];
    const glm::dvec2 p = nodeUv(map, end.node);
    const glm::dvec2 ahead = p - nodeUv(map, own.from == end.node ? own.to : own.from);
    const auto grid = [](double x) {
        return static_cast<int32_t>(std::clamp(x, -8.0, 8.0) * kGridOne);
    };
    std::vector<uint32_t> near;
    index.query({grid(p.x - reach), grid(p.y - reach)}, {grid(p.x + reach), grid(p.y + reach)},
                near);
    std::optional<Target> best;
    for (const uint32_t e : near) {
        const MapEdge& edge = map.edges[e];
        if (e == end.edge) continue;
        const glm::dvec2 q = nearestOn(nodeUv(map, edge.from), nodeUv(map, edge.to), p);
        const double distance = glm::distance(p, q);
        if (distance > reach || (best && distance >= best->distance)) continue;
        if (edge.line == own.line && !(glm::dot(q - p, ahead) > 0)) continue;
        best = Target{q, edge.line, distance};
    }
    return best;
}

/// Looks close by first: where lines are dense, thousands lie within reach.
std::optional<Target> nearestLine(const PlanarMap& map, MapIndex& index, const DanglingEnd& end,
                                  double reach) {
    for (const double part : {1.0 / 256, 1.0 / 64, 1.0 / 16, 1.0 / 4}) {
        if (auto target = nearestWithin(map, index, end, part * reach)) return target;
    }
    return nearestWithin(map, index, end, reach);
}

/// Gives the line a corner at the place that is nearest to it.
void addCorner(FractureMap::Line& line, const glm::dvec2& place) {
    size_t best = 1;
    double least = std::numeric_limits<double>::max();
    for (size_t i = 1; i < line.points.size(); ++i) {
        const double d = glm::distance(nearestOn(line.points[i - 1], line.points[i], place), place);
        if (d >= least) continue;
        least = d;
        best = i;
    }
    line.points.insert(line.points.begin() + static_cast<ptrdiff_t>(best), place);
}

}  // namespace

std::optional<glm::dvec2> lineNear(const PlanarMap& map, MapIndex& index, uint32_t node,
                                   uint32_t edge, double reach) {
    const std::optional<Target> target = nearestLine(map, index, {node, edge}, reach);
    return target ? std::optional(target->place) : std::nullopt;
}

Result<std::vector<ClosedGap>> closeGaps(FractureMap& map, double reach,
                                         std::vector<uint32_t>& lineOf) {
    if (!(reach > 0)) return std::vector<ClosedGap>();  // no number reaches nowhere
    const Result<PlanarMap> planar = planarise(map);
    if (!planar) return tl::unexpected(planar.error());
    MapIndex index(*planar);
    std::vector<ClosedGap> closed;
    for (const DanglingEnd& end : danglingEnds(*planar)) {
        const std::optional<Target> target = nearestLine(*planar, index, end, reach);
        if (!target) continue;
        const uint32_t own = planar->edges[end.edge].line;
        const ClosedGap gap{nodeUv(*planar, end.node), onGrid(target->place)};
        addCorner(map.lines[target->line], gap.to);
        FractureMap::Line bridge = map.lines[own];
        bridge.points = {gap.from, gap.to};
        map.lines.push_back(std::move(bridge));
        lineOf.push_back(own);
        closed.push_back(gap);
    }
    return closed;
}

}  // namespace sherd
