// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sherd/formats/fracture_set.h"

namespace sherd {

class Asset;

/// Handle of a spawned object. A removed object's handle stays invalid for ever: `index` is used
/// again with another `generation`.
struct ObjectId {
    uint32_t index = UINT32_MAX;
    uint32_t generation = 0;

    friend bool operator==(ObjectId, ObjectId) = default;
};

/// Bonds of an object have just broken, and what they held together may have come apart.
struct BreakEvent {
    ObjectId object;
    const Asset* asset = nullptr;
    uint32_t fragment = 0;    ///< that was struck, or broken by the game
    uint32_t level = 0;       ///< the deepest at which something broke
    uint32_t bonds = 0;       ///< broken
    float area = 0;           ///< of them, m^2
    uint32_t bodies = 0;      ///< that came off; 0: cracked, but still in one piece
    glm::vec3 point{0.0F};    ///< of the hit, world, metres
    glm::vec3 normal{0.0F};   ///< unit, pointing into what broke; zero: broken without a hit
    float impulse = 0;        ///< of the hit along the normal, N s
    float energy = 0;         ///< that the hit brought, J
    float consumed = 0;       ///< of it, used up by breaking, J
    float approachSpeed = 0;  ///< along the normal before the contact, m/s
    double time = 0;          ///< simulated seconds since the DestructionWorld was made
};

/// One thing to draw. Poses map the asset's vertices (object frame) to the world.
struct FragmentPose {
    ObjectId object;
    const Asset* asset = nullptr;
    uint32_t fragment = 0;
    RigidPose pose;  ///< after the last substep
    RigidPose
        previous;    ///< one substep earlier; for a new fragment, where its part of the parent was
    float fade = 0;  ///< 0: all there; up to 1: about to be removed
};

}  // namespace sherd
