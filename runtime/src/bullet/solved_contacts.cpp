// SPDX-License-Identifier: MIT
#include "bullet/solved_contacts.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>
#include <utility>

namespace sherd {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

btRigidBody* movable(btCollisionObject* object) {
    btRigidBody* body = object ? btRigidBody::upcast(object) : nullptr;
    return body && body->getInvMass() > 0 && !body->isStaticOrKinematicObject() ? body : nullptr;
}

const btRigidBody* movable(const btCollisionObject* object) {
    return movable(const_cast<btCollisionObject*>(object));
}

bool awake(const btCollisionObject* object) {
    return movable(object) && object->isActive();
}

/// One manifold's points summed, relative to `origin`: `point` is still the weighted sum, `twist`
/// the moment about `origin`.
SolvedPair sumPoints(const btPersistentManifold& manifold, const btVector3& origin) {
    SolvedPair sum;
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
        const btManifoldPoint& contact = manifold.getContactPoint(i);
        // The solver skips such points; what they hold is from an earlier substep.
        if (contact.getDistance() > manifold.getContactProcessingThreshold()) continue;
        const btVector3 push = contact.m_normalWorldOnB * contact.m_appliedImpulse;
        const btVector3 total = push +
                                contact.m_lateralFrictionDir1 * contact.m_appliedImpulseLateral1 +
                                contact.m_lateralFrictionDir2 * contact.m_appliedImpulseLateral2;
        const btVector3 place =
            (contact.getPositionWorldOnA() + contact.getPositionWorldOnB()) * btScalar(0.5) -
            origin;
        sum.normal += push;
        sum.point += place * contact.m_appliedImpulse;
        sum.normalImpulse += contact.m_appliedImpulse;
        sum.impulse += total;
        sum.twist += place.cross(total);
    }
    return sum;
}

int orderKey(const btCollisionObject& object) {
    return object.getBroadphaseHandle() ? object.getBroadphaseHandle()->m_uniqueId : -1;
}

}  // namespace

void SolvedContacts::gather(btCollisionWorld& world) {
    pairs_.clear();
    bodies_.clear();
    localOf_.assign(size_t(world.getNumCollisionObjects()), kNone);
    btDispatcher& dispatcher = *world.getDispatcher();
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
        const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
        if (manifold.getNumContacts() == 0) continue;
        if (!awake(manifold.getBody0()) && !awake(manifold.getBody1())) continue;
        auto* a = const_cast<btCollisionObject*>(manifold.getBody0());
        auto* b = const_cast<btCollisionObject*>(manifold.getBody1());
        // The same way round in every manifold of a pair of compounds, so that they can be summed.
        const bool swapped = orderKey(*a) > orderKey(*b);
        if (swapped) std::swap(a, b);
        SolvedPair pair = sumPoints(manifold, a->getWorldTransform().getOrigin());
        if (!(pair.normalImpulse > 0)) continue;
        if (swapped) {
            pair.normal = -pair.normal;
            pair.impulse = -pair.impulse;
            pair.twist = -pair.twist;
        }
        pair.a = localIndex(*a);
        pair.b = localIndex(*b);
        pairs_.push_back(pair);
    }
    mergePairs();
    linkBodies();
}

uint32_t SolvedContacts::localIndex(btCollisionObject& body) {
    uint32_t& local = localOf_[size_t(body.getWorldArrayIndex())];
    if (local == kNone) {
        local = uint32_t(bodies_.size());
        bodies_.push_back(&body);
    }
    return local;
}

