// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace sherd {

struct HullOptions {
    static constexpr float kAutomatic = -1;
    uint32_t maxVertices = 16;  ///< 8 to 255
    float margin = kAutomatic;  ///< metres; automatic: 1 % of the largest extent
    double reach = std::numeric_limits<double>::infinity();  ///< metres that the margin may round
                                                             ///< corners off: it is less where
                                                             ///< they are sharp
    double volume = 0;  ///< share of the hull's that the margin's roundness leaves at least
};

/// A convex collider, its points shrunk inwards by its collision margin.
struct ColliderHull {
    std::vector<glm::vec3> points;  ///< at least 4, spanning a volume
    float margin = 0;               ///< metres; at most 10 % of the thinnest extent
};

/// Points and margin together stay within the convex hull of `points` (flat input excepted: it is
/// given a thickness of 1/1000 of its size). Any input gives a usable collider.
ColliderHull colliderHull(std::span<const glm::dvec3> points, const HullOptions& options);
ColliderHull colliderHull(std::span<const glm::vec3> points, const HullOptions& options);

}  // namespace sherd
