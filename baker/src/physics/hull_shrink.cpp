// SPDX-License-Identifier: MIT
// Every corner goes where three of the faces meeting in it do once they are moved inwards.
#include "physics/hull_shrink.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace sherd {
namespace {

constexpr double kTouch = 1e-9;

bool isWithin(const glm::dvec3& p, std::span<const HalfSpace> halfSpaces, double margin) {
    return std::all_of(halfSpaces.begin(), halfSpaces.end(), [&](const HalfSpace& h) {
        return glm::dot(h.normal, p) <= h.offset - margin + kTouch;
    });
}

/// The corner of the offset hull nearest to `p` among those of the faces that meet in p.
bool offsetCorner(const glm::dvec3& p, std::span<const HalfSpace> halfSpaces, double margin,
                  glm::dvec3& out) {
    std::vector<HalfSpace> own;
    for (const HalfSpace& h : halfSpaces) {
        if (glm::dot(h.normal, p) > h.offset - 1e-7) own.push_back(h);
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < own.size(); ++i) {
        for (size_t j = i + 1; j < own.size(); ++j) {
            const glm::dvec3 ij = glm::cross(own[i].normal, own[j].normal);
            for (size_t k = j + 1; k < own.size(); ++k) {
                const double det = glm::dot(ij, own[k].normal);
                if (std::abs(det) < 1e-6) continue;
                const glm::dvec3 x =
                    ((own[i].offset - margin) * glm::cross(own[j].normal, own[k].normal) +
                     (own[j].offset - margin) * glm::cross(own[k].normal, own[i].normal) +
                     (own[k].offset - margin) * ij) /
                    det;
                const double distance = glm::length(x - p);
                if (distance >= nearest || !isWithin(x, halfSpaces, margin)) continue;
                nearest = distance;
                out = x;
            }
        }
    }
    return std::isfinite(nearest);
}

/// Towards `inside` as far as it takes: always possible, but takes more than needed.
glm::dvec3 pullIn(const glm::dvec3& p, const glm::dvec3& inside,
                  std::span<const HalfSpace> halfSpaces, double margin) {
    double keep = 1;
    for (const HalfSpace& h : halfSpaces) {
        const double from = glm::dot(h.normal, inside);
        const double to = glm::dot(h.normal, p);
        const double limit = h.offset - margin;
        if (to > limit) keep = std::min(keep, std::max(0.0, (limit - from) / (to - from)));
    }
    return inside + keep * (p - inside);
}

}  // namespace

double thinnestExtent(std::span<const glm::dvec3> points, std::span<const HalfSpace> halfSpaces) {
    double thinnest = std::numeric_limits<double>::infinity();
    for (const HalfSpace& h : halfSpaces) {
        double back = h.offset;
        for (const glm::dvec3& p : points) back = std::min(back, glm::dot(h.normal, p));
        thinnest = std::min(thinnest, h.offset - back);
    }
    return thinnest;
}

std::vector<glm::dvec3> shrinkHull(std::span<const glm::dvec3> points,
                                   std::span<const HalfSpace> halfSpaces, double margin) {
    glm::dvec3 inside(0.0);
    for (const glm::dvec3& p : points) inside += p / static_cast<double>(points.size());
    std::vector<glm::dvec3> out;
    out.reserve(points.size());
    for (const glm::dvec3& p : points) {
        glm::dvec3 corner;
        if (!offsetCorner(p, halfSpaces, margin, corner)) {
            corner = pullIn(p, inside, halfSpaces, margin);
        }
        out.push_back(corner);
    }
    return out;
}

}  // namespace sherd
