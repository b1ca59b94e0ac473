// SPDX-License-Identifier: MIT
#pragma once

#include "bullet/bullet_bodies.h"

namespace sherd {

/// Whether nothing of an object moves faster than what lies quiet may.
bool isAtRest(const IslandWorld& islands, BulletBodies& bodies, uint32_t object);

/// Freezes the pieces of an object that was at rest when it came apart and that lie, over others,
/// on something static: by their bonds' normals, as steep as their friction holds. Bullet has made
/// no contacts of theirs yet. The others are awake, and fall.
void restWhatIsBorne(btDynamicsWorld& world, const IslandWorld& islands, BulletBodies& bodies,
                     uint32_t object);

}  // namespace sherd
