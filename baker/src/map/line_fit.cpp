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

constexpr double kMostBow = 0.15;    ///< texels between a curve's middle and its chord
constexpr double kLeaning = 0.35;    ///< texels of a point from the straight line it is not yet on
constexpr double kLeastCurve = 0.5;  ///< texels of bow that no noise makes
constexpr double kMostStray = 0.6;   ///< texels of a point from the straight line

/// How the points stray from their straight line: as a parabola, square * (along^2 - mean).
struct Bend {
    double square = 0;
    double mean = 0;   ///< of along^2
    double bow = 0;    ///< of the parabola over the points
    double stray = 0;  ///< largest distance of a point
};

Bend bendOf(std::span<const CentrePoint> points, const StraightFit& fit) {
    const glm::dvec2 normal(-fit.direction.y, fit.direction.x);
    Bend bend;
    double reach = 0;
    for (const CentrePoint& point : points) {
        const double along = glm::dot(fit.direction, point.at - fit.centre);
        reach = std::max(reach, std::abs(along));
        bend.mean += along * along / static_cast<double>(points.size());
    }
    double product = 0;
    double weight = 0;
    for (const CentrePoint& point : points) {
        const double along = glm::dot(fit.direction, point.at - fit.centre);
        const double stray = glm::dot(normal, point.at - fit.centre);
        const double bent = along * along - bend.mean;
        product += stray * bent;
        weight += bent * bent;
        bend.stray = std::max(bend.stray, std::abs(stray));
    }
    if (weight > 0) bend.square = product / weight;
    bend.bow = std::abs(bend.square) * reach * reach;
    return bend;
}

/// Is nothing but texel noise between the points and the line?
bool isStraight(std::span<const CentrePoint> points, const StraightFit& fit) {
    const Bend bend = bendOf(points, fit);
    return bend.stray <= kMostStray && bend.bow <= kMostBow;
}

/// Is it a parabola, well above texel noise?
bool isCurve(std::span<const CentrePoint> points, const StraightFit& fit) {
    const Bend bend = bendOf(points, fit);
    if (bend.bow < kLeastCurve) return false;
    const glm::dvec2 normal(-fit.direction.y, fit.direction.x);
    return std::all_of(points.begin(), points.end(), [&](const CentrePoint& point) {
        const double along = glm::dot(fit.direction, point.at - fit.centre);
        const double aside = bend.square * (along * along - bend.mean);
        return std::abs(glm::dot(normal, point.at - fit.centre) - aside) <= kMostBow;
    });
}

/// The tangent of the points' parabola `reach` texels before the first of them.
StraightFit tangentBefore(std::span<const CentrePoint> points, const StraightFit& fit,
                          double reach) {
    const Bend bend = bendOf(points, fit);
    const glm::dvec2 normal(-fit.direction.y, fit.direction.x);
    const double along = glm::dot(fit.direction, points.front().at - fit.centre) - reach;
    const double aside = bend.square * (along * along - bend.mean);
    return {fit.centre + along * fit.direction + aside * normal,
            glm::normalize(fit.direction + 2 * bend.square * along * normal)};
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

std::optional<ArmFit> fitArm(std::span<const CentrePoint> points, size_t least, double reach) {
    const std::optional<StraightFit> first = fitStart(points, least);
    if (!first) return std::nullopt;
    ArmFit arm{*first, 0};
    while (arm.leaning + 3 < std::min(points.size(), least) &&
           distanceTo(*first, points[arm.leaning].at) > kLeaning)
        ++arm.leaning;
    const std::span<const CentrePoint> rest = points.subspan(arm.leaning);
    const std::optional<StraightFit> again = fitStart(rest, least);
    if (!again) return arm;
    arm.fit = *again;
    if (reach == 0) return arm;
    const std::span<const CentrePoint> stretch = rest.first(std::min(2 * least, rest.size()));
    const std::optional<StraightFit> chord = fitStraight(stretch);
    if (chord && stretch.size() == 2 * least && isCurve(stretch, *chord))
        arm.fit = tangentBefore(stretch, *chord, reach + static_cast<double>(arm.leaning));
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
