// SPDX-License-Identifier: MIT
// Polyhedral mass properties by signed tetrahedra (B. Mirtich, Fast and Accurate Computation of
// Polyhedral Mass Properties, 1996; the second moments in the form of J. Blow and A. J. Binstock,
// How to find the inertia tensor of a 3D solid body, 2004). The apex is the middle of the bounding
// box: from the origin, a small object far away would lose all its digits to cancellation.
#include "physics/mass_properties.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

namespace sherd {
namespace {

glm::dvec3 middleOf(std::span<const glm::vec3> positions,
                    std::span<const std::array<uint32_t, 3>> triangles) {
    glm::vec3 low(positions[triangles[0][0]]);
    glm::vec3 high = low;
    for (const auto& t : triangles) {
        for (const uint32_t v : t) {
            low = glm::min(low, positions[v]);
            high = glm::max(high, positions[v]);
        }
    }
    return 0.5 * (glm::dvec3(low) + glm::dvec3(high));
}

/// Second moments of a point mass at d, or the step of the parallel axis theorem.
glm::dmat3 pointInertia(const glm::dvec3& d) {
    return glm::dmat3(glm::dot(d, d)) - glm::outerProduct(d, d);
}

glm::dmat3 inertiaFromMoments(const glm::dmat3& moments) {
    return glm::dmat3(moments[0][0] + moments[1][1] + moments[2][2]) - moments;
}

}  // namespace

MassProperties massProperties(std::span<const glm::vec3> positions,
                              std::span<const std::array<uint32_t, 3>> triangles) {
    MassProperties out;
    if (triangles.empty()) return out;
    const glm::dvec3 apex = middleOf(positions, triangles);
    double volume6 = 0;
    glm::dvec3 first(0.0);
    glm::dmat3 second(0.0);
    for (const auto& t : triangles) {
        const glm::dvec3 a = glm::dvec3(positions[t[0]]) - apex;
        const glm::dvec3 b = glm::dvec3(positions[t[1]]) - apex;
        const glm::dvec3 c = glm::dvec3(positions[t[2]]) - apex;
        const double v6 = glm::dot(a, glm::cross(b, c));
        const glm::dvec3 sum = a + b + c;
        volume6 += v6;
        first += v6 * sum;
        second += v6 * (glm::outerProduct(a, a) + glm::outerProduct(b, b) +
                        glm::outerProduct(c, c) + glm::outerProduct(sum, sum));
    }
    out.volume = volume6 / 6;
    const glm::dvec3 offset = volume6 != 0 ? first / (4 * volume6) : glm::dvec3(0.0);
    out.center = apex + offset;
    out.inertia = inertiaFromMoments(second / 120.0) - out.volume * pointInertia(offset);
    return out;
}

bool isPhysical(const MassProperties& mass) {
    const glm::dvec3 d = principalAxes(mass.inertia).diagonal;
    const double largest = std::max({d.x, d.y, d.z});
    return mass.volume > 0 && std::min({d.x, d.y, d.z}) > 0 &&
           largest <= (d.x + d.y + d.z - largest) * (1 + 1e-6);
}

MassProperties combine(std::span<const MassProperties> parts) {
    MassProperties out;
    if (parts.empty()) return out;
    const glm::dvec3 origin = parts[0].center;
    glm::dvec3 first(0.0);
    for (const MassProperties& part : parts) {
        out.volume += part.volume;
        first += part.volume * (part.center - origin);
    }
    out.center = origin + (out.volume != 0 ? first / out.volume : glm::dvec3(0.0));
    for (const MassProperties& part : parts) {
        out.inertia += part.inertia + part.volume * pointInertia(part.center - out.center);
    }
    return out;
}

/// Cyclic Jacobi (C. G. J. Jacobi, 1846; stable angle after G. H. Golub and C. F. Van Loan).
PrincipalAxes principalAxes(const glm::dmat3& tensor) {
    glm::dmat3 m = 0.5 * (tensor + glm::transpose(tensor));
    glm::dmat3 axes(1.0);
    double scale = 0;
    for (int c = 0; c < 3; ++c) scale = std::max(scale, glm::length(m[c]));
    constexpr std::array<std::pair<int, int>, 3> kPairs = {{{0, 1}, {0, 2}, {1, 2}}};
    for (int sweep = 0; sweep < 32; ++sweep) {
        bool done = true;
        for (const auto& [p, q] : kPairs) {
            if (!(std::abs(m[p][q]) > 1e-15 * scale)) continue;
            done = false;
            const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
            const double t =
                (theta >= 0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
            const double c = 1 / std::sqrt(t * t + 1);
            const double s = t * c;
            glm::dmat3 turn(1.0);
            turn[p][p] = turn[q][q] = c;
            turn[q][p] = s;
            turn[p][q] = -s;
            m = glm::transpose(turn) * m * turn;
            m[p][q] = m[q][p] = 0;
            axes = axes * turn;
        }
        if (done) break;
    }
    PrincipalAxes out;
    out.diagonal = {m[0][0], m[1][1], m[2][2]};
    glm::dquat orientation = glm::normalize(glm::quat_cast(axes));
    if (orientation.w < 0) orientation = -orientation;
    out.orientation = glm::quat(orientation);
    return out;
}

}  // namespace sherd
