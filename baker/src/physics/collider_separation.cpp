// SPDX-License-Identifier: MIT
#include "physics/collider_separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace sherd {
namespace {

constexpr size_t kDirectionsTried = 12;
/// What a share of a body's volume weighs beside a share of the solid.
constexpr double kWorthOfAir = 0.02;
constexpr std::array<double, 5> kPlaces = {0, 0.25, 0.5, 0.75, 1};

/// A direction from a towards b and the interval along it where they overlap.
struct Overlap {
    glm::dvec3 direction;
    double low, high;
    double depth() const { return high - low; }
};

/// Whether a face of a has b beyond it but for `tolerance`, as the face between two cells has:
/// asked first, for it needs no face told apart from coplanar ones.
bool isBeyondAFace(const Polytope& a, const Polytope& b, double tolerance) {
    return std::any_of(a.faces.begin(), a.faces.end(), [&](const std::array<uint32_t, 3>& f) {
        const glm::dvec3& p = a.points[f[0]];
        const glm::dvec3 n = glm::cross(a.points[f[1]] - p, a.points[f[2]] - p);
        const double length = glm::length(n);
        const double least = glm::dot(n, p) - tolerance * length;
        return length > 0 &&
               std::all_of(b.points.begin(), b.points.end(),
                           [&](const glm::dvec3& q) { return glm::dot(n, q) >= least; }) &&
               reachOf(a.points, n).high - reachOf(b.points, n).low <= tolerance * length;
    });
}

/// Along the normals of faces of both: those of a outwards, those of b inwards.
std::vector<Overlap> overlapsOf(const Polytope& a, const Polytope& b, double tolerance) {
    if (isBeyondAFace(a, b, tolerance) || isBeyondAFace(b, a, tolerance)) return {};
    std::vector<Overlap> out;
    for (const bool fromB : {false, true}) {
        for (const HalfSpace& wall : halfSpacesOf(fromB ? b : a)) {
            const glm::dvec3 d = fromB ? -wall.normal : wall.normal;
            const double low = fromB ? -wall.offset : reachOf(b.points, d).low;
            const double high = fromB ? reachOf(a.points, d).high : wall.offset;
            if (high - low <= tolerance) return {};
            out.push_back({d, low, high});
        }
    }
    return out;
}

double shareLost(const WalledBody& side, const HalfSpace& wall) {
    const auto lost = std::count_if(side.solid.begin(), side.solid.end(), [&](const glm::dvec3& p) {
        return glm::dot(wall.normal, p) > wall.offset;
    });
    return side.worth * static_cast<double>(lost);
}

}  // namespace

bool overlap(const Polytope& a, const Polytope& b, double tolerance) {
    return !overlapsOf(a, b, tolerance).empty() && !areDisjoint(a, b);
}

std::optional<HalfSpace> wallBetween(const WalledBody& a, const WalledBody& b, double tolerance) {
    std::vector<Overlap> overlaps = overlapsOf(a.body, b.body, tolerance);
    if (overlaps.empty() || areDisjoint(a.body, b.body)) return std::nullopt;
    std::stable_sort(overlaps.begin(), overlaps.end(),
                     [](const Overlap& x, const Overlap& y) { return x.depth() < y.depth(); });
    overlaps.resize(std::min(overlaps.size(), kDirectionsTried));
    const double volumeA = volumeOf(a.body), volumeB = volumeOf(b.body);
    double least = std::numeric_limits<double>::infinity();
    HalfSpace best{};
    for (const Overlap& overlap : overlaps) {
        for (const double place : kPlaces) {
            const HalfSpace wall{overlap.direction, overlap.low + place * overlap.depth()};
            const HalfSpace back{-wall.normal, -wall.offset};
            const double lost = shareLost(a, wall) + shareLost(b, back);
            if (lost >= least) continue;
            const double goneA = volumeBeyond(a.body, wall) / volumeA;
            const double goneB = volumeBeyond(b.body, back) / volumeB;
            if (1 - goneA < a.left || 1 - goneB < b.left) continue;
            const double loss = lost + kWorthOfAir * (goneA + goneB);
            if (loss >= least) continue;
            least = loss;
            best = wall;
        }
    }
    if (!std::isfinite(least)) return std::nullopt;
    return best;
}

}  // namespace sherd
