// SPDX-License-Identifier: MIT
#include "map/line_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sherd {

namespace {

// Of one line's weight: lines that meet at 15 degrees still decide where, and parallel ones do not
// send the point away.
constexpr double kPriorWeight = 0.005;

constexpr double kMostBow = 0.15;   ///< texels between a curve's middle and its chord
constexpr double kLeaning = 0.35;   ///< texels of a point from the straight line it is not yet on
constexpr double kMostStray = 0.6;  ///< texels of a point from the straight line

/// Is nothing but texel noise between the points and the line?
bool isStraight(std::span<const CentrePoint> points, const StraightFit& fit) {
    const glm::dvec2 normal(-fit.direction.y, fit.direction.x);
    double reach = 0;
    double meanSquare = 0;
    for (const CentrePoint& point : points) {
        const double along = glm::dot(fit.direction, point.at - fit.centre);
        reach = std::max(reach, std::abs(along));
        meanSquare += along * along / static_cast<double>(points.size());
    }
    // Least squares of the deviation by a parabola along the line.
    double product = 0;
    double square = 0;
    for (const CentrePoint& point : points) {
        const double along = glm::dot(fit.direction, point.at - fit.centre);
        const double stray = glm::dot(normal, point.at - fit.centre);
        if (std::abs(stray) > kMostStray) return false;
        const double bent = along * along - meanSquare;
        product += stray * bent;
        square += bent * bent;
    }
    return square == 0 || std::abs(product / square) * reach * reach <= kMostBow;
}

std::optional<StraightFit> fitStart(std::span<const CentrePoint> points, size_t least) {
    // The longest first: texel steps may bend a short stretch more than a long one.
    for (size_t count = points.size(); count > least; count = count * 3 / 4) {
        const std::optional<StraightFit> fit = fitStraight(points.first(count));
        if (fit && isStraight(points.first(count), *fit)) return fit;
    }
    return fitStraight(points.first(std::min(least, points.size())));
}

}  // namespace

std::optional<StraightFit> fitStraight(std::span<const CentrePoint> points) {
    if (points.empty()) return std::nullopt;
    StraightFit fit;
    for (const CentrePoint& point : points) fit.centre += point.at;
    fit.centre /= static_cast<double>(points.size());
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const CentrePoint& point : points) {
        const glm::dvec2 d = point.at - fit.centre;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    if (xx + yy == 0) return std::nullopt;
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    fit.direction = {std::cos(angle), std::sin(angle)};
    if (glm::dot(fit.direction, points.back().at - points.front().at) < 0)
        fit.direction = -fit.direction;
    return fit;
}

double distanceTo(const StraightFit& fit, glm::dvec2 point) {
    const glm::dvec2 normal(-fit.direction.y, fit.direction.x);
    return std::abs(glm::dot(normal, point - fit.centre));
}

std::optional<ArmFit> fitArm(std::span<const CentrePoint> points, size_t least) {
    const std::optional<StraightFit> first = fitStart(points, least);
    if (!first) return std::nullopt;
    ArmFit arm{*first, 0};
    while (arm.leaning + 3 < std::min(points.size(), least) &&
           distanceTo(*first, points[arm.leaning].at) > kLeaning)
        ++arm.leaning;
    if (arm.leaning == 0) return arm;
    if (const auto again = fitStart(points.subspan(arm.leaning), least)) arm.fit = *again;
    return arm;
}

glm::dvec2 meetingPoint(std::span<const StraightFit> lines, glm::dvec2 prior) {
    // Normal equations of sum |(I - d d^T) (x - centre)|^2, relative to the prior.
    double xx = kPriorWeight;
    double xy = 0;
    double yy = kPriorWeight;
    glm::dvec2 right{0.0};
    for (const StraightFit& line : lines) {
        const glm::dvec2 normal(-line.direction.y, line.direction.x);
        xx += normal.x * normal.x;
        xy += normal.x * normal.y;
        yy += normal.y * normal.y;
        right += normal * glm::dot(normal, line.centre - prior);
    }
    const double determinant = xx * yy - xy * xy;  // at least the square of the prior's weight
    return prior +
           glm::dvec2(yy * right.x - xy * right.y, xx * right.y - xy * right.x) / determinant;
}

double medianRadius(std::span<const CentrePoint> points) {
    if (points.empty()) return 0;
    std::vector<double> radii;
    radii.reserve(points.size());
    for (const CentrePoint& point : points) radii.push_back(point.radius);
    const auto middle = radii.begin() + static_cast<ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return *middle;
}

}  // namespace sherd
