// SPDX-License-Identifier: MIT
#include "bullet/bullet_bodies.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcherMt.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <typeinfo>
#include <utility>

#include "bullet/convert.h"
#include "bullet/point_distance.h"

namespace sherd {

/// Nobody is there any more who could be told of those that have gone.
BulletBodies::~BulletBodies() {
    while (!adopted_.empty()) {
        const uint32_t island = adopted_.back();
        if (isStillThere(island)) {
            letGo(island);
        } else {
            (void)bodies_[island].body.release();
            adopted_.pop_back();
        }
    }
    for (const Body& slot : bodies_)
        if (slot.body && slot.body->isInWorld()) world_.removeRigidBody(slot.body.get());
}

std::span<const uint32_t> BulletBodies::fragmentsOf(uint32_t island) const {
    const Body& slot = bodies_[island];
    return slot.shape ? slot.shape->fragments() : std::span(&slot.firstFragment, 1);
}

void BulletBodies::attach(IslandWorld& islands, std::span<const BodyRule> rules,
                          GameListener* listener, float leastImpact) {
    islands_ = &islands;
    leastImpact_ = leastImpact;
    rules_ = rules;
    listener_ = listener;
}

Pooled<IslandShape> BulletBodies::takeShape() {
    if (spareShapes_.empty()) return makePooled<IslandShape>();
    Pooled<IslandShape> shape = std::move(spareShapes_.back());
    spareShapes_.pop_back();
    return shape;
}

void BulletBodies::dropShape(Pooled<IslandShape> shape) {
    if (!shape) return;
    shape->clear();
    spareShapes_.push_back(std::move(shape));
}

/// Makes the shape, too, if there is none yet that would do.
btRigidBody::btRigidBodyConstructionInfo BulletBodies::describe(Body& slot,
                                                                const IslandBody& island) {
    const PreparedAsset& prepared = assets_.find(*island.asset);
    const FragmentShapes& shapes = *prepared.shapes;
    slot.shapes = prepared.shapes.get();
    slot.overlaps = prepared.overlaps.get();
    slot.object = island.object.index;
    slot.firstFragment = island.fragments.front();
    slot.isFixed = island.mass == 0;
    slot.diagonal = island.asset->diagonal();
    const btTransform frame = toBullet(island.frame);
    slot.objectToBody = frame.inverse();
    btCollisionShape* shape = shapes.shape(island.fragments.front());
    if (island.fragments.size() > 1) {
        if (!slot.shape) {
            slot.shape = takeShape();
            slot.shape->build(shapes, island.fragments, frame, marks_);
        }
        shape = slot.shape->shape();
    }
    btRigidBody::btRigidBodyConstructionInfo info(island.mass, nullptr, shape,
                                                  toBullet(island.inertia));
    info.m_startWorldTransform = toBullet(island.motion.pose);
    info.m_friction = island.friction;
    info.m_restitution = island.restitution;
    return info;
}

BodyFilter BulletBodies::rule(Body& slot, const IslandBody& island) {
    BodyFilter filter = filters_[slot.object];
    applyRules(rules_, island.asset->fragment(slot.firstFragment).level, *slot.body, filter);
    return filter;
}

void BulletBodies::addToWorld(Body& slot, const BodyFilter& filter) {
    if (filter.group == 0 && filter.mask == 0) {
        world_.addRigidBody(slot.body.get());
    } else {
        world_.addRigidBody(slot.body.get(), filter.group, filter.mask);
    }
}

void BulletBodies::move(btRigidBody& body, const BodyMotion& motion) {
    body.setLinearVelocity(toBullet(motion.linearVelocity));
    body.setAngularVelocity(toBullet(motion.angularVelocity));
}

void BulletBodies::create(const IslandBody& island) {
    if (bodies_.size() <= island.island) bodies_.resize(island.island + 1);
    const uint32_t object = island.object.index;
    if (filters_.size() <= object) filters_.resize(object + 1);
    if (nextFilter_) filters_[object] = *std::exchange(nextFilter_, std::nullopt);
    Body& slot = bodies_[island.island];
    if (nextAdopted_) {
        adopt(slot, island);
        watchQuiet(island);
        return;
    }
    make(slot, island);
    addToWorld(slot, rule(slot, island));
    // Bullet applies gravity once before all substeps of a step and clears it after the last.
    if (inStep_ && island.mass > 0) slot.body->applyGravity();
    watchQuiet(island);
}

/// Only pieces that came off freeze: what is whole sleeps as the game's own bodies do.
void BulletBodies::watchQuiet(const IslandBody& island) {
    const Body& slot = bodies_[island.island];
    quiet_.add(island.island, *slot.body, slot.firstFragment != 0 ? slot.own : nullptr, island.mass,
               toBullet(island.inertia));
}

/// Bullet lets sleep what lay on a body that goes.
void BulletBodies::wakeAround(const btRigidBody& body) {
    struct Wake : btBroadphaseAabbCallback {
        bool process(const btBroadphaseProxy* proxy) override {
            auto* object = static_cast<btCollisionObject*>(proxy->m_clientObject);
            if (!object->isStaticOrKinematicObject()) object->activate();
            return true;
        }
    };
    Wake wake;
    const btBroadphaseProxy& proxy = *body.getBroadphaseProxy();
    world_.getBroadphase()->aabbTest(proxy.m_aabbMin, proxy.m_aabbMax, wake);
}

void BulletBodies::make(Body& slot, const IslandBody& island) {
    auto* body = new (pool_) OwnBody(describe(slot, island), *this, island.island);
    slot.body = BodyPointer(body);
    slot.own = body;
    slot.own->watch(OwnBody::Watch::breakable, true);  // until it is known
    slot.body->setUserIndex3(int(island.island));
    slot.track.startAt(slot.body->getWorldTransform());
    slot.isKnown = false;
    move(*slot.body, island.motion);
}

/// Where it cannot change in place it goes out of the world and in again: Bullet sorts bodies into
/// fixed and moving ones when they are added, and holds contacts of the old shape.
void BulletBodies::update(const IslandBody& island) {
    quiet_.forget(island.island);
    Body& slot = bodies_[island.island];
    if (isAdopted(island.island)) {
        replaced_ = letGo(island.island);
        create(island);
        return;
    }
    btRigidBody& body = *slot.body;
    const bool isInWorld = body.isInWorld();
    const bool wasFixed = body.isStaticObject(), isFixed = island.mass == 0;
    // What slept when the step began got no weight.
    const bool isWeighed = !body.getTotalForce().isZero();
    const btVector3 weight = body.getGravity() * (isWeighed ? body.getMass() : 0);
    const bool isInPlace =
        slot.shape && wasFixed == isFixed && island.fragments.size() > 1 &&
        slot.shape->become(*slot.shapes, island.fragments, toBullet(island.frame), marks_);
    Pooled<IslandShape> old;
    if (!isInPlace) {
        if (isInWorld) world_.removeRigidBody(&body);
        old = std::move(slot.shape);
    }
    const auto info = describe(slot, island);
    if (!isInPlace) body.setCollisionShape(info.m_collisionShape);
    body.setWorldTransform(info.m_startWorldTransform);
    body.setInterpolationWorldTransform(info.m_startWorldTransform);
    slot.track.startAt(info.m_startWorldTransform);
    slot.isKnown = false;
    slot.own->watch(OwnBody::Watch::breakable, true);
    body.setMassProps(info.m_mass, info.m_localInertia);
    body.updateInertiaTensor();
    body.setFriction(info.m_friction);
    body.setRestitution(info.m_restitution);
    move(body, island.motion);
    // Bullet puts what stands fixed to sleep, and it would hang in the air; as what slept would.
    if (!isFixed && wasFixed) body.forceActivationState(ACTIVE_TAG);
    if (!isFixed) body.activate();
    const BodyFilter filter = rule(slot, island);
    if (isInWorld && isInPlace) {
        const btBroadphaseProxy& proxy = *body.getBroadphaseProxy();
        const bool isSameFilter = (filter.group == 0 && filter.mask == 0) ||
                                  (proxy.m_collisionFilterGroup == filter.group &&
                                   proxy.m_collisionFilterMask == filter.mask);
        if (isSameFilter) {
            world_.updateSingleAabb(&body);
        } else {
            world_.removeRigidBody(&body);
            addToWorld(slot, filter);
        }
    } else if (isInWorld) {
        addToWorld(slot, filter);
    }
    if (inStep_ && !isFixed) {
        body.applyCentralForce(-weight);
        body.applyCentralForce(body.getGravity() * body.getMass());
    }
    watchQuiet(island);
    dropShape(std::move(old));
}

void BulletBodies::remove(uint32_t island) {
    Body& slot = bodies_[island];
    slot.track.forget();
    if (!slot.body) return;  // the game has deleted it
    released_.forget(island);
    quiet_.forget(island);
    if (isAdopted(island)) {
        letGo(island);
        return;
    }
    if (slot.body->isInWorld()) {
        wakeAround(*slot.body);
        world_.removeRigidBody(slot.body.get());
    }
    slot.body.reset();
    slot.own = nullptr;
    dropShape(std::move(slot.shape));
}

BodyMotion BulletBodies::motion(uint32_t island) const {
    const btRigidBody& body = *bodies_[island].body;
    BodyMotion motion{toPose(body.getWorldTransform()), {}, {}};
    if (isAdopted(island)) {
        const btTransform place = body.getWorldTransform() * bodies_[island].mass;
        motion.pose = toPose(place);
        if (body.isStaticObject()) return motion;
        motion.linearVelocity =
            toGlm(body.getVelocityInLocalPoint(place.getOrigin() - body.getCenterOfMassPosition()));
        motion.angularVelocity = toGlm(body.getAngularVelocity());
        return motion;
    }
    if (body.isStaticObject()) return motion;
    motion.linearVelocity = toGlm(body.getLinearVelocity());
    motion.angularVelocity = toGlm(body.getAngularVelocity());
    return motion;
}

/// Whether Bullet asks bodies about pairs: a game's own dispatcher or near callback may not.
bool BulletBodies::asksBodies() const {
    const btDispatcher& dispatcher = *world_.getDispatcher();
    if (typeid(dispatcher) != typeid(btCollisionDispatcher) &&
        typeid(dispatcher) != typeid(btCollisionDispatcherMt))
        return false;
    return static_cast<const btCollisionDispatcher&>(dispatcher).getNearCallback() ==
           btCollisionDispatcher::defaultNearCallback;
}

bool BulletBodies::readPlaces() {
    const bool withUnbreakable = leastImpact_ < HUGE_VALF;
    if (!asksBodies()) approaches_.miss();
    bool isTouchable = false;
    awakeDebris_ = 0;
    for (uint32_t i = 0; i < bodies_.size(); ++i) {
        Body& slot = bodies_[i];
        if (!slot.body) continue;
        // As Bullet's own motion states, what sleeps is not asked where it is.
        const bool isActive = slot.body->isActive();
        const bool wasAsked = slot.own && slot.own->keepWatch();
        if (!slot.isKnown) {
            slot.isKnown = true;
            slot.isBreakable = withUnbreakable || islands_->isBreakable(i);
            if (slot.own) slot.own->watch(OwnBody::Watch::breakable, slot.isBreakable);
        }
        if (slot.isBreakable && !wasAsked) approaches_.miss();
        isTouchable =
            isTouchable || (slot.isBreakable && (isActive || slot.body->isStaticObject()));
        if (isActive && !slot.isFixed && slot.firstFragment != 0) ++awakeDebris_;
        if (!isActive && slot.track.isStill()) continue;
        if (slot.track.note(slot.body->getWorldTransform())) untold_.push_back(i);
    }
    return isTouchable;
}

void BulletBodies::tellMoves() {
    for (const uint32_t i : untold_) {
        Body& slot = bodies_[i];
        const auto move = [&](const btTransform& place) {
            islands_->moveTo(i, toPose(place * slot.objectToBody));
        };
        slot.track.tell(move, [&] { islands_->stayPut(i); });
    }
    untold_.clear();
}

void BulletBodies::onNear(const OwnBody& body, const btCollisionObject& other) noexcept {
    if (body.isWatchedAs(OwnBody::Watch::frozen)) {
        const std::scoped_lock guard(approaches_.lock());
        quiet_.onNear(body.island(), other);
    }
    if (body.isWatchedAs(OwnBody::Watch::breakable))
        approaches_.note(body, other, std::min(islands_->leastEnergy(), leastImpact_));
}

void BulletBodies::markBreakable(Vector<uint8_t>& marks) const {
    marks.assign(size_t(world_.getNumCollisionObjects()), 0);
    for (const Body& slot : bodies_)
        if (slot.body && slot.isBreakable && slot.body->isInWorld())
            marks[size_t(slot.body->getWorldArrayIndex())] = 1;
}

// The number on the body is only a hint: the game's own bodies may carry any number there.
uint32_t BulletBodies::islandOf(const btCollisionObject& body) const {
    const auto slot = uint32_t(body.getUserIndex3());
    return slot < bodies_.size() && bodies_[slot].body.get() == &body ? slot : UINT32_MAX;
}

uint32_t BulletBodies::fragmentOf(uint32_t island, int child) const {
    const Body& slot = bodies_[island];
    const bool isKnown = slot.shape && child >= 0 && size_t(child) < slot.shape->fragments().size();
    return isKnown ? slot.shape->fragmentOf(child) : slot.firstFragment;
}

uint32_t BulletBodies::fragmentAt(uint32_t island, int child, const btVector3& point) const {
    const Body& slot = bodies_[island];
    if (slot.shape && child < 0)
        pointDistance(*slot.shape->shape(), slot.body->getWorldTransform(), point, &child);
    return fragmentOf(island, child);
}

}  // namespace sherd
