// SPDX-License-Identifier: MIT
#include "thin_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <utility>

#include "triangle_tree.h"

namespace sherd {

namespace {

constexpr double kNone = std::numeric_limits<double>::max();

struct Facet {
    glm::dvec3 a{0}, b{0}, c{0};
    Facet(const std::vector<glm::vec3>& positions, const std::array<uint32_t, 3>& t)
        : a(positions[t[0]]), b(positions[t[1]]), c(positions[t[2]]) {}
    glm::dvec3 normal() const { return glm::cross(b - a, c - a); }
};

/// Where a line passes a facet, by the volumes that it spans with its edges.
struct Passage {
    double length = kNone;  ///< of `along`; kNone: it does not, or behind `from`
    int turn = 0;           ///< -1: out of the mesh, 1: into it
};

Passage passageOf(const Facet& f, const glm::dvec3& from, const glm::dvec3& along) {
    const glm::dvec3 n = f.normal();
    const double speed = glm::dot(n, along);
    if (speed == 0) return {};
    const int turn = speed > 0 ? -1 : 1;
    const glm::dvec3 a = f.a - from, b = f.b - from, c = f.c - from;
    for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        if (-turn * glm::dot(along, glm::cross(p, q)) < 0) return {};
    const double length = glm::dot(n, a) / speed;
    return length > 0 ? Passage{length, turn} : Passage{};
}

/// The length after which a line that starts inside is outside for the first time, however often
/// the mesh overlaps itself on the way.
double lengthInside(std::vector<Passage>& passages) {
    // Into comes before out of: what touches hangs together.
    std::sort(passages.begin(), passages.end(), [](const Passage& x, const Passage& y) {
        return x.length != y.length ? x.length < y.length : x.turn > y.turn;
    });
    int winding = 0;
    for (const Passage& p : passages) winding -= p.turn;
    winding = std::max(winding, 1);
    for (const Passage& p : passages) {
        winding += p.turn;
        if (winding == 0) return p.length;
    }
    return kNone;
}

}  // namespace

double thinnestPart(const std::vector<glm::vec3>& positions,
                    const std::vector<std::array<uint32_t, 3>>& triangles, uint32_t points,
                    double share, uint32_t seed) {
    std::vector<double> upTo;  // areas, summed
    double area = 0;
    for (const auto& t : triangles) {
        area += 0.5 * glm::length(Facet(positions, t).normal());
        upTo.push_back(area);
    }
    if (!(area > 0)) return 0;
    const TriangleTree tree(positions, triangles);
    std::mt19937 random(seed);
    const auto unit = [&random] { return random() / 4294967296.0; };
    std::vector<double> lengths;
    for (uint32_t i = 0; i < points; ++i) {
        const auto found = std::upper_bound(upTo.begin(), upTo.end(), unit() * area);
        const size_t t = std::min<size_t>(found - upTo.begin(), triangles.size() - 1);
        const Facet facet(positions, triangles[t]);
        // A point of the parallelogram, folded into the triangle.
        double x = unit(), y = unit();
        if (x + y > 1) {
            x = 1 - x;
            y = 1 - y;
        }
        const glm::dvec3 from = facet.a + x * (facet.b - facet.a) + y * (facet.c - facet.a);
        const glm::dvec3 inwards = -glm::normalize(facet.normal());
        std::vector<Passage> passages;
        double farthest = kNone;
        tree.forEachAlong(from, inwards, farthest, [&](const std::array<uint32_t, 3>& other) {
            if (other == triangles[t]) return;
            const Passage passage = passageOf(Facet(positions, other), from, inwards);
            if (passage.turn != 0) passages.push_back(passage);
        });
        lengths.push_back(lengthInside(passages));
    }
    std::sort(lengths.begin(), lengths.end());
    const double length = lengths[static_cast<size_t>(share * (points - 1))];
    return length < kNone ? length : 0;
}

}  // namespace sherd
