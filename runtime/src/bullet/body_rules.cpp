// SPDX-License-Identifier: MIT
#include "bullet/body_rules.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <algorithm>

namespace sherd {

void applyRules(std::span<const BodyRule> rules, uint32_t level, btRigidBody& body,
                BodyFilter& filter) {
    if (rules.empty()) return;
    btVector3 low, high;
    body.getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
    const btVector3 sides = high - low;
    const btScalar longest = sides[sides.maxAxis()], thinnest = sides[sides.minAxis()];
    bool isContinuous = false;
    for (const BodyRule& rule : rules) {
        if (level < rule.fromLevel || level > rule.toLevel || longest < rule.fromSize ||
            longest >= rule.toSize)
            continue;
        if (rule.collisionGroup != 0 || rule.collisionMask != 0)
            filter = {rule.collisionGroup, rule.collisionMask};
        if (rule.friction >= 0) body.setFriction(rule.friction);
        if (rule.restitution >= 0) body.setRestitution(rule.restitution);
        isContinuous = rule.continuous;
    }
    // The sphere must be inside the body, or it would touch what the body rests on.
    constexpr btScalar kInside = 0.4F;
    body.setCcdMotionThreshold(isContinuous ? thinnest / 2 : 0);
    body.setCcdSweptSphereRadius(isContinuous ? kInside * thinnest : 0);
}

}  // namespace sherd
