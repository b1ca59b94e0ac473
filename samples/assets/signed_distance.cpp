// SPDX-License-Identifier: MIT
#include "signed_distance.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sherd::samples {

double blendUnion(double a, double b, double blend) {
    const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - h * h * blend / 4;
}

double blendCommon(double a, double b, double blend) {
    return -blendUnion(-a, -b, blend);
}

double blendCut(double a, double b, double blend) {
    return blendCommon(a, -b, blend);
}

double ellipsoid(const glm::dvec3& p, const glm::dvec3& center, const glm::dvec3& radii) {
    const glm::dvec3 q = (p - center) / radii;
    const double k = glm::length(q);
    const double slope = glm::length(q / radii);
    return slope == 0 ? -std::min({radii.x, radii.y, radii.z}) : k * (k - 1) / slope;
}

double limb(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double radiusA,
            double radiusB) {
    const glm::dvec3 along = b - a;
    const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::distance(p, a + along * t) - glm::mix(radiusA, radiusB, t);
}

double roundBox(const glm::dvec3& p, const glm::dvec3& center, const glm::dvec3& half,
                double rounding) {
    const glm::dvec3 q = glm::abs(p - center) - half + rounding;
    return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0) - rounding;
}

glm::dvec3 gradient(const ShapeFunction& shape, const glm::dvec3& p, double step) {
    const auto along = [&](const glm::dvec3& axis) {
        return shape(p + axis * step) - shape(p - axis * step);
    };
    return glm::dvec3(along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})) / (2 * step);
}

}  // namespace sherd::samples
