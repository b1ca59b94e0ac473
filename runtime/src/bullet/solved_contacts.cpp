// SPDX-License-Identifier: MIT
#include "bullet/solved_contacts.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <LinearMath/btTransformUtil.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace sherd {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

bool awake(const btCollisionObject* object) {
    return movable(object) && object->isActive();
}

/// One manifold's points summed, relative to `origin`: `point` is still the weighted sum, the
/// twists are about `origin`.
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
        const btVector3 placeA = contact.getPositionWorldOnA() - origin;
        const btVector3 placeB = contact.getPositionWorldOnB() - origin;
        sum.normal += push;
        // Of a body that moves continuously Bullet says only what it is going to meet, as body B,
        // and there: its own place is its centre before the way.
        const bool isAhead = contact.getDistance() > manifold.getContactBreakingThreshold();
        const btVector3 place = isAhead ? placeB : (placeA + placeB) * btScalar(0.5);
        sum.point += place * contact.m_appliedImpulse;
        sum.normalImpulse += contact.m_appliedImpulse;
        if (contact.m_appliedImpulse > sum.largestImpulse) {
            sum.largestImpulse = contact.m_appliedImpulse;
            sum.childA = contact.m_index0;
            sum.childB = contact.m_index1;
        }
        if (contact.m_appliedImpulse > 0) sum.gap = std::min(sum.gap, float(contact.getDistance()));
        sum.impulse += total;
        sum.twistA += placeA.cross(total);
        sum.twistB += placeB.cross(total);
    }
    return sum;
}

/// Where a body was before the substep moved it. Not simply back by v dt: pushing apart what
/// penetrates moves bodies without giving them velocity. A contact point knows its place in the
/// body and where that was in the world before the substep.
btTransform poseBefore(const btCollisionObject& object, const btVector3& contactPoint,
                       const btVector3& inBody, float dt) {
    const btTransform& now = object.getWorldTransform();
    if (!movable(&object)) return now;
    const Motion motion = motionNow(object);
    btTransform before;
    // Not with a negative time: Bullet lets nothing turn more than a part of a turn in a step, and
    // would take back what it did not do.
    btTransformUtil::integrateTransform(now, -motion.linear, -motion.angular, dt, before);
    before.setOrigin(contactPoint - before.getBasis() * inBody);
    return before;
}

/// Other actions may have removed it since.
bool isThere(const btCollisionWorld& world, const btCollisionObject* object, int index) {
    const btCollisionObjectArray& all = world.getCollisionObjectArray();
    return index >= 0 && index < all.size() && all[index] == object;
}

int orderKey(const btCollisionObject& object) {
    return object.getBroadphaseHandle() ? object.getBroadphaseHandle()->m_uniqueId : -1;
}

}  // namespace

/// What may break, and what touches it. Returns whether anything does.
bool SolvedContacts::findNear(btCollisionWorld& world, std::span<const uint8_t> breakable) {
    near_.assign(breakable.begin(), breakable.end());
    bool isTouched = false;
    btDispatcher& dispatcher = *world.getDispatcher();
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
        const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
        if (manifold.getNumContacts() == 0) continue;
        const btCollisionObject &first = *manifold.getBody0(), &second = *manifold.getBody1();
        const auto a = size_t(first.getWorldArrayIndex()), b = size_t(second.getWorldArrayIndex());
        if (breakable[a] == 0 && breakable[b] == 0) continue;
        if (!awake(&first) && !awake(&second)) continue;
        // Not the ground: all else that lies on it does not matter.
        if (movable(&first)) near_[a] = 1;
        if (movable(&second)) near_[b] = 1;
        isTouched = true;
    }
    return isTouched;
}

