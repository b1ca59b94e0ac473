// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include "sherd/runtime/memory.h"

namespace sherd {

/// A small rigid motion (shift, turn) or what works on it (force, moment): twist and wrench of
/// screw theory.
struct Screw {
    glm::dvec3 linear{0.0};
    glm::dvec3 angular{0.0};
};

/// A symmetric 6 x 6 matrix from twists to wrenches, both at the same point:
/// force = linear shift + coupling turn, moment = coupling^T shift + angular turn.
struct Stiffness {
    glm::dmat3 linear{0.0};
    glm::dmat3 coupling{0.0};
    glm::dmat3 angular{0.0};
};

inline Screw operator*(const Stiffness& s, const Screw& x) {
    return {s.linear * x.linear + s.coupling * x.angular,
            x.linear * s.coupling + s.angular * x.angular};
}
inline Stiffness& operator+=(Stiffness& s, const Stiffness& other) {
    s.linear += other.linear;
    s.coupling += other.coupling;
    s.angular += other.angular;
    return s;
}

/// How a place `arm` away moves with a body.
inline Screw twistAt(const Screw& body, const glm::dvec3& arm) {
    return {body.linear + glm::cross(body.angular, arm), body.angular};
}
/// What a wrench that works `arm` away is at the body's centre.
inline Screw wrenchFrom(const Screw& wrench, const glm::dvec3& arm) {
    return {wrench.linear, wrench.angular + glm::cross(arm, wrench.linear)};
}
/// A stiffness at a place `arm` away, seen from here.
Stiffness stiffnessFrom(const Stiffness& there, const glm::dvec3& arm);

/// Rigid nodes joined by springs with six degrees of freedom, to each other and to the ground. Its
/// matrix K is symmetric, and positive definite when every node hangs together with the ground.
struct ElasticNetwork {
    static constexpr uint32_t kGround = UINT32_MAX;  ///< in place of the node b of an edge

    struct Edge {
        uint32_t a = 0, b = kGround;      ///< a < b
        glm::dvec3 armA{0.0}, armB{0.0};  ///< from the nodes' centres to where they meet
        Stiffness stiffness;              ///< there
    };

    Vector<glm::dvec3> centers;
    Vector<Edge> edges;

    [[nodiscard]] uint32_t nodeCount() const { return uint32_t(centers.size()); }
    /// Where the nodes of an edge meet.
    [[nodiscard]] glm::dvec3 placeOf(const Edge& edge) const { return centers[edge.a] + edge.armA; }
};

/// What the edge does to its node a, at their place, when the nodes move like x; the opposite to b.
Screw wrenchOnA(const ElasticNetwork::Edge& edge, std::span<const Screw> x);

/// out = K x.
void multiply(const ElasticNetwork& network, std::span<const Screw> x, std::span<Screw> out);
/// r -= K x.
void subtractProduct(const ElasticNetwork& network, std::span<const Screw> x, std::span<Screw> r);

/// The inverses of K's diagonal 6 x 6 blocks, made for `network`.
void invertDiagonal(const ElasticNetwork& network, Vector<Stiffness>& inverse);

/// Adds K to a dense matrix, row by row; lower triangle only.
void addDense(const ElasticNetwork& network, double* m);

double dot(std::span<const Screw> x, std::span<const Screw> y);
/// to += factor x.
void addScaled(std::span<Screw> to, double factor, std::span<const Screw> x);

}  // namespace sherd
