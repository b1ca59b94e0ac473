// SPDX-License-Identifier: MIT
#include "bullet/bullet_bodies.h"

#include <utility>

#include "bullet/convert.h"

namespace sherd {

BulletBodies::~BulletBodies() {
    for (Body& slot : bodies_)
        if (slot.body && slot.body->isInWorld()) world_.removeRigidBody(slot.body.get());
}

void BulletBodies::prepare(const std::shared_ptr<const Asset>& asset) {
    for (const auto& shapes : shapes_)
        if (shapes->asset() == asset) return;
    shapes_.push_back(std::make_unique<FragmentShapes>(asset));
}

FragmentShapes& BulletBodies::shapesOf(const Asset& asset) const {
    size_t i = 0;
    while (shapes_[i]->asset().get() != &asset) ++i;
    return *shapes_[i];
}

/// Makes the shape, too, if there is none yet that would do.
btRigidBody::btRigidBodyConstructionInfo BulletBodies::describe(Body& slot,
                                                                const IslandBody& island) {
    const FragmentShapes& shapes = shapesOf(*island.asset);
    slot.object = island.object.index;
    slot.firstFragment = island.fragments.front();
    slot.diagonal = island.asset->diagonal();
    slot.frame = toBullet(island.frame);
    btCollisionShape* shape = shapes.shape(island.fragments.front());
    if (island.fragments.size() > 1) {
        slot.shape = std::make_unique<IslandShape>(shapes, island.fragments, slot.frame);
        shape = slot.shape->shape();
    }
    btRigidBody::btRigidBodyConstructionInfo info(island.mass, nullptr, shape,
                                                  toBullet(island.inertia));
    info.m_startWorldTransform = toBullet(island.motion.pose);
    info.m_friction = island.friction;
    info.m_restitution = island.restitution;
    return info;
}

void BulletBodies::addToWorld(Body& slot) {
    const Filter filter = filters_[slot.object];
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
    auto body = std::make_unique<DebrisBody>(describe(slot, island));
    slot.freezable = body.get();
    slot.body = std::move(body);
    slot.body->setUserIndex3(int(island.island));
    slot.seen = slot.body->getWorldTransform();
    slot.isStill = slot.isKnown = false;
    move(*slot.body, island.motion);
    addToWorld(slot);
    // Bullet applies gravity once before all substeps of a step and clears it after the last.
    if (inStep_ && island.mass > 0) slot.body->applyGravity();
    watchQuiet(island);
}

/// Only pieces that came off freeze: what is whole sleeps as the game's own bodies do.
void BulletBodies::watchQuiet(const IslandBody& island) {
    const Body& slot = bodies_[island.island];
    quiet_.add(island.island, *slot.body, slot.firstFragment != 0 ? slot.freezable : nullptr,
               island.mass, toBullet(island.inertia));
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

/// Out of the world and in again: Bullet sorts bodies into fixed and moving ones when they are
/// added, and holds contacts of the old shape.
void BulletBodies::update(const IslandBody& island) {
    quiet_.forget(island.island);
    Body& slot = bodies_[island.island];
    btRigidBody& body = *slot.body;
    const bool isInWorld = body.isInWorld();
    const bool wasFixed = body.isStaticObject();
    const btVector3 weight = body.getGravity() * body.getMass();
    if (isInWorld) world_.removeRigidBody(&body);
    const std::unique_ptr<IslandShape> old = std::move(slot.shape);
    const auto info = describe(slot, island);
    body.setCollisionShape(info.m_collisionShape);
    body.setWorldTransform(info.m_startWorldTransform);
    body.setInterpolationWorldTransform(info.m_startWorldTransform);
    slot.seen = info.m_startWorldTransform;
    slot.isStill = slot.isKnown = false;
    body.setMassProps(info.m_mass, info.m_localInertia);
    body.updateInertiaTensor();
    body.setFriction(info.m_friction);
    body.setRestitution(info.m_restitution);
    move(body, island.motion);
    // Bullet puts what stands fixed to sleep, and it would hang in the air.
    if (wasFixed && island.mass > 0) body.forceActivationState(ACTIVE_TAG);
    if (isInWorld) addToWorld(slot);
    if (inStep_ && island.mass > 0)
        body.applyCentralForce(body.getGravity() * body.getMass() - weight);
    watchQuiet(island);
}

void BulletBodies::remove(uint32_t island) {
    Body& slot = bodies_[island];
    released_.forget(island);
    quiet_.forget(island);
    if (slot.body->isInWorld()) {
        wakeAround(*slot.body);
        world_.removeRigidBody(slot.body.get());
    }
    slot.body.reset();
    slot.freezable = nullptr;
    slot.shape.reset();
}

BodyMotion BulletBodies::motion(uint32_t island) const {
    const btRigidBody& body = *bodies_[island].body;
    BodyMotion motion{toPose(body.getWorldTransform()), {}, {}};
    if (body.isStaticObject()) return motion;
    motion.linearVelocity = toGlm(body.getLinearVelocity());
    motion.angularVelocity = toGlm(body.getAngularVelocity());
    return motion;
}

bool BulletBodies::readPoses(IslandWorld& islands) {
    bool isTouchable = false;
    awakeDebris_ = 0;
    for (uint32_t i = 0; i < bodies_.size(); ++i) {
        Body& slot = bodies_[i];
        if (!slot.body) continue;
        // As Bullet's own motion states, what sleeps is not asked where it is.
        const bool isActive = slot.body->isActive();
        const bool isFixed = slot.body->getInvMass() == 0;
        if (!slot.isKnown) {
            slot.isKnown = true;
            slot.isBreakable = islands.isBreakable(i);
        }
        isTouchable =
            isTouchable || (slot.isBreakable && (isActive || slot.body->isStaticObject()));
        if (isActive && !isFixed && slot.firstFragment != 0) ++awakeDebris_;
        if (!isActive && slot.isStill) continue;
        const btTransform& now = slot.body->getWorldTransform();
        const bool isStill = now == slot.seen;
        if (!isStill) {
            islands.moveTo(i, toPose(now * slot.frame.inverse()));
            slot.seen = now;
        } else if (!slot.isStill) {
            islands.stayPut(i);
        }
        slot.isStill = isStill;
    }
    return isTouchable;
}

void BulletBodies::markBreakable(std::vector<uint8_t>& marks) const {
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
    return slot.shape && child >= 0 ? slot.shape->fragmentOf(child) : slot.firstFragment;
}

}  // namespace sherd
