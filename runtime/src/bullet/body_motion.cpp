// SPDX-License-Identifier: MIT
#include "bullet/body_motion.h"

#include <initializer_list>

namespace sherd {

double kineticEnergy(const btRigidBody& body, const Motion& motion, const btMatrix3x3& axes) {
    const btVector3 spin = motion.angular * axes;  // along the principal axes
    const btVector3& inverse = body.getInvInertiaDiagLocal();
    double energy = motion.linear.length2() / body.getInvMass();
    for (int axis = 0; axis < 3; ++axis) {
        if (inverse[axis] > 0) energy += spin[axis] * spin[axis] / inverse[axis];
    }
    return 0.5 * energy;
}

btVector3 velocityAt(const btCollisionObject& body, const Motion& motion, const btVector3& point) {
    return motion.linear + motion.angular.cross(point - body.getWorldTransform().getOrigin());
}

float effectiveMass(const btCollisionObject& a, const btCollisionObject& b, const btVector3& point,
                    const btVector3& normal) {
    btScalar inverse = 0;
    for (const btCollisionObject* object : {&a, &b}) {
        if (const btRigidBody* body = movable(object)) {
            inverse += body->computeImpulseDenominator(point, normal);
        }
    }
    return inverse > 0 ? 1 / inverse : 0;
}

void applyPair(btCollisionObject& a, btCollisionObject& b, const btVector3& point,
               const btVector3& impulse) {
    if (btRigidBody* body = movable(&a)) {
        body->applyImpulse(impulse, point - body->getCenterOfMassPosition());
    }
    if (btRigidBody* body = movable(&b)) {
        body->applyImpulse(-impulse, point - body->getCenterOfMassPosition());
    }
}

}  // namespace sherd