/// A rough look at what moved before the solve: where everything rests there is nothing to measure.
/// It takes impulses to act where bodies are now. Two bodies have no more energy to bring than each
/// has by itself.
bool SolvedContacts::mayMatter(btCollisionWorld& world, float leastEnergy,
                               std::span<const uint8_t> breakable) {
    if (!findNear(world, breakable)) return false;
    const auto isNear = [this](const btCollisionObject& object) {
        return near_[size_t(object.getWorldArrayIndex())] != 0;
    };
    rough_.clear();
    localOf_.assign(size_t(world.getNumCollisionObjects()), kNone);
    const auto roughOf = [&](const btCollisionObject& object) {
        uint32_t& local = localOf_[size_t(object.getWorldArrayIndex())];
        if (local == kNone) {
            local = uint32_t(rough_.size());
            rough_.push_back({isNear(object) ? movable(&object) : nullptr, btVector3(0, 0, 0),
                              btVector3(0, 0, 0)});
        }
        return local;
    };
    const auto receive = [](Rough& rough, const btVector3& place, const btVector3& impulse) {
        if (!rough.body) return;
        rough.linear += impulse;
        rough.angular += (place - rough.body->getCenterOfMassPosition()).cross(impulse);
    };
    btDispatcher& dispatcher = *world.getDispatcher();
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
        const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
        if (manifold.getNumContacts() == 0) continue;
        const btCollisionObject &first = *manifold.getBody0(), &second = *manifold.getBody1();
        if (!isNear(first) && !isNear(second)) continue;
        if (!awake(&first) && !awake(&second)) continue;
        // A kinematic body brings what its own motion says.
        if (first.isKinematicObject() || second.isKinematicObject()) return true;
        const uint32_t localA = roughOf(first), localB = roughOf(second);
        Rough &a = rough_[localA], &b = rough_[localB];
        for (int i = 0; i < manifold.getNumContacts(); ++i) {
            const btManifoldPoint& point = manifold.getContactPoint(i);
            const btVector3 impulse = point.m_normalWorldOnB * point.m_appliedImpulse +
                                      point.m_lateralFrictionDir1 * point.m_appliedImpulseLateral1 +
                                      point.m_lateralFrictionDir2 * point.m_appliedImpulseLateral2;
            receive(a, point.getPositionWorldOnA(), impulse);
            receive(b, point.getPositionWorldOnB(), -impulse);
        }
    }
    constexpr double kCareful = 4;  // less than that is none, for all that was taken roughly
    return std::any_of(rough_.begin(), rough_.end(), [&](const Rough& rough) {
        if (!rough.body) return false;
        const btRigidBody& body = *rough.body;
        const Motion before{
            body.getLinearVelocity() - rough.linear * body.getInvMass() - pushOn(body),
            body.getAngularVelocity() - body.getInvInertiaTensorWorld() * rough.angular};
        return kCareful * kineticEnergy(body, before, body.getWorldTransform().getBasis()) >=
               double(leastEnergy);
    });
}

void SolvedContacts::gather(btCollisionWorld& world, float dt, bool inStep, float leastEnergy,
                            std::span<const uint8_t> breakable,
                            std::span<const Approach> approaches) {
    dt_ = dt;
    inStep_ = inStep;
    begin(world);
    isWhole_ = true;
    if (!mayMatter(world, leastEnergy, breakable)) return;
    gatherAll(world);
    takeNoted(world, approaches);
}

bool SolvedContacts::gather(btCollisionWorld& world, float dt, bool inStep,
                            std::span<const Approach> approaches) {
    dt_ = dt;
    inStep_ = inStep;
    begin(world);
    isWhole_ = false;
    const btCollisionObjectArray& all = world.getCollisionObjectArray();
    for (const Approach& approach : approaches) {
        if (!isThere(world, approach.a, approach.indexA) ||
            !isThere(world, approach.b, approach.indexB))
            return false;
        btBroadphasePair* pair =
            world.getPairCache()->findPair(all[approach.indexA]->getBroadphaseHandle(),
                                           all[approach.indexB]->getBroadphaseHandle());
        if (!pair) return false;
        if (!pair->m_algorithm) continue;
        manifolds_.resizeNoInitialize(0);
        pair->m_algorithm->getAllContactManifolds(manifolds_);
        for (int m = 0; m < manifolds_.size(); ++m) addManifold(*manifolds_[m]);
    }
    mergePairs();
    linkBodies();
    takeNoted(world, approaches);
    return true;
}

void SolvedContacts::gatherRest(btCollisionWorld& world, std::span<const Approach> approaches) {
    begin(world);
    isWhole_ = true;
    gatherAll(world);
    takeNoted(world, approaches);
}

/// What was noted is exact; of a body the last, should it have been changed between two.
void SolvedContacts::takeNoted(const btCollisionWorld& world,
                               std::span<const Approach> approaches) {
    noted_.assign(bodies_.size(), 0);
    const auto take = [&](const btCollisionObject* object, int index, const Motion& motion,
                          uint32_t sequence) {
        if (!isThere(world, object, index)) return;
        const uint32_t local = localOf_[size_t(index)];
        if (local == kNone || sequence + 1 <= noted_[local]) return;
        noted_[local] = sequence + 1;
        before_[local] = motion;
        before_[local].linear += pushOfForces(local);
    };
    for (const Approach& approach : approaches) {
        take(approach.a, approach.indexA, approach.motionA, approach.sequence);
        take(approach.b, approach.indexB, approach.motionB, approach.sequence);
    }
}

