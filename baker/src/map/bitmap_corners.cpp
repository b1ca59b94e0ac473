// SPDX-License-Identifier: MIT
// A corner of a drawn line is rounded by thinning, the more the wider the line: the disc of ink
// there touches the inner corner and the outer sides. Its two sides are not.
#include "map/bitmap_junctions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "map/line_fit.h"

namespace sherd {

namespace {

constexpr double kLeastTurn = 0.6;  ///< radians: flatter corners are rounded by less than tolerance
constexpr double kMostTurn = 2.8;
constexpr double kMostAside =
    1.5;  ///< texels beside the line that halves a corner, with half a radius
constexpr double kLeastHeight = 1;  ///< texels over the chord beside it
constexpr double kInkStep = 0.25;   ///< texels
constexpr double kMostPull = 2.5;   ///< texels between where two sides meet and their ink

struct Corner {
    size_t begin = 0, end = 0;  ///< the points between which it is
    glm::dvec2 at{0.0};
};

/// The points from `near` before (or after) point `i` on, away from it.
std::vector<CentrePoint> awayFrom(const CentreLine& line, size_t i, size_t near, size_t count,
                                  bool before) {
    std::vector<CentrePoint> points;
    for (size_t k = near; points.size() < count; ++k) {
        if (before ? k > i : i + k >= line.points.size()) break;
        points.push_back(line.points[before ? i - k : i + k]);
    }
    return points;
}

struct Sides {
    ArmFit in, out;  ///< both away from the corner
    size_t near = 0;
    double turn = 0;
};

/// The two sides of point `i`, leaving out `near` points on either side of it; `most` at most.
std::optional<Sides> sidesAt(const CentreLine& line, size_t i, size_t near, double radius,
                             size_t most) {
    const size_t least = std::max<size_t>(6, static_cast<size_t>(2 * radius));
    if (i + 1 < near + least || i + near + least > line.points.size()) return std::nullopt;
    const auto in = fitArm(awayFrom(line, i, near, most * least, true), least);
    const auto out = fitArm(awayFrom(line, i, near, most * least, false), least);
    if (!in || !out) return std::nullopt;
    const double along = std::clamp(-glm::dot(in->fit.direction, out->fit.direction), -1.0, 1.0);
    return Sides{*in, *out, near, std::acos(along)};
}

/// The furthest ink in a direction, up to `reach`; from outside, as the centre points of a thin
/// line are cut off from the ink of its corner.
double lastInk(const InkField& field, glm::dvec2 from, glm::dvec2 unit, double reach) {
    double distance = reach;
    while (distance > 0 && field.at(from + distance * unit) <= 0) distance -= kInkStep;
    return std::max(distance, 0.0);
}

std::optional<Corner> cornerAt(const CentreLine& line, size_t i, double radius,
                               const InkField& field) {
    std::optional<Sides> sides = sidesAt(line, i, static_cast<size_t>(radius) + 2, radius, 1);
    if (!sides || sides->turn < kLeastTurn || sides->turn > kMostTurn) return std::nullopt;
    // From where the ink of the two sides is apart.
    const auto apart = static_cast<size_t>((radius + 0.5) * std::tan(sides->turn / 2)) + 2;
    for (const size_t near : {apart, sides->near})
        if (const auto clear = sidesAt(line, i, near, radius, 8)) {
            sides = clear;
            break;
        }
    const StraightFit both[] = {sides->in.fit, sides->out.fit};
    glm::dvec2 at = meetingPoint(both, line.points[i].at);
    glm::dvec2 outward = -sides->in.fit.direction - sides->out.fit.direction;
    if (glm::length(outward) == 0) return std::nullopt;
    outward = glm::normalize(outward);
    // No further out than the ink allows: what is no corner but a bend stays where it is, and sides
    // at a sharp angle, whose meeting point is the least certain, do not overshoot.
    const double out = glm::dot(at - line.points[i].at, outward);
    const glm::dvec2 inside = at - out * outward;
    const double allowed = lastInk(field, inside, outward, out + radius + 1) - radius;
    if (out < 0 || out - allowed > kMostPull) return std::nullopt;
    at = inside + std::max(std::min(out, allowed), 0.0) * outward;
    if (glm::distance(inside, line.points[i].at) > kMostAside + radius / 2) return std::nullopt;
    return Corner{i - sides->near - sides->in.leaning, i + sides->near + sides->out.leaning, at};
}

/// How far every point stands out from the chord between those `reach` before and after it: most at
/// the tip of a corner. Nearer to an end of the line the chord is shorter.
std::vector<double> heights(const CentreLine& line, size_t reach) {
    std::vector<double> result(line.points.size(), 0);
    for (size_t i = 0; i < line.points.size(); ++i) {
        const size_t k = std::min({reach, i, line.points.size() - 1 - i});
        if (k == 0) continue;
        result[i] =
            glm::distance(line.points[i].at, (line.points[i - k].at + line.points[i + k].at) / 2.0);
    }
    return result;
}

/// Lets a closed line start in its straightest place: a corner at its start is not found.
void startAwayFromCorners(CentreLine& line) {
    std::vector<CentrePoint>& points = line.points;
    const size_t count = points.size() - 1;
    const size_t reach = std::min<size_t>(count / 4, 8);
    if (reach == 0) return;
    points.pop_back();
    size_t best = 0;
    double straightest = -2;
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec2 in = points[i].at - points[(i + count - reach) % count].at;
        const glm::dvec2 out = points[(i + reach) % count].at - points[i].at;
        const double scale = glm::length(in) * glm::length(out);
        const double along = scale > 0 ? glm::dot(in, out) / scale : -1;
        if (along <= straightest) continue;
        straightest = along;
        best = i;
    }
    std::rotate(points.begin(), points.begin() + static_cast<ptrdiff_t>(best), points.end());
    points.push_back(points.front());
}

std::vector<Corner> findCorners(const CentreLine& line, double radius, const InkField& field) {
    const size_t reach = static_cast<size_t>(2 * radius) + 6;
    const std::vector<double> height = heights(line, reach);
    std::vector<Corner> corners;
    for (size_t i = 1; i + 1 < height.size(); ++i) {
        if (height[i] < kLeastHeight) continue;
        const size_t begin = i - std::min(i, reach / 2);
        const size_t end = std::min(i + reach / 2 + 1, height.size());
        const auto highest = std::max_element(height.begin() + static_cast<ptrdiff_t>(begin),
                                              height.begin() + static_cast<ptrdiff_t>(end));
        if (highest - height.begin() != static_cast<ptrdiff_t>(i)) continue;
        const std::optional<Corner> corner = cornerAt(line, i, radius, field);
        if (corner && (corners.empty() || corner->begin >= corners.back().end))
            corners.push_back(*corner);
    }
    return corners;
}

}  // namespace

std::vector<size_t> sharpenCorners(CentreLine& line, const InkField& field) {
    if (line.closed()) startAwayFromCorners(line);
    const double radius = medianRadius(line.points);
    const std::vector<Corner> corners = findCorners(line, radius, field);
    std::vector<size_t> indices;
    std::vector<CentrePoint> points;
    size_t next = 0;
    for (const Corner& corner : corners) {
        for (; next <= corner.begin; ++next) points.push_back(line.points[next]);
        indices.push_back(points.size());
        points.push_back({corner.at, radius});
        next = std::max(next, corner.end);
    }
    for (; next < line.points.size(); ++next) points.push_back(line.points[next]);
    line.points = std::move(points);
    return indices;
}

}  // namespace sherd
