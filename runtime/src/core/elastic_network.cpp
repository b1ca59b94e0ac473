// SPDX-License-Identifier: MIT
#include "core/elastic_network.h"

#include <glm/matrix.hpp>

namespace sherd {
namespace {

/// v -> arm x v.
glm::dmat3 crossMatrix(const glm::dvec3& arm) {
    return {{0, arm.z, -arm.y}, {-arm.z, 0, arm.x}, {arm.y, -arm.x, 0}};
}

/// Adds a block to a dense matrix of n columns; its corners need not be each other's transposes.
void addBlock(double* m, uint32_t n, const Stiffness& s, const glm::dmat3& lowerLeft) {
    for (uint32_t r = 0; r < 3; ++r) {
        double* const upper = m + size_t(r) * n;
        double* const lower = upper + 3 * size_t(n);
        for (uint32_t c = 0; c < 3; ++c) {
            upper[c] += s.linear[int(c)][int(r)];
            upper[c + 3] += s.coupling[int(c)][int(r)];
            lower[c] += lowerLeft[int(c)][int(r)];
            lower[c + 3] += s.angular[int(c)][int(r)];
        }
    }
}

/// By the Schur complement of the shifts. Where rounding has eaten that, the turns count as if they
/// had nothing to do with the shifts: still positive definite.
Stiffness inverseOf(const Stiffness& s) {
    constexpr double kEaten = 1e-13;
    const glm::dmat3 linear = glm::inverse(s.linear);
    const glm::dmat3 shifts = linear * s.coupling;  // that a turn makes
    glm::dmat3 left = s.angular - glm::transpose(s.coupling) * shifts;
    for (int k = 0; k < 3; ++k)
        if (!(left[k][k] > kEaten * s.angular[k][k])) left = s.angular;
    Stiffness inverse;
    inverse.angular = glm::inverse(left);
    inverse.coupling = -(shifts * inverse.angular);
    inverse.linear = linear - inverse.coupling * glm::transpose(shifts);
    return inverse;
}

/// What a load on node a must be to hold it against the edge.
inline Screw wrenchAgainst(const ElasticNetwork::Edge& edge, std::span<const Screw> x) {
    Screw stretch = twistAt(x[edge.a], edge.armA);
    if (edge.b != ElasticNetwork::kGround) {
        const Screw other = twistAt(x[edge.b], edge.armB);
        stretch = {stretch.linear - other.linear, stretch.angular - other.angular};
    }
    return edge.stiffness * stretch;
}

void add(Screw& to, const Screw& what) {
    to.linear += what.linear;
    to.angular += what.angular;
}
void subtract(Screw& from, const Screw& what) {
    from.linear -= what.linear;
    from.angular -= what.angular;
}

}  // namespace

Stiffness stiffnessFrom(const Stiffness& there, const glm::dvec3& arm) {
    const glm::dmat3 o = crossMatrix(arm);
    Stiffness here;
    here.linear = there.linear;
    here.coupling = there.coupling - there.linear * o;
    here.angular = there.angular + o * there.coupling - glm::transpose(there.coupling) * o -
                   o * there.linear * o;
    return here;
}

Screw wrenchOnA(const ElasticNetwork::Edge& edge, std::span<const Screw> x) {
    const Screw against = wrenchAgainst(edge, x);
    return {-against.linear, -against.angular};
}

void multiply(const ElasticNetwork& network, std::span<const Screw> x, std::span<Screw> out) {
    for (Screw& y : out) y = {};
    for (const ElasticNetwork::Edge& edge : network.edges) {
        const Screw wrench = wrenchAgainst(edge, x);
        add(out[edge.a], wrenchFrom(wrench, edge.armA));
        if (edge.b != ElasticNetwork::kGround) subtract(out[edge.b], wrenchFrom(wrench, edge.armB));
    }
}

void subtractProduct(const ElasticNetwork& network, std::span<const Screw> x, std::span<Screw> r) {
    for (const ElasticNetwork::Edge& edge : network.edges) {
        const Screw wrench = wrenchAgainst(edge, x);
        subtract(r[edge.a], wrenchFrom(wrench, edge.armA));
        if (edge.b != ElasticNetwork::kGround) add(r[edge.b], wrenchFrom(wrench, edge.armB));
    }
}

void invertDiagonal(const ElasticNetwork& network, Vector<Stiffness>& inverse) {
    inverse.assign(network.nodeCount(), {});
    for (const ElasticNetwork::Edge& edge : network.edges) {
        inverse[edge.a] += stiffnessFrom(edge.stiffness, edge.armA);
        if (edge.b != ElasticNetwork::kGround)
            inverse[edge.b] += stiffnessFrom(edge.stiffness, edge.armB);
    }
    for (Stiffness& block : inverse) block = inverseOf(block);
}

void addDense(const ElasticNetwork& network, double* m) {
    const uint32_t n = 6 * network.nodeCount();
    const auto blockAt = [&](uint32_t row, uint32_t column) {
        return m + size_t(6) * row * n + size_t(6) * column;
    };
    const auto addOnDiagonal = [&](uint32_t node, const Stiffness& s) {
        addBlock(blockAt(node, node), n, s, glm::transpose(s.coupling));
    };
    for (const ElasticNetwork::Edge& edge : network.edges) {
        addOnDiagonal(edge.a, stiffnessFrom(edge.stiffness, edge.armA));
        if (edge.b == ElasticNetwork::kGround) continue;
        addOnDiagonal(edge.b, stiffnessFrom(edge.stiffness, edge.armB));
        // -T_b^T S T_a, T the twist at the place of one at the centre.
        const Stiffness& s = edge.stiffness;
        const glm::dmat3 a = crossMatrix(edge.armA), b = crossMatrix(edge.armB);
        Stiffness across;
        across.linear = -s.linear;
        across.coupling = s.linear * a - s.coupling;
        const glm::dmat3 lowerLeft = -(b * s.linear) - glm::transpose(s.coupling);
        across.angular = -(lowerLeft * a) - b * s.coupling - s.angular;
        addBlock(blockAt(edge.b, edge.a), n, across, lowerLeft);
    }
}

double dot(std::span<const Screw> x, std::span<const Screw> y) {
    double sum = 0;
    for (size_t i = 0; i < x.size(); ++i)
        sum += glm::dot(x[i].linear, y[i].linear) + glm::dot(x[i].angular, y[i].angular);
    return sum;
}

void addScaled(std::span<Screw> to, double factor, std::span<const Screw> x) {
    for (size_t i = 0; i < to.size(); ++i) {
        to[i].linear += factor * x[i].linear;
        to[i].angular += factor * x[i].angular;
    }
}

}  // namespace sherd