size_t SolvedContacts::find(const btCollisionObject& a, const btCollisionObject& b) const {
    const bool swapped = orderKey(a) > orderKey(b);
    const auto key = std::pair(localOf_[size_t((swapped ? b : a).getWorldArrayIndex())],
                               localOf_[size_t((swapped ? a : b).getWorldArrayIndex())]);
    const auto found = std::lower_bound(
        pairs_.begin(), pairs_.end(), key,
        [](const SolvedPair& pair, const auto& k) { return std::pair(pair.a, pair.b) < k; });
    const bool isFound = found != pairs_.end() && std::pair(found->a, found->b) == key;
    return isFound ? size_t(found - pairs_.begin()) : pairs_.size();
}

void SolvedContacts::begin(const btCollisionWorld& world) {
    pairs_.clear();
    bodies_.clear();
    posesBefore_.clear();
    localOf_.assign(size_t(world.getNumCollisionObjects()), kNone);
}

void SolvedContacts::gatherAll(btCollisionWorld& world) {
    localOf_.assign(size_t(world.getNumCollisionObjects()), kNone);
    btDispatcher& dispatcher = *world.getDispatcher();
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m)
        addManifold(*dispatcher.getManifoldByIndexInternal(m));
    mergePairs();
    linkBodies();
}

void SolvedContacts::addManifold(const btPersistentManifold& manifold) {
    if (manifold.getNumContacts() == 0) return;
    if (!awake(manifold.getBody0()) && !awake(manifold.getBody1())) return;
    auto* a = const_cast<btCollisionObject*>(manifold.getBody0());
    auto* b = const_cast<btCollisionObject*>(manifold.getBody1());
    const btManifoldPoint& any = manifold.getContactPoint(0);
    const uint32_t localA = localIndex(*a, any.m_positionWorldOnA, any.m_localPointA);
    const uint32_t localB = localIndex(*b, any.m_positionWorldOnB, any.m_localPointB);
    // The same way round in every manifold of a pair of compounds, so that they can be summed.
    const bool swapped = orderKey(*a) > orderKey(*b);
    if (swapped) std::swap(a, b);
    SolvedPair pair = sumPoints(manifold, a->getWorldTransform().getOrigin());
    if (!(pair.normalImpulse > 0)) return;
    if (swapped) {
        pair.normal = -pair.normal;
        pair.impulse = -pair.impulse;
        std::swap(pair.childA, pair.childB);
        std::swap(pair.twistA, pair.twistB);
        pair.twistA = -pair.twistA;
        pair.twistB = -pair.twistB;
    }
    pair.a = swapped ? localB : localA;
    pair.b = swapped ? localA : localB;
    pair.order = uint32_t(pairs_.size());
    pairs_.push_back(pair);
}

uint32_t SolvedContacts::localIndex(btCollisionObject& body, const btVector3& contactPoint,
                                    const btVector3& inBody) {
    uint32_t& local = localOf_[size_t(body.getWorldArrayIndex())];
    if (local == kNone) {
        local = uint32_t(bodies_.size());
        bodies_.push_back(&body);
        posesBefore_.push_back(poseBefore(body, contactPoint, inBody, dt_));
    }
    return local;
}

