// SPDX-License-Identifier: MIT
#include "physics/cut_candidates.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/mass_properties.h"

namespace sherd {
namespace {

/// So many faces of pockets are followed.
constexpr size_t kMostNotchFaces = 4;
/// Directions nearer to each other than this are one.
constexpr double kAlike = 0.97;
/// As are alike planes nearer than this share of the size.
constexpr double kNear = 0.1;

/// A triangle of the skin and how far it is from its middle straight outwards to the hull.
struct Pocket {
    glm::dvec3 normal, middle;
    double depth;
};

/// Those of all triangles, the deepest first. How near a corner is to the hull says nothing: in a
/// prism all of them lie on it.
std::vector<Pocket> pocketsOf(const SolidChain& solid, const Polytope& hull) {
    const std::vector<HalfSpace> walls = halfSpacesOf(hull);
    std::vector<Pocket> pockets;
    for (const auto& t : solid.skin()) {
        const glm::dvec3 &a = solid.points()[t[0]], &b = solid.points()[t[1]],
                         &c = solid.points()[t[2]];
        const glm::dvec3 n = glm::cross(b - a, c - a);
        const double length = glm::length(n);
        if (!(length > 0)) continue;
        Pocket pocket{n / length, (a + b + c) / 3.0, std::numeric_limits<double>::infinity()};
        for (const HalfSpace& wall : walls) {
            const double steep = glm::dot(wall.normal, pocket.normal);
            if (steep < 1e-6) continue;
            const double depth = (wall.offset - glm::dot(wall.normal, pocket.middle)) / steep;
            pocket.depth = std::min(pocket.depth, depth);
        }
        pockets.push_back(pocket);
    }
    std::stable_sort(pockets.begin(), pockets.end(),
                     [](const Pocket& a, const Pocket& b) { return a.depth > b.depth; });
    return pockets;
}

}  // namespace

std::vector<HalfSpace> cutCandidates(const SolidChain& solid, const Polytope& hull) {
    const std::vector<Pocket> pockets = pocketsOf(solid, hull);
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& p : hull.points) middle += p / static_cast<double>(hull.points.size());
    glm::dmat3 spread(0.0);
    for (const glm::dvec3& p : hull.points) spread += glm::outerProduct(p - middle, p - middle);
    const glm::dmat3 axes = glm::mat3_cast(glm::dquat(principalAxes(spread).orientation));
    std::vector<HalfSpace> out;
    double size = 0;
    for (const glm::dvec3& p : hull.points) size = std::max(size, glm::distance(p, middle));
    const auto add = [&](const glm::dvec3& normal, const glm::dvec3& through) {
        const double offset = glm::dot(normal, through);
        for (const HalfSpace& known : out) {
            const double along = glm::dot(known.normal, normal);
            if (std::abs(along) > kAlike &&
                std::abs(known.offset - std::copysign(offset, along)) < kNear * size)
                return;
        }
        out.push_back({normal, offset});
    };
    for (const Pocket& pocket : pockets) {
        if (out.size() == kMostNotchFaces) break;
        add(pocket.normal, pocket.middle);
    }
    const glm::dvec3 notch = pockets.empty() ? middle : pockets[0].middle;
    int longest = 0;
    double length = 0;
    for (int k = 0; k < 3; ++k) {
        add(axes[k], notch);
        add(axes[k], middle);
        const Reach reach = reachOf(hull.points, axes[k]);
        if (reach.high - reach.low <= length) continue;
        length = reach.high - reach.low;
        longest = k;
    }
    out.push_back({axes[longest], glm::dot(axes[longest], middle)});
    return out;
}

}  // namespace sherd
