// SPDX-License-Identifier: MIT
// Convex sets without their borders are disjoint if and only if a plane parts them that does not
// hold both (R. T. Rockafellar, Convex Analysis, 1970, theorem 11.3). For two triangles it is
// enough to try planes along one of them or along an edge of each (S. Gottschalk, "Separating axis
// theorem", 1996).
#include "crossing_triangles.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "exact_sum.h"
#include "triangle_tree.h"

namespace sherd {

namespace {

using Triangle = std::array<glm::vec3, 3>;

/// A direction from one place to another.
struct Arrow {
    glm::vec3 from{0};
    glm::vec3 to{0};
};

int exactSign(const std::array<Arrow, 3>& arrows) {
    constexpr std::array<std::array<int, 4>, 6> kTerms = {
        {{0, 1, 2, 1}, {1, 2, 0, 1}, {2, 0, 1, 1}, {0, 2, 1, -1}, {2, 1, 0, -1}, {1, 0, 2, -1}}};
    ExactSum sum;
    for (unsigned ends = 0; ends < 8; ++ends) {
        std::array<glm::vec3, 3> p{};
        int sign = 1;
        for (unsigned i = 0; i < 3; ++i) {
            const bool from = (ends >> i & 1U) != 0;
            p[i] = from ? arrows[i].from : arrows[i].to;
            if (from) sign = -sign;
        }
        for (const auto& [x, y, z, own] : kTerms) sum.add(sign * own, p[0][x], p[1][y], p[2][z]);
    }
    return sum.sign();
}

/// The sign of the determinant of three arrows.
int sign(const Arrow& a, const Arrow& b, const Arrow& c) {
    const glm::dvec3 u = glm::dvec3(a.to) - glm::dvec3(a.from);
    const glm::dvec3 v = glm::dvec3(b.to) - glm::dvec3(b.from);
    const glm::dvec3 w = glm::dvec3(c.to) - glm::dvec3(c.from);
    const double value = glm::dot(glm::cross(u, v), w);
    // Far above what 17 roundings can add up to; what lies below is worked out without any.
    double size = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        size += (std::abs(u[i] * v[j]) + std::abs(u[j] * v[i])) * std::abs(w[k]);
    }
    if (std::abs(value) > 1e-14 * size + 1e-280) return value > 0 ? 1 : -1;
    return exactSign({a, b, c});
}

/// Where some numbers lie with respect to others.
struct Sides {
    bool above = false;
    bool below = false;
    void add(int s) {
        above = above || s > 0;
        below = below || s < 0;
    }
    bool oneSided() const { return above != below; }
    bool none() const { return !above && !below; }
};

Arrow edge(const Triangle& t, int i) {
    return {t[i], t[(i + 1) % 3]};
}

/// The corners of `other` with respect to the plane of t.
Sides sidesOfPlane(const Triangle& t, const Triangle& other) {
    Sides sides;
    for (const glm::vec3& p : other) sides.add(sign(edge(t, 0), {t[0], t[2]}, {t[0], p}));
    return sides;
}

/// Along the axis across both edges every corner of b lies on one side of every corner of a. The
/// axis may be none, if the edges are parallel: then it parts nothing.
bool partedAcross(const Triangle& a, int i, const Triangle& b, int j) {
    const Arrow u = edge(a, i), v = edge(b, j);
    Sides sides;
    for (const int p : {i, (i + 2) % 3})
        for (const int q : {j, (j + 2) % 3}) sides.add(sign(u, v, {a[p], b[q]}));
    return sides.oneSided();
}

/// Triangles of one plane, seen along a coordinate axis: an edge of t has the other beyond it.
bool partedInPlane(const Triangle& t, const Triangle& other, const Arrow& view) {
    for (int i = 0; i < 3; ++i) {
        const int own = sign(edge(t, i), {t[i], t[(i + 2) % 3]}, view);
        bool beyond = true;
        for (const glm::vec3& p : other)
            beyond = beyond && sign(edge(t, i), {t[i], p}, view) * own <= 0;
        if (beyond) return true;
    }
    return false;
}

bool overlapInPlane(const Triangle& a, const Triangle& b) {
    for (int axis = 0; axis < 3; ++axis) {
        Arrow view;
        view.to[axis] = 1;
        const auto area = [&view](const Triangle& t) {
            return sign(edge(t, 0), {t[0], t[2]}, view);
        };
        if (area(a) == 0 || area(b) == 0) continue;
        return !partedInPlane(a, b, view) && !partedInPlane(b, a, view);
    }
    return false;
}

}  // namespace

bool insidesMeet(const Triangle& a, const Triangle& b) {
    const Sides ofB = sidesOfPlane(a, b);
    if (ofB.oneSided()) return false;
    const Sides ofA = sidesOfPlane(b, a);
    if (ofA.oneSided()) return false;
    if (ofA.none() || ofB.none()) return ofA.none() && ofB.none() && overlapInPlane(a, b);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (partedAcross(a, i, b, j)) return false;
    return true;
}

CrossingCount countCrossings(const std::vector<glm::vec3>& positions,
                             const std::vector<std::array<uint32_t, 3>>& triangles) {
    const auto corners = [&positions](const std::array<uint32_t, 3>& t) {
        return Triangle{positions[t[0]], positions[t[1]], positions[t[2]]};
    };
    CrossingCount count;
    // Ten times what real pieces have; triangles piled on each other would take hours.
    const uint64_t most = 200 * (uint64_t{triangles.size()} + 1000);
    uint64_t tested = 0;
    const TriangleTree tree(positions, triangles);
    tree.forEachMeetingPair([&](const auto& s, const auto& t) {
        if (insidesMeet(corners(s), corners(t))) ++count.pairs;
        count.complete = ++tested < most;
        return count.complete;
    });
    return count;
}

}  // namespace sherd
