// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace sherd {

/// Of a body about its centre of mass.
struct Motion {
    btVector3 linear{0, 0, 0};   ///< m/s
    btVector3 angular{0, 0, 0};  ///< rad/s
};

/// Null for what contacts do not move: fixed, kinematic, foreign kinds of body.
inline btRigidBody* movable(btCollisionObject* object) {
    btRigidBody* body = object ? btRigidBody::upcast(object) : nullptr;
    return body && body->getInvMass() > 0 && !body->isStaticOrKinematicObject() ? body : nullptr;
}
inline const btRigidBody* movable(const btCollisionObject* object) {
    return movable(const_cast<btCollisionObject*>(object));
}

inline Motion motionNow(const btCollisionObject& object) {
    const btRigidBody* body = btRigidBody::upcast(&object);
    if (!body || body->isStaticObject()) return {};
    return {body->getLinearVelocity(), body->getAngularVelocity()};
}
/// Velocity of a body's material at a world point; zero for what is not a rigid body.
btVector3 velocityAt(const btCollisionObject& body, const Motion& motion, const btVector3& point);

/// `axes`: of its inertia in the world. J.
double kineticEnergy(const btRigidBody& body, const Motion& motion, const btMatrix3x3& axes);

/// 1 / (1/m_a + 1/m_b) at the point along the normal, with rotation, kg. What is not movable counts
/// as infinitely heavy. 0 when both are.
float effectiveMass(const btCollisionObject& a, const btCollisionObject& b, const btVector3& point,
                    const btVector3& normal);

/// The opposite impulses +j n on a and -j n on b at one point.
void applyPair(btCollisionObject& a, btCollisionObject& b, const btVector3& point,
               const btVector3& impulse);

}  // namespace sherd
