// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <span>

#include "sherd/runtime/bullet/body_rule.h"

namespace sherd {

/// Bullet's filter bits; both 0: Bullet's defaults.
struct BodyFilter {
    int group = 0, mask = 0;
};

/// Gives a body of a level what rules say of one of its size, and `filter`, too.
void applyRules(std::span<const BodyRule> rules, uint32_t level, btRigidBody& body,
                BodyFilter& filter);

}  // namespace sherd
