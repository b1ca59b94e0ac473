// SPDX-License-Identifier: MIT
// Thinning ends a line about half its width before the ink does. A line drawn with a round brush
// ends there, at the centre of the brush; one that is cut off square ends with the ink. Towards its
// sides a round end stands back and a square one does not.
#include "map/bitmap_ends.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "map/line_fit.h"

namespace sherd {

namespace {

constexpr double kSide = 0.7;        ///< of the radius, where the end's shape is felt for
constexpr double kLeastRound = 1.2;  ///< texels; the shape of narrower ends cannot be told
constexpr double kTexelNoise = 0.1;  ///< of an edge's place: below that, shapes are alike

struct Shape {
    double mean = 0;
    double spread = 0;  ///< a high power of the deviation: the better shape decides
};

Shape meanAndSpread(const std::vector<double>& values) {
    Shape shape;
    for (const double v : values) shape.mean += v / static_cast<double>(values.size());
    double square = kTexelNoise * kTexelNoise * static_cast<double>(values.size());
    for (const double v : values) square += (v - shape.mean) * (v - shape.mean);
    shape.spread = square * square * square * square;
    return shape;
}

/// Where the ray leaves the picture.
double toBorder(glm::dvec2 from, glm::dvec2 unit, glm::dvec2 size) {
    double distance = HUGE_VAL;
    for (int k = 0; k < 2; ++k) {
        if (unit[k] > 0) distance = std::min(distance, (size[k] - from[k]) / unit[k]);
        if (unit[k] < 0) distance = std::min(distance, -from[k] / unit[k]);
    }
    return std::max(distance, 0.0);
}

/// How far from `from` along the axis the line was drawn: what both shapes of an end make of where
/// the ink ends, weighted by how well they explain it.
std::optional<double> drawnLength(const InkField& field, glm::dvec2 from, glm::dvec2 axis,
                                  double radius, double reach) {
    if (radius < kLeastRound) {
        const std::optional<double> tip = field.edge(from, axis, reach);
        return tip ? std::optional(*tip - radius / 2) : std::nullopt;
    }
    const glm::dvec2 side(-axis.y, axis.x);
    const int rays = std::max(2, static_cast<int>(2 * kSide * radius));  // on either side
    std::vector<double> square;
    std::vector<double> round;
    for (int k = -rays; k <= rays; ++k) {
        const double aside = kSide * radius * k / rays;
        const std::optional<double> edge = field.edge(from + aside * side, axis, reach);
        if (!edge || *edge == 0) continue;
        square.push_back(*edge);
        round.push_back(*edge - std::sqrt(radius * radius - aside * aside));
    }
    if (square.empty()) return std::nullopt;
    const Shape asSquare = meanAndSpread(square);
    const Shape asRound = meanAndSpread(round);
    const double weights = asSquare.spread + asRound.spread;
    if (weights == 0) return (asSquare.mean + asRound.mean) / 2;
    return (asSquare.mean * asRound.spread + asRound.mean * asSquare.spread) / weights;
}

/// `line` ends loosely at its last point.
void extendEnd(CentreLine& line, const InkField& field) {
    std::vector<CentrePoint>& points = line.points;
    const double radius = medianRadius(points);
    // The last texels lean to a corner of the end, or to noise on it.
    double trimmed = 0;
    while (points.size() > 6 && trimmed < std::max(radius, 1.0)) {
        trimmed += glm::distance(points.back().at, points[points.size() - 2].at);
        points.pop_back();
    }
    const auto window = std::min(points.size(), static_cast<size_t>(std::max(8.0, 4 * radius)));
    const auto fit = fitStraight(std::span(points).last(window));
    if (!fit) return;
    const glm::dvec2 axis = fit->direction;
    const glm::dvec2 from = fit->centre + axis * glm::dot(axis, points.back().at - fit->centre);
    const double border = toBorder(from, axis, field.size());
    const std::optional<double> tip = field.edge(from, axis, trimmed + 3 * radius + 4);
    glm::dvec2 end = from;
    if (!tip ? border <= trimmed + 3 * radius + 4 : border - *tip <= radius + 2)
        end = glm::clamp(from + border * axis, glm::dvec2(0.0), field.size());
    else if (const auto drawn = drawnLength(field, from, axis, radius, trimmed + 3 * radius + 4))
        end = from + axis * std::max(0.0, *drawn);
    if (end != points.back().at) points.push_back({end, radius});
}

}  // namespace

void extendEnds(CentreGraph& graph, const InkField& field) {
    for (uint32_t i = 0; i < graph.nodes.size(); ++i) {
        if (graph.degree(i) != 1) continue;
        CentreLine& line = graph.lines[graph.nodes[i].lines.front()];
        const bool turned = line.to != i;
        if (turned) reverse(line);
        extendEnd(line, field);
        graph.nodes[i].at = line.points.back().at;
        if (turned) reverse(line);
    }
}

}  // namespace sherd
