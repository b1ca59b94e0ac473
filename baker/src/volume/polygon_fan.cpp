// SPDX-License-Identifier: MIT
#include "volume/polygon_fan.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

namespace sherd {
namespace {

/// Twice the area over the longest side squared: 0 for a flat triangle.
double shapeOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, bc = c - b;
    const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
    return longest > 0 ? glm::length(glm::cross(ab, ac)) / longest : 0;
}

bool isBefore(const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// The same to the bit, whichever way round the triangle is seen.
double shapeFromBothSides(std::array<glm::dvec3, 3> corners) {
    std::sort(corners.begin(), corners.end(), isBefore);
    return shapeOf(corners[0], corners[1], corners[2]);
}

}  // namespace

std::span<const std::array<uint32_t, 3>> PolygonFan::run(std::span<const uint32_t> corners,
                                                         const CapSpace& vertices) {
    triangles_.clear();
    const bool shared = vertices.shared();
    left_.assign(corners.begin(), corners.end());
    for (size_t n = left_.size(); n > 3; n = left_.size()) {
        const auto corner = [&](size_t k) { return left_[k % n]; };
        const auto at = [&](size_t k) -> const glm::dvec3& {
            return vertices.gridPosition(corner(k));
        };
        const auto shape = [&](size_t k) {
            return shared ? shapeFromBothSides({at(k), at(k + 1), at(k + 2)})
                          : shapeOf(at(k), at(k + 1), at(k + 2));
        };
        size_t best = 0;
        double bestShape = -1;
        for (size_t k = 0; k < n; ++k) {
            // Of a quadrilateral both parts count.
            const double s = n == 4 ? std::min(shape(k), shape(k + 2)) : shape(k);
            const bool tie = shared && s == bestShape && isBefore(at(k + 1), at(best + 1));
            if (s <= bestShape && !tie) continue;
            best = k;
            bestShape = s;
        }
        triangles_.push_back({corner(best), corner(best + 1), corner(best + 2)});
        left_.erase(left_.begin() + static_cast<int64_t>((best + 1) % n));
    }
    triangles_.push_back({left_[0], left_[1], left_[2]});
    return triangles_;
}

}  // namespace sherd
