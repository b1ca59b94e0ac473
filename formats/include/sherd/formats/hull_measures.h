// SPDX-License-Identifier: MIT
// What colliders do to each other and to points, measured from the stored corners and margins
// alone.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd {

/// How far apart the convex hulls of two sets of points are; below 0: how deep they are in each
/// other, the least distance that parts them. Both sets must not be empty.
double hullDistance(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b);

/// The same, but 0 where they are in each other: that is found much faster.
double hullGap(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b);

/// Two fragments whose colliders, margins included, are inside each other.
struct ColliderOverlap {
    uint32_t a, b;  ///< fragments, a < b
    double depth;   ///< metres, of the deepest pair of their hulls
};

struct ColliderOverlaps {
    std::vector<ColliderOverlap> pairs;  ///< ascending
    bool complete =
        true;  ///< false: more hulls lie in one place than can be held against each other
};

/// All pairs deeper than `tolerance`, metres: of fragments that may be bodies at the same time, so
/// of which none is part of the other.
ColliderOverlaps colliderOverlaps(const FractureSet& set, double tolerance);

}  // namespace sherd
