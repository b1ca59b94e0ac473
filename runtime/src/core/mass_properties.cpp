// SPDX-License-Identifier: MIT
#include "core/mass_properties.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace sherd {
namespace {

/// Of a mass in one point, about the origin.
glm::dmat3 pointInertia(double mass, const glm::dvec3& r) {
    return mass * (glm::dmat3(glm::dot(r, r)) - glm::outerProduct(r, r));
}

/// Turns `m` in the plane of axes p and q until its entry there is zero, and `axes` along.
void rotateAway(glm::dmat3& m, glm::dmat3& axes, int p, int q) {
    if (m[p][q] == 0) return;
    const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    const double t = (theta >= 0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    glm::dmat3 turn(1.0);
    turn[p][p] = turn[q][q] = c;
    turn[q][p] = s;
    turn[p][q] = -s;
    m = glm::transpose(turn) * m * turn;
    axes = axes * turn;
}

}  // namespace

MassProperties massOf(const Fragment& fragment) {
    const glm::dmat3 axes = glm::mat3_cast(glm::normalize(glm::dquat(fragment.inertiaOrientation)));
    glm::dmat3 diagonal(0.0);
    for (int k = 0; k < 3; ++k) diagonal[k][k] = double(fragment.inertiaDiagonal[k]);
    return {double(fragment.mass), glm::dvec3(fragment.centerOfMass),
            axes * diagonal * glm::transpose(axes)};
}

MassProperties operator+(const MassProperties& a, const MassProperties& b) {
    const double mass = a.mass + b.mass;
    if (!(mass > 0)) return {};
    const glm::dvec3 center = (a.mass * a.center + b.mass * b.center) / mass;
    return {mass, center,
            a.inertia + b.inertia + pointInertia(a.mass, a.center - center) +
                pointInertia(b.mass, b.center - center)};
}

/// Jacobi's method: a symmetric 3 x 3 matrix is diagonal after a few sweeps.
PrincipalInertia principalInertia(const MassProperties& mass) {
    constexpr int kMaxSweeps = 24;
    constexpr double kNothing = 1e-9;  // of the diagonal: a cube keeps its axes
    glm::dmat3 m = mass.inertia, axes(1.0);
    for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
        const double off = std::abs(m[0][1]) + std::abs(m[0][2]) + std::abs(m[1][2]);
        const double on = std::abs(m[0][0]) + std::abs(m[1][1]) + std::abs(m[2][2]);
        if (!(off > kNothing * on)) break;
        rotateAway(m, axes, 0, 1);
        rotateAway(m, axes, 0, 2);
        rotateAway(m, axes, 1, 2);
    }
    PrincipalInertia result;
    result.diagonal = glm::vec3(glm::dvec3(m[0][0], m[1][1], m[2][2]));
    result.orientation = glm::quat(glm::normalize(glm::quat_cast(axes)));
    return result;
}

}  // namespace sherd
