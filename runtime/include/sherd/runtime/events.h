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
    float size = 0;           ///< of that fragment, across its colliders' box, metres
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

/// Something met an object, whether it broke anything or not: for sounds, dust and scratches. What
/// the piece is made of, and of which level, `asset->fragment(fragment)` tells.
struct ImpactEvent {
    ObjectId object;
    const Asset* asset = nullptr;
    uint32_t fragment = 0;    ///< that was struck
    float size = 0;           ///< of it, across its colliders' box, metres
    glm::vec3 point{0.0F};    ///< world, metres
    glm::vec3 normal{0.0F};   ///< unit, pointing into the object
    float impulse = 0;        ///< along the normal, N s
    float energy = 0;         ///< that a plastic impact would consume, J
    float approachSpeed = 0;  ///< along the normal before the contact, m/s
    double time = 0;          ///< simulated seconds since the DestructionWorld was made
};

/// A part of an object is a body of its own now, or one that stood fixed is free.
struct IslandEvent {
    ObjectId object;
    const Asset* asset = nullptr;
    uint32_t fragment = 0;   ///< the first of it, which names it; its level and material are there
    uint32_t fragments = 0;  ///< that hold together in it
    uint32_t from = 0;       ///< the first fragment of what it came off; its own: it was let go
    bool isFixed = false;    ///< by an anchor
    float mass = 0;          ///< kg
    float size = 0;          ///< across the box around it, metres
    glm::vec3 center{0.0F};  ///< of mass, world
    glm::vec3 velocity{0.0F};  ///< of it, m/s
    double time = 0;
};

/// One thing to draw. Poses map the asset's vertices (object frame), times `scale`, to the world.
struct FragmentPose {
    ObjectId object;
    const Asset* asset = nullptr;
    uint32_t fragment = 0;
    RigidPose pose;  ///< after the last substep
    RigidPose
        previous;     ///< one substep earlier; for a new fragment, where its part of the parent was
    float scale = 1;  ///< of the instance
    float fade = 0;   ///< 0: all there; up to 1: about to be removed
};

}  // namespace sherd