/// Compounds have a manifold per child: the pairs of equal bodies become one.
void SolvedContacts::mergePairs() {
    std::sort(pairs_.begin(), pairs_.end(), [](const SolvedPair& x, const SolvedPair& y) {
        return std::tie(x.a, x.b, x.order) < std::tie(y.a, y.b, y.order);
    });
    size_t count = 0;
    for (const SolvedPair& pair : pairs_) {
        SolvedPair* last = count > 0 ? &pairs_[count - 1] : nullptr;
        if (last && last->a == pair.a && last->b == pair.b) {
            last->normal += pair.normal;
            last->point += pair.point;
            last->normalImpulse += pair.normalImpulse;
            last->gap = std::min(last->gap, pair.gap);
            if (pair.largestImpulse > last->largestImpulse) {
                last->largestImpulse = pair.largestImpulse;
                last->childA = pair.childA;
                last->childB = pair.childB;
            }
            last->impulse += pair.impulse;
            last->twistA += pair.twistA;
            last->twistB += pair.twistB;
        } else {
            pairs_[count++] = pair;
        }
    }
    pairs_.resize(count);
    for (SolvedPair& pair : pairs_) {
        pair.point /= pair.normalImpulse;
        pair.normalImpulse = pair.normal.length();
        if (pair.normalImpulse > 0) pair.normal /= pair.normalImpulse;
        pair.twistA -= pair.point.cross(pair.impulse);
        pair.twistB -= pair.point.cross(pair.impulse);
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
            const btVector3 arm = pair.point - posesBefore_[body].getOrigin();
            received_[body].linear += pair.impulse * sign;
            const btVector3& twist = body == pair.a ? pair.twistA : pair.twistB;
            received_[body].angular += (twist + arm.cross(pair.impulse)) * sign;
            links_[--firstLink_[body + 1]] = uint32_t(p);
        }
    }
    // Filling moved every entry to the start of its own list: shift them back into place.
    firstLink_.erase(firstLink_.begin());
    firstLink_.push_back(uint32_t(links_.size()));

    before_.clear();
    for (uint32_t i = 0; i < bodies_.size(); ++i) {
        before_.push_back(motionNow(*bodies_[i]));
        const btRigidBody* body = movable(bodies_[i]);
        if (!body) continue;
        before_[i].linear -= received_[i].linear * body->getInvMass() * body->getLinearFactor();
        const btMatrix3x3& axes = posesBefore_[i].getBasis();
        const btMatrix3x3 yield = axes.scaled(body->getInvInertiaDiagLocal()) * axes.transpose();
        before_[i].angular -= yield * received_[i].angular * body->getAngularFactor();
    }
}

btVector3 SolvedContacts::moved(uint32_t index) const {
    return bodies_[index]->getWorldTransform().getOrigin() - posesBefore_[index].getOrigin();
}

Motion SolvedContacts::motionBefore(uint32_t index) const {
    return before_[index];
}

btVector3 SolvedContacts::pushOfForces(uint32_t index) const {
    const btRigidBody* body = movable(bodies_[index]);
    return body ? pushOn(*body) : btVector3(0, 0, 0);
}

btVector3 SolvedContacts::pushOn(const btRigidBody& body) const {
    if (!inStep_) return body.getGravity() * dt_;
    return body.getTotalForce() * body.getInvMass() * dt_;
}

float SolvedContacts::undoAround(size_t pair, float leastImpulse) {
    if (pairs_[pair].undone) return 0;
    touched_.clear();
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
    return surplusEnergy();
}

void SolvedContacts::undo(SolvedPair& pair) {
    pair.undone = true;
    btRigidBody* a = movable(bodies_[pair.a]);
    btRigidBody* b = movable(bodies_[pair.b]);
    for (const uint32_t index : {pair.a, pair.b}) {
        btRigidBody* body = index == pair.a ? a : b;
        if (!body) continue;
        const btScalar sign = index == pair.a ? btScalar(-1) : btScalar(1);
        body->applyCentralImpulse(pair.impulse * sign);
        const btVector3 arm = pair.point - posesBefore_[index].getOrigin();
        const btVector3& twist = index == pair.a ? pair.twistA : pair.twistB;
        body->applyTorqueImpulse((twist + arm.cross(pair.impulse)) * sign);
        touched_.push_back(index);
    }
    if (!a || !b) return;
    // The centres have moved since, and where the bodies penetrate the solver's friction acts at
    // two points: what that makes in angular momentum is taken back by a couple, mostly on the body
    // that is hard to turn.
    const btVector3 couple =
        (moved(pair.a) - moved(pair.b)).cross(pair.impulse) + pair.twistA - pair.twistB;
    const btScalar yieldA = couple.dot(a->getInvInertiaTensorWorld() * couple);
    const btScalar yieldB = couple.dot(b->getInvInertiaTensorWorld() * couple);
    if (!(yieldA + yieldB > 0)) return;
    a->applyTorqueImpulse(couple * (yieldB / (yieldA + yieldB)));
    b->applyTorqueImpulse(couple * (yieldA / (yieldA + yieldB)));
}

float SolvedContacts::surplusEnergy() {
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    double surplus = 0;
    for (const uint32_t index : touched_) {
        const btRigidBody& body = *movable(bodies_[index]);
        surplus += kineticEnergy(body, motionNow(body), body.getWorldTransform().getBasis()) -
                   kineticEnergy(body, before_[index], posesBefore_[index].getBasis());
    }
    return float(std::max(surplus, 0.0));
}

}  // namespace sherd
