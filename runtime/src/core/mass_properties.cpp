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

// Second moments and inertia tell the same: the trace of the one less the one is the other.
MassMoments momentsAbout(const glm::dvec3& point, const MassProperties& mass) {
    const glm::dvec3 r = mass.center - point;
    const glm::dmat3& i = mass.inertia;
    const double half = 0.5 * (i[0][0] + i[1][1] + i[2][2]);
    MassMoments moments;
    moments.mass = mass.mass;
    moments.x = mass.mass * r.x;
    moments.y = mass.mass * r.y;
    moments.z = mass.mass * r.z;
    moments.xx = half - i[0][0] + moments.x * r.x;
    moments.yy = half - i[1][1] + moments.y * r.y;
    moments.zz = half - i[2][2] + moments.z * r.z;
    moments.xy = moments.x * r.y - i[1][0];
    moments.xz = moments.x * r.z - i[2][0];
    moments.yz = moments.y * r.z - i[2][1];
    return moments;
}

MassProperties propertiesOf(const MassMoments& moments, const glm::dvec3& point) {
    if (!(moments.mass > 0)) return {};
    const glm::dvec3 r = glm::dvec3(moments.x, moments.y, moments.z) / moments.mass;
    const double xx = moments.xx - moments.x * r.x, yy = moments.yy - moments.y * r.y,
                 zz = moments.zz - moments.z * r.z, xy = moments.xy - moments.x * r.y,
                 xz = moments.xz - moments.x * r.z, yz = moments.yz - moments.y * r.z;
    const glm::dmat3 second(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    return {moments.mass, point + r, glm::dmat3(xx + yy + zz) - second};
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
