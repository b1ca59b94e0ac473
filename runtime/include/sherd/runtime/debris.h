// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include "sherd/runtime/events.h"

namespace sherd {

enum class RemovalReason {
    age,       ///< it lay about for longer than its lifetime
    distance,  ///< it is too far from the viewer
    game,      ///< the game took it
};

/// A piece that came off and may be removed, or was.
struct DebrisInfo {
    ObjectId object;
    const Asset* asset = nullptr;
    uint32_t fragment = 0;     ///< the first of its fragments
    uint32_t level = 0;        ///< of that one
    glm::vec3 position{0.0F};  ///< of its centre of mass, world, metres
    float size = 0;            ///< diagonal of the box around it, metres
    float mass = 0;            ///< kg
    RemovalReason why = RemovalReason::age;
};

/// A piece is gone: its body is, and it is listed for drawing no longer.
struct RemovalEvent : DebrisInfo {
    double time = 0;  ///< simulated seconds since the world was made
};

/// Which pieces go by themselves. Never what is whole, what is anchored or stands fixed.
struct DebrisOptions {
    float lifetime = HUGE_VALF;  ///< s since it came off, after which a piece starts to fade, > 0
    float distance = HUGE_VALF;  ///< m from the viewer, once the game has named one, > 0
    /// Larger pieces stay: share of the object's diagonal, and metres, >= 0.
    float maxShare = 0.5F;
    float maxSize = HUGE_VALF;
    bool largestToo = false;  ///< false: the heaviest that is left of each object stays
    float fade = 1.0F;        ///< s from starting to fade to removal, >= 0
    /// Removing a body from a dense heap takes Bullet up to 0.2 ms, so it is spread over substeps.
    /// >= 1
    uint32_t maxRemovalsPerStep = 4;
    /// Asked before a piece starts to fade; false: it stays, and is asked for again after another
    /// lifetime. It must not change the world. Null: they all go.
    std::function<bool(const DebrisInfo&)> mayGo;
};

}  // namespace sherd
