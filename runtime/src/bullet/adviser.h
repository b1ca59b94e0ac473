// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include <vector>

#include "bullet/bullet_bodies.h"
#include "sherd/runtime/bullet/advice.h"
#include "sherd/runtime/bullet/destruction_world.h"

namespace sherd {

/// `lastStep`: length of the last substep, s; 0: there was none.
std::vector<Advice> adviseOn(btDynamicsWorld& world, const AssetStore& assets,
                             const BulletBodies& bodies, const WorldOptions& options,
                             float lastStep);

}  // namespace sherd
