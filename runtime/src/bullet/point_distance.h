// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

namespace sherd {

/// From a point to a convex shape or a compound of some, metres; negative inside. `child`: the
/// nearest of the innermost compound, -1 of others.
float pointDistance(const btCollisionShape& shape, const btTransform& place, const btVector3& point,
                    int* child = nullptr);

}  // namespace sherd