/// Compounds have a manifold per child: the pairs of equal bodies become one.
void SolvedContacts::mergePairs() {
    std::stable_sort(pairs_.begin(), pairs_.end(), [](const SolvedPair& x, const SolvedPair& y) {
        return std::pair(x.a, x.b) < std::pair(y.a, y.b);
    });
    size_t count = 0;
    for (const SolvedPair& pair : pairs_) {
        SolvedPair* last = count > 0 ? &pairs_[count - 1] : nullptr;
        if (last && last->a == pair.a && last->b == pair.b) {
            last->normal += pair.normal;
            last->point += pair.point;
            last->normalImpulse += pair.normalImpulse;
            last->impulse += pair.impulse;
            last->twist += pair.twist;
        } else {
            pairs_[count++] = pair;
        }
    }
    pairs_.resize(count);
    for (SolvedPair& pair : pairs_) {
        pair.point /= pair.normalImpulse;
        pair.normalImpulse = pair.normal.length();
        if (pair.normalImpulse > 0) pair.normal /= pair.normalImpulse;
        pair.twist -= pair.point.cross(pair.impulse);
        pair.point += bodies_[pair.a]->getWorldTransform().getOrigin();
    }
}

void SolvedContacts::linkBodies() {
    received_.assign(bodies_.size(), Motion{});
    firstLink_.assign(bodies_.size() + 1, 0);
    for (const SolvedPair& pair : pairs_) {
        ++firstLink_[pair.a + 1];
        ++firstLink_[pair.b + 1];
    }
    for (size_t i = 1; i < firstLink_.size(); ++i) firstLink_[i] += firstLink_[i - 1];
    links_.assign(pairs_.size() * 2, 0);
    for (size_t p = pairs_.size(); p-- > 0;) {
        const SolvedPair& pair = pairs_[p];
        for (const uint32_t body : {pair.a, pair.b}) {
            const btScalar sign = body == pair.a ? btScalar(1) : btScalar(-1);
            const btVector3 arm = pair.point - bodies_[body]->getWorldTransform().getOrigin();
            received_[body].linear += pair.impulse * sign;
            received_[body].angular += (pair.twist + arm.cross(pair.impulse)) * sign;
            links_[--firstLink_[body + 1]] = uint32_t(p);
        }
    }
    // Filling moved every entry to the start of its own list: shift them back into place.
    firstLink_.erase(firstLink_.begin());
    firstLink_.push_back(uint32_t(links_.size()));
}

Motion SolvedContacts::motionBefore(uint32_t index) const {
    Motion motion = motionNow(*bodies_[index]);
    const btRigidBody* body = movable(bodies_[index]);
    if (!body) return motion;
    motion.linear -= received_[index].linear * body->getInvMass() * body->getLinearFactor();
    motion.angular -=
        body->getInvInertiaTensorWorld() * received_[index].angular * body->getAngularFactor();
    return motion;
}

void SolvedContacts::undoAround(size_t pair, float leastImpulse) {
    if (pairs_[pair].undone) return;
    queue_.assign(1, pair);
    undo(pairs_[pair]);
    while (!queue_.empty()) {
        const SolvedPair& from = pairs_[queue_.back()];
        queue_.pop_back();
        for (const uint32_t body : {from.a, from.b}) {
            if (!movable(bodies_[body])) continue;
            for (uint32_t l = firstLink_[body]; l < firstLink_[body + 1]; ++l) {
                SolvedPair& next = pairs_[links_[l]];
                if (next.undone || next.normalImpulse < leastImpulse) continue;
                if (!bodies_[next.a] || !bodies_[next.b]) continue;
                undo(next);
                queue_.push_back(links_[l]);
            }
        }
    }
}

void SolvedContacts::undo(SolvedPair& pair) {
    pair.undone = true;
    for (const uint32_t index : {pair.a, pair.b}) {
        btRigidBody* body = movable(bodies_[index]);
        if (!body) continue;
        const btScalar sign = index == pair.a ? btScalar(-1) : btScalar(1);
        body->applyImpulse(pair.impulse * sign, pair.point - body->getCenterOfMassPosition());
        body->applyTorqueImpulse(pair.twist * sign);
    }
}

btVector3 velocityAt(const btCollisionObject& body, const Motion& motion, const btVector3& point) {
    return motion.linear + motion.angular.cross(point - body.getWorldTransform().getOrigin());
}

Motion motionNow(const btCollisionObject& object) {
    const btRigidBody* body = btRigidBody::upcast(&object);
    if (!body || body->isStaticObject()) return {};
    return {body->getLinearVelocity(), body->getAngularVelocity()};
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
