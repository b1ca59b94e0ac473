// SPDX-License-Identifier: MIT
#include "surface/chords.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace sherd {
namespace {

/// The end of a chord as a place of the triangle's border; nothing inside.
std::optional<CutEnd> borderPlace(GridPoint p) {
    const auto corner = [](uint8_t k) { return CutEnd{CutEnd::Where::corner, k, {}, 0}; };
    const auto edge = [](uint8_t k, int64_t steps) {
        return CutEnd{CutEnd::Where::edge, k, {steps, kGridOne}, 0};
    };
    const bool onDiagonal = p.u + p.v == kGridOne;
    if (p.v == 0) {
        if (p.u == 0) return corner(0);
        return onDiagonal ? corner(1) : edge(0, p.u);
    }
    if (p.u == 0) return onDiagonal ? corner(2) : edge(2, kGridOne - p.v);
    if (onDiagonal) return edge(1, p.v);
    return std::nullopt;
}

void append(const PlanarMap& local, std::span<const Chord> chords, std::vector<Cut>& cuts,
            ChordCuts& out) {
    const auto nodes = static_cast<uint32_t>(out.map.nodes.size());
    const auto supports = static_cast<uint32_t>(out.map.supports.size());
    const auto edges = static_cast<uint32_t>(out.map.edges.size());
    out.map.supports.insert(out.map.supports.end(), local.supports.begin(), local.supports.end());
    for (MapNode node : local.nodes) {
        if (node.first >= 0) {
            node.first += static_cast<int32_t>(supports);
            node.second += static_cast<int32_t>(supports);
        }
        out.map.nodes.push_back(node);
    }
    for (MapEdge edge : local.edges) {
        edge.from += nodes;
        edge.to += nodes;
        edge.support += supports;
        out.map.edges.push_back(edge);
    }
    for (Cut& cut : cuts) {
        cut.line = chords[local.edges[cut.mapEdge].line].line;
        cut.mapEdge += edges;
        cut.from.node += nodes;
        cut.to.node += nodes;
        out.cuts.push_back(cut);
    }
}

/// The arrangement of several chords of one triangle.
Result<void> arrange(std::span<const Chord> chords, ChordCuts& out) {
    FractureMap lines;
    for (const Chord& chord : chords) {
        const auto exact = [](GridPoint p) { return glm::dvec2(p.u, p.v) / double{kGridOne}; };
        // As its level the line's mark: where chords overlap the coarser line counts.
        lines.lines.push_back({{exact(chord.a), exact(chord.b)}, chord.line, ""});
    }
    const Result<PlanarMap> local = planarise(lines);
    if (!local) return tl::unexpected(local.error());
    std::vector<uint32_t> all(local->edges.size());
    for (uint32_t e = 0; e < all.size(); ++e) all[e] = e;
    std::vector<Cut> cuts;
    matchInTriangle(*local, all, chords[0].triangle, unitFrame(), cuts);
    append(*local, chords, cuts, out);
    return {};
}

}  // namespace

const UvTriangle& unitFrame() {
    static const UvTriangle frame{{GridPoint{0, 0}, GridPoint{kGridOne, 0}, GridPoint{0, kGridOne}},
                                  UvKind::regular};
    return frame;
}

GridPoint onHalfEdge(uint32_t k, int32_t steps) {
    if (k == 0) return {steps, 0};
    if (k == 1) return {kGridOne - steps, steps};
    return {0, kGridOne - steps};
}

GridPoint onFrame(const glm::dvec3& weights) {
    const auto round = [](double w) {
        return static_cast<int32_t>(std::lround(std::clamp(w, 0.0, 1.0) * kGridOne));
    };
    const int32_t u = round(weights.y);
    return {u, std::min(round(weights.z), kGridOne - u)};
}

glm::dvec3 weightsOf(GridPoint point) {
    const double u = double{1} * point.u / kGridOne;
    const double v = double{1} * point.v / kGridOne;
    return {1 - u - v, u, v};
}

Result<ChordCuts> cutsOfChords(std::span<const Chord> chords) {
    std::vector<Chord> sorted;
    sorted.reserve(chords.size());
    std::copy_if(chords.begin(), chords.end(), std::back_inserter(sorted),
                 [](const Chord& chord) { return chord.a != chord.b; });
    std::sort(sorted.begin(), sorted.end(), [](const Chord& x, const Chord& y) {
        return std::tie(x.triangle, x.line, x.a, x.b) < std::tie(y.triangle, y.line, y.a, y.b);
    });
    ChordCuts out;
    for (size_t i = 0; i < sorted.size();) {
        size_t end = i + 1;
        while (end < sorted.size() && sorted[end].triangle == sorted[i].triangle) ++end;
        const auto from = borderPlace(sorted[i].a);
        const auto to = borderPlace(sorted[i].b);
        if (end == i + 1 && from && to) {
            out.cuts.push_back({sorted[i].triangle, *from, *to, sorted[i].line, 0});
        } else if (auto ok = arrange(std::span(sorted).subspan(i, end - i), out); !ok) {
            return tl::unexpected(ok.error());
        }
        i = end;
    }
    return out;
}

}  // namespace sherd
