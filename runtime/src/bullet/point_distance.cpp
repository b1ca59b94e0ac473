// SPDX-License-Identifier: MIT
#include "bullet/point_distance.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <algorithm>
#include <cmath>

namespace sherd {
namespace {

float boxDistance(const btCollisionShape& shape, const btTransform& place, const btVector3& point) {
    btVector3 low, high;
    shape.getAabb(place, low, high);
    btVector3 nearest = point;
    nearest.setMax(low);
    nearest.setMin(high);
    return nearest.distance(point);
}

/// GJK, and EPA inside (van den Bergen 2001); what they give up on is as far as its box.
float hullDistance(const btConvexShape& hull, const btTransform& place, const btVector3& point) {
    btGjkEpaSolver2::sResults results;
    const btScalar distance = btGjkEpaSolver2::SignedDistance(point, 0, &hull, place, results);
    return std::abs(distance) < SIMD_INFINITY ? distance : boxDistance(hull, place, point);
}

}  // namespace

float pointDistance(const btCollisionShape& shape, const btTransform& place, const btVector3& point,
                    int* child) {
    if (child) *child = -1;
    if (shape.isConvex())
        return hullDistance(static_cast<const btConvexShape&>(shape), place, point);
    if (!shape.isCompound()) return boxDistance(shape, place, point);
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    float least = HUGE_VALF;
    for (int c = 0; c < compound.getNumChildShapes(); ++c) {
        const btCollisionShape& part = *compound.getChildShape(c);
        const btTransform there = place * compound.getChildTransform(c);
        if (boxDistance(part, there, point) > std::max(least, 0.0F)) continue;
        int inner = -1;
        const float distance = pointDistance(part, there, point, &inner);
        if (!(distance < least)) continue;
        least = distance;
        if (child) *child = inner >= 0 ? inner : c;
    }
    return least;
}

}  // namespace sherd
