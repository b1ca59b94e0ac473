// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace sherd {

/// A setting of Bullet's, or of the game's, that breaking would be better or cheaper without. Sherd
/// changes none of them.
struct Advice {
    enum class Code : uint8_t {
        broadphaseMargin,    ///< gDbvtMargin is large beside the pieces
        broadphaseLimit,     ///< a broadphase that holds a fixed number of bodies
        allAabbs,            ///< boxes of all bodies are updated in every substep
        contactThreshold,    ///< gContactBreakingThreshold is large beside the pieces
        longSubstep,         ///< longer than Bullet holds piles up in
        fewIterations,       ///< of the solver
        noSplitImpulse,      ///< pushing overlaps apart makes speed
        noWarmStarting,      ///< piles need many iterations
        noDeactivation,      ///< nothing ever sleeps
        continuousOff,       ///< rules ask for sweeping, which the world does not do
        continuousCompound,  ///< rules ask for sweeping bodies of several convex parts
        bodiesOutOfWorld,    ///< the game has taken bodies of Sherd's out of the world
    };
    Code code;
    std::string text;  ///< what, why and what to do
};

}  // namespace sherd
