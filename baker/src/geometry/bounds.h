// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

namespace sherd {

/// An axis-parallel box; empty until a point is added.
struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::max()};
    glm::dvec3 high{std::numeric_limits<double>::lowest()};

    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    bool empty() const { return low.x > high.x; }
    glm::dvec3 size() const { return high - low; }
    glm::dvec3 middle() const { return (low + high) * 0.5; }
    double diagonal() const { return empty() ? 0 : glm::distance(low, high); }
};

/// Of the vertices that triangles use: a stray one must not count.
inline Bounds boundsOf(std::span<const glm::vec3> positions,
                       std::span<const std::array<uint32_t, 3>> triangles) {
    Bounds bounds;
    for (const auto& t : triangles)
        for (const uint32_t v : t) bounds.add(positions[v]);
    return bounds;
}

}  // namespace sherd
