// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "map/centre_graph.h"

namespace sherd {

/// A straight line through points: where it is and its direction.
struct StraightFit {
    glm::dvec2 centre{0.0};
    glm::dvec2 direction{0.0};  ///< unit, from the first point to the last
};

/// Total least squares (K. Pearson, 1901). Nothing if the points are all one.
std::optional<StraightFit> fitStraight(std::span<const CentrePoint> points);

double distanceTo(const StraightFit& fit, glm::dvec2 point);

/// Where a drawn line goes on straight, away from a place that bends its centre line.
struct ArmFit {
    StraightFit fit;
    size_t leaning = 0;  ///< first points that are not on it yet
};
/// Through as many of the first points as are straight, but at least `least`: the longer, the
/// better the direction is known through the steps of texels. Where they are a smooth curve
/// instead, the tangent of their parabola at the place, `reach` texels before the first
/// (given 0, curves are not asked for).
std::optional<ArmFit> fitArm(std::span<const CentrePoint> points, size_t least, double reach = 0);

/// The point nearest to all lines (least squares of its distances), held at `prior` where they
/// leave it open.
glm::dvec2 meetingPoint(std::span<const StraightFit> lines, glm::dvec2 prior);

double medianRadius(std::span<const CentrePoint> points);

}  // namespace sherd
