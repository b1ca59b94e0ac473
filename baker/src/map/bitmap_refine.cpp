// SPDX-License-Identifier: MIT
// Thinning follows texels. Both edges of a drawn line are known better than that from how dark the
// texels on them are; its centre is half-way between them.
#include "map/bitmap_refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace sherd {

namespace {

constexpr double kStep = 0.5;        ///< texels between samples on the way to an edge
constexpr double kWidest = 256;      ///< wider ones are no lines; the time goes with the ink
constexpr size_t kTangentReach = 3;  ///< points: a texel's step is a third of it

/// Index `i` moved by `by` along the line: round a closed one, no further than the ends otherwise.
size_t along(const CentreLine& line, size_t i, ptrdiff_t by) {
    const auto last = static_cast<ptrdiff_t>(line.points.size()) - 1;
    const ptrdiff_t at = static_cast<ptrdiff_t>(i) + by;
    if (line.closed()) return static_cast<size_t>((at % last + last) % last);
    return static_cast<size_t>(std::clamp<ptrdiff_t>(at, 0, last));
}

/// The weighted mean of the points around `i`; near an end of as many on either side.
glm::dvec2 mean(const CentreLine& line, const std::vector<glm::dvec2>& points, size_t i) {
    constexpr std::array<double, 3> kWeights{3, 2, 1};
    size_t reach = kWeights.size() - 1;
    if (!line.closed()) reach = std::min({reach, i, line.points.size() - 1 - i});
    glm::dvec2 sum = kWeights[0] * points[i];
    double weight = kWeights[0];
    for (size_t k = 1; k <= reach; ++k) {
        const auto by = static_cast<ptrdiff_t>(k);
        sum += kWeights[k] * (points[along(line, i, -by)] + points[along(line, i, by)]);
        weight += 2 * kWeights[k];
    }
    return sum / weight;
}

std::vector<glm::dvec2> positions(const CentreLine& line) {
    std::vector<glm::dvec2> result;
    result.reserve(line.points.size());
    for (const CentrePoint& point : line.points) result.push_back(point.at);
    return result;
}

void smooth(CentreLine& line) {
    const std::vector<glm::dvec2> points = positions(line);
    for (size_t i = 0; i < points.size(); ++i) line.points[i].at = mean(line, points, i);
    if (line.closed()) line.points.back() = line.points.front();
}

void centre(CentrePoint& point, glm::dvec2 tangent, const InkField& field) {
    if (tangent == glm::dvec2(0.0) || point.radius > kWidest || field.at(point.at) <= 0) return;
    const glm::dvec2 normal = glm::normalize(glm::dvec2(-tangent.y, tangent.x));
    const double reach = 1.5 * point.radius + 2;
    const std::optional<double> left = field.edge(point.at, normal, reach);
    const std::optional<double> right = field.edge(point.at, -normal, reach);
    if (!left || !right) return;
    point.at += normal * ((*left - *right) / 2);
    point.radius = (*left + *right) / 2;
}

}  // namespace

double InkField::at(glm::dvec2 p) const {
    const Raster<uint8_t>& darkness = ink_.darkness;
    const double x = std::clamp(p.x - 0.5, 0.0, darkness.width - 1.0);
    const double y = std::clamp(p.y - 0.5, 0.0, darkness.height - 1.0);
    const int x0 = std::min(static_cast<int>(x), std::max(darkness.width - 2, 0));
    const int y0 = std::min(static_cast<int>(y), std::max(darkness.height - 2, 0));
    const double fx = x - x0;
    const double fy = y - y0;
    const size_t i = darkness.index(x0, y0);
    const uint8_t* value = &darkness.values[i];
    const size_t below = darkness.stride();
    return (1 - fy) * ((1 - fx) * value[0] + fx * value[1]) +
           fy * ((1 - fx) * value[below] + fx * value[below + 1]) - ink_.threshold;
}

std::optional<double> InkField::edge(glm::dvec2 p, glm::dvec2 unit, double reach) const {
    double before = at(p);
    if (before <= 0) return 0;
    for (double distance = kStep; distance <= reach + kStep; distance += kStep) {
        const glm::dvec2 next = p + distance * unit;
        if (!isInside(next)) return std::nullopt;
        const double value = at(next);
        if (value <= 0) return distance - kStep * value / (value - before);
        before = value;
    }
    return std::nullopt;
}

void refineLine(CentreLine& line, const InkField& field) {
    // Tangents come from a smoothed copy: the steps of texels would turn them by 45 degrees.
    CentreLine guide = line;
    smooth(guide);
    const size_t last = line.points.size() - 1;
    for (size_t i = line.closed() ? 0 : 1; i < last; ++i) {
        const auto reach = static_cast<ptrdiff_t>(
            line.closed() ? kTangentReach : std::min({kTangentReach, i, last - i}));
        const glm::dvec2 tangent =
            guide.points[along(line, i, reach)].at - guide.points[along(line, i, -reach)].at;
        centre(line.points[i], tangent, field);
    }
    if (line.closed()) line.points.back() = line.points.front();
    smooth(line);
}

}  // namespace sherd
