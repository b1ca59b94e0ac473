// SPDX-License-Identifier: MIT
// Every fragment's centre of mass and inertia, from the leaves' meshes and densities upwards: one
// wrong number is found where it stands and not again in all that contains it.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "check_context.h"

namespace sherd {

namespace {

constexpr double kTolerance = 1e-3;  ///< share of the fragment's size, and of its largest moment

struct Body {
    double mass = 0;
    glm::dvec3 center{0};
    glm::dmat3 inertia{0};  ///< about the centre
    double reach = 0;       ///< metres: largest coordinate, which bounds what floats round
    double slack = 0;       ///< kg m^2: what rounding may add to the inertia
    bool known = true;      ///< false: only whether the stored moments are physical can be told
};

glm::dmat3 storedInertia(const Fragment& fragment) {
    const glm::dmat3 turn = glm::mat3_cast(glm::normalize(glm::dquat(fragment.inertiaOrientation)));
    glm::dmat3 scaled = turn;
    for (int a = 0; a < 3; ++a) scaled[a] *= double{fragment.inertiaDiagonal[a]};
    return scaled * glm::transpose(turn);
}

/// Some body has these moments: none is larger than the two others together.
bool isPhysical(const glm::vec3& moments) {
    const glm::dvec3 d(moments);
    const double largest = std::max({d.x, d.y, d.z});
    return largest > 0 && std::min({d.x, d.y, d.z}) >= 0 &&
           2 * largest <= (d.x + d.y + d.z) * (1 + 1e-5);
}

/// Positive definite by its leading minors (J. J. Sylvester, 1852). That of a solid is; that of a
/// mesh that passes through itself need not be.
bool isPositive(const glm::dmat3& m) {
    const double plane = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    return m[0][0] > 0 && plane > 1e-12 * m[0][0] * m[1][1] &&
           glm::determinant(m) > 1e-12 * plane * m[2][2] && m[2][2] > 0;
}

double largestEntry(const glm::dmat3& m) {
    double largest = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(m[c][r]));
    return largest;
}

Body leafBody(const Fragment& leaf, const MeshMeasures& mesh) {
    Body body;
    body.reach = std::max(glm::length(mesh.low), glm::length(mesh.high));
    const bool solid = mesh.edges.count == 0 && mesh.volume > 0;
    body.known = solid && isPositive(mesh.covariance);
    body.mass = solid ? leaf.density * mesh.volume : double{leaf.mass};
    body.center = solid ? mesh.centroid : glm::dvec3(leaf.centerOfMass);
    body.inertia =
        body.known ? double{leaf.density} * inertiaOf(mesh.covariance) : storedInertia(leaf);
    return body;
}

Body combined(const std::vector<Body>& bodies, const Range& children) {
    Body body;
    const glm::dvec3 origin = bodies[children.first].center;
    glm::dvec3 moment(0);
    for (uint32_t c = children.first; c < children.first + children.count; ++c) {
        body.mass += bodies[c].mass;
        moment += bodies[c].mass * (bodies[c].center - origin);
        body.reach = std::max(body.reach, bodies[c].reach);
    }
    body.center = origin + (body.mass > 0 ? moment / body.mass : glm::dvec3(0));
    for (uint32_t c = children.first; c < children.first + children.count; ++c) {
        const glm::dvec3 d = bodies[c].center - body.center;
        body.inertia += bodies[c].inertia + bodies[c].mass * inertiaOf(glm::outerProduct(d, d));
        body.slack += bodies[c].slack + 1e-6 * bodies[c].mass * glm::length(d) * body.reach;
    }
    return body;
}

void checkBody(CheckContext& context, uint32_t f, const Body& body) {
    const Fragment& fragment = context.set.fragments[f];
    const MeshMeasures& mesh = context.measures[f];
    const double size = glm::distance(mesh.low, mesh.high);
    const double off = glm::distance(glm::dvec3(fragment.centerOfMass), body.center);
    // A coordinate far from the origin is rounded to 2^-24 of its size, a centroid to a few times
    // that; the centroid of a thin shell is a quotient of small differences.
    const double quotient = mesh.volume > 0 ? 1e-13 * size * size * size * size / mesh.volume : 0.0;
    if (off > kTolerance * size + 1e-6 * body.reach + quotient)
        context.find(Severity::failure, "center_of_mass_wrong", static_cast<int32_t>(f),
                     "CENTER_OF_MASS lies " + shortNumber(off) + " m from the centroid of its " +
                         (fragment.children.count > 0 ? "leaves" : "mesh"),
                     "/fragments/attributes/CENTER_OF_MASS");
    if (!isPhysical(fragment.inertiaDiagonal))
        return context.find(Severity::failure, "inertia_wrong", static_cast<int32_t>(f),
                            "no body has the moments that INERTIA_DIAGONAL says",
                            "/fragments/attributes/INERTIA_DIAGONAL");
    if (!body.known) return;
    const double difference = largestEntry(storedInertia(fragment) - body.inertia);
    const double largest = largestEntry(body.inertia);
    if (difference > kTolerance * largest + body.slack)
        context.find(Severity::failure, "inertia_wrong", static_cast<int32_t>(f),
                     "the inertia tensor is off by " + shortNumber(difference) +
                         " kg m^2; its largest entry should be " + shortNumber(largest),
                     "/fragments/attributes/INERTIA_DIAGONAL");
}

}  // namespace

void checkCentersAndInertia(CheckContext& context) {
    const std::vector<Fragment>& fragments = context.set.fragments;
    std::vector<Body> bodies(fragments.size());
    for (size_t f = fragments.size(); f-- > 0;) {  // children come after their parents
        const Range children = fragments[f].children;
        bodies[f] = children.count > 0 ? combined(bodies, children)
                                       : leafBody(fragments[f], context.measures[f]);
    }
    for (uint32_t f = 0; f < fragments.size(); ++f) checkBody(context, f, bodies[f]);
}

}  // namespace sherd
