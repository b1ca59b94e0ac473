// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace sherd {

/// What bodies of some level and size get from Bullet. Of several rules that fit, later ones have
/// the last word.
struct BodyRule {
    uint32_t fromLevel = 0;         ///< of the coarsest fragment in the body,
    uint32_t toLevel = UINT32_MAX;  ///< both inclusive; 0: the intact object
    float fromSize = 0;             ///< longest side of its box, metres, inclusive
    float toSize = HUGE_VALF;       ///< exclusive
    int collisionGroup = 0;         ///< Bullet filter bits; both 0: as without this rule
    int collisionMask = 0;          ///<
    float friction = -1;            ///< < 0: the file's
    float restitution = -1;         ///< < 0: the file's
    /// Sweeps what flies fast: a body that moves farther in a substep than half its thinnest side
    /// does not pass through what is static. Bullet does so for bodies of one convex part.
    bool continuous = false;
};

}  // namespace sherd
