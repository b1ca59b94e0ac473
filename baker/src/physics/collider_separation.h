// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "physics/polytope.h"

namespace sherd {

/// A convex part of a piece's collider.
struct ColliderPart {
    uint32_t fragment = 0;
    Polytope body;
    std::vector<glm::dvec3> solid = {};  ///< points spread over what of the piece is in it
    uint32_t vertices = 16;              ///< that its collider may have
    double reach = 0;  ///< how far the piece may reach out of it: once where corners are left
                       ///< out, once where the margin rounds them off
};

/// Whether convex bodies share more than a touch, judged to rounding.
bool areDisjoint(const Polytope& a, const Polytope& b);

/// Whether two bodies overlap by more than `tolerance` along every direction.
bool overlap(const Polytope& a, const Polytope& b, double tolerance);

/// One of two bodies that a wall is to be put between.
struct WalledBody {
    const Polytope& body;
    std::span<const glm::dvec3> solid;  ///< points spread over what of the piece is in it
    double worth = 1;                   ///< of a point lost
    double left = 0;                    ///< share of the body's volume that must be left
};

/// The plane between two bodies that overlap by which least of their solids is lost, and of equal
/// ones least of the bodies; below it is a's side. Nothing if they overlap by less than `tolerance`
/// along some direction, or no plane leaves enough of both.
std::optional<HalfSpace> wallBetween(const WalledBody& a, const WalledBody& b, double tolerance);

}  // namespace sherd
