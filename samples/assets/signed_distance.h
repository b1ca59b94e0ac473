// SPDX-License-Identifier: MIT
// Shapes as functions of space, negative inside, that blend into each other.
// After I. Quilez, "Distance functions" and "Smooth minimum".
#pragma once

#include <functional>
#include <glm/vec3.hpp>

namespace sherd::samples {

/// About the distance to the surface, metres; exact where it is zero.
using ShapeFunction = std::function<double(const glm::dvec3&)>;

/// The union, its inner edges rounded over about `blend` metres.
double blendUnion(double a, double b, double blend);

/// `a` without `b`, its edges rounded over about `blend` metres.
double blendCut(double a, double b, double blend);

/// The common part, its edges rounded over about `blend` metres.
double blendCommon(double a, double b, double blend);

double ellipsoid(const glm::dvec3& p, const glm::dvec3& center, const glm::dvec3& radii);

/// A limb from `a` to `b`, its radius changing evenly along the way.
double limb(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double radiusA,
            double radiusB);

/// A box of these half sizes, edges rounded by `rounding` within them.
double roundBox(const glm::dvec3& p, const glm::dvec3& center, const glm::dvec3& half,
                double rounding);

/// Where the function grows fastest, by differences over `step` metres; not normalised.
glm::dvec3 gradient(const ShapeFunction& shape, const glm::dvec3& p, double step);

}  // namespace sherd::samples
