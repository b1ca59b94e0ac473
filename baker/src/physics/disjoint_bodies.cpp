// SPDX-License-Identifier: MIT
// E. G. Gilbert, D. W. Johnson and S. S. Keerthi, A fast procedure for computing the distance
// between complex objects in three-dimensional space, 1988; only as far as whether there is one.
#include <glm/geometric.hpp>
#include <limits>

#include "physics/collider_separation.h"

namespace sherd {
namespace {

glm::dvec3 support(const std::vector<glm::dvec3>& points, const glm::dvec3& direction) {
    double most = -std::numeric_limits<double>::infinity();
    glm::dvec3 best(0.0);
    for (const glm::dvec3& p : points) {
        const double d = glm::dot(p, direction);
        if (d > most) {
            most = d;
            best = p;
        }
    }
    return best;
}

/// The point nearest to the origin of the plane through three points, of the line through two, or
/// the one point itself, if it lies strictly between them.
bool nearestWithin(const std::vector<glm::dvec3>& s, glm::dvec3& out) {
    if (s.size() == 1) {
        out = s[0];
        return true;
    }
    const glm::dvec3 e = s[1] - s[0];
    if (s.size() == 2) {
        const double t = -glm::dot(s[0], e) / glm::dot(e, e);
        out = s[0] + t * e;
        return t > 0 && t < 1;
    }
    const glm::dvec3 f = s[2] - s[0];
    const glm::dvec3 n = glm::cross(e, f);
    const double area = glm::dot(n, n);
    const double u = glm::dot(glm::cross(-s[0], f), n) / area;
    const double v = glm::dot(glm::cross(e, -s[0]), n) / area;
    out = n * (glm::dot(n, s[0]) / area);
    return u > 0 && v > 0 && u + v < 1;
}

bool holdsOrigin(const std::vector<glm::dvec3>& s) {
    const auto side = [&](size_t a, size_t b, size_t c, size_t d) {
        const glm::dvec3 n = glm::cross(s[b] - s[a], s[c] - s[a]);
        return glm::dot(n, -s[a]) * glm::dot(n, s[d] - s[a]) > 0;
    };
    return side(0, 1, 2, 3) && side(0, 1, 3, 2) && side(0, 2, 3, 1) && side(1, 2, 3, 0);
}

/// Reduces the simplex to the part nearest to the origin and gives that point.
glm::dvec3 reduce(std::vector<glm::dvec3>& simplex) {
    double least = std::numeric_limits<double>::infinity();
    glm::dvec3 best(0.0);
    std::vector<glm::dvec3> bestPart;
    for (uint32_t bits = 1; bits < (1U << simplex.size()); ++bits) {
        std::vector<glm::dvec3> part;
        for (size_t i = 0; i < simplex.size(); ++i)
            if ((bits >> i & 1U) != 0) part.push_back(simplex[i]);
        glm::dvec3 p;
        if (part.size() > 3 || !nearestWithin(part, p) || !(glm::dot(p, p) < least)) continue;
        least = glm::dot(p, p);
        best = p;
        bestPart = std::move(part);
    }
    simplex = std::move(bestPart);
    return best;
}

}  // namespace

bool areDisjoint(const Polytope& a, const Polytope& b) {
    constexpr int kMostSteps = 100;
    std::vector<glm::dvec3> simplex = {a.points[0] - b.points[0]};
    glm::dvec3 nearest = simplex[0];
    for (int step = 0; step < kMostSteps; ++step) {
        const glm::dvec3 next = support(a.points, -nearest) - support(b.points, nearest);
        if (glm::dot(nearest, next) > 0) return true;
        simplex.push_back(next);
        if (simplex.size() == 4 && holdsOrigin(simplex)) return false;
        const glm::dvec3 before = nearest;
        nearest = reduce(simplex);
        if (!(glm::dot(nearest, nearest) < glm::dot(before, before))) return false;
    }
    return false;
}

}  // namespace sherd
