// SPDX-License-Identifier: MIT
// Bullet asks breakable bodies of what comes near, and only those contacts are read. Where it may
// not ask, all of them are: the same must break.
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <doctest/doctest.h>

#include <vector>

#include "impact/bullet_world.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

btCollisionDispatcher& dispatcherOf(BulletWorld& bullet) {
    return static_cast<btCollisionDispatcher&>(*bullet.world.getDispatcher());
}

/// A game's own, which asks nobody.
void ownNearCallback(btBroadphasePair& pair, btCollisionDispatcher& dispatcher,
                     const btDispatcherInfo& info) {
    auto* a = static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject);
    auto* b = static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject);
    if (!a->isActive() && !b->isActive()) return;
    const btCollisionObjectWrapper wholeA(nullptr, a->getCollisionShape(), a,
                                          a->getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper wholeB(nullptr, b->getCollisionShape(), b,
                                          b->getWorldTransform(), -1, -1);
    if (!pair.m_algorithm)
        pair.m_algorithm =
            dispatcher.findAlgorithm(&wholeA, &wholeB, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    if (!pair.m_algorithm) return;
    btManifoldResult result(&wholeA, &wholeB);
    pair.m_algorithm->processCollision(&wholeA, &wholeB, info, &result);
}

enum class Reading { pairByPair, all, twice };

struct Outcome {
    std::vector<BreakEvent> events;
    std::vector<bool> broken;  ///< per bond, of all objects
};

/// A ball strikes one of three objects that lean on each other, which may strike back.
Outcome strike(uint32_t seed, Reading reading) {
    Random random(seed);
    const auto in = [&](double low, double high) { return float(random.in(low, high)); };
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    if (reading == Reading::all) dispatcherOf(bullet).setNearCallback(ownNearCallback);
    DestructionWorld destruction(bullet.world, drivenByHand());
    const auto asset = makeBox({.size = {0.4F, 1, 0.4F}, .level2 = {1, 2, 2}, .toughness = 20});
    std::vector<ObjectId> objects;
    objects.reserve(3);
    for (int i = 0; i < 3; ++i)
        objects.push_back(destruction.spawn(asset, at(0.41F * float(i), 0.5F, 0)).value());
    const bool isAnchored = random.oneIn(3);
    if (isAnchored) (void)destruction.anchorInBox(objects[1], {-1, -1, -1}, {1, -0.4F, 1});
    btRigidBody& ball =
        bullet.addBall(in(0.05, 0.2), in(5, 60), btVector3(-1, in(0.3, 0.9), in(-0.2, 0.2)),
                       btVector3(in(3, 20), in(-2, 2), in(-1, 1)));
    ball.setAngularVelocity(btVector3(in(-9, 9), in(-9, 9), in(-9, 9)));
    Outcome outcome;
    for (int i = 0; i < 60 && outcome.events.empty(); ++i) {
        if (reading == Reading::twice) bullet.world.performDiscreteCollisionDetection();
        bullet.step();
        destruction.afterStep(kStep);
        const auto events = destruction.events();
        outcome.events.assign(events.begin(), events.end());
    }
    outcome.broken.reserve(objects.size() * asset->graph().bonds().size());
    for (const ObjectId object : objects)
        for (uint32_t b = 0; b < asset->graph().bonds().size(); ++b)
            outcome.broken.push_back(destruction.structure(object)->isBroken(b));
    return outcome;
}

}  // namespace

TEST_CASE("contacts read pair by pair break the same as all of them read") {
    int hits = 0;
    for (const uint32_t seed : propertySeeds(1, 300)) {
        CAPTURE(seed);
        const Outcome some = strike(seed, Reading::pairByPair), all = strike(seed, Reading::all);
        hits += all.events.empty() ? 0 : 1;
        REQUIRE(some.events.size() == all.events.size());
        // Where all are read, motion is worked back from impulses: not from what Bullet turned
        // bodies by to push them apart.
        for (size_t e = 0; e < all.events.size(); ++e) {
            CHECK(some.events[e].object == all.events[e].object);
            CHECK(some.events[e].fragment == all.events[e].fragment);
            CHECK(some.events[e].energy == doctest::Approx(all.events[e].energy).epsilon(0.05));
            CHECK(some.events[e].impulse == doctest::Approx(all.events[e].impulse).epsilon(0.01));
            CHECK(some.events[e].bodies == all.events[e].bodies);
        }
        CHECK(some.broken == all.broken);
    }
    CHECK(hits > propertyCases(300) / 2);
}

TEST_CASE("a game that looks for collisions itself before the step breaks no more by it") {
    for (const uint32_t seed : propertySeeds(1, 30)) {
        CAPTURE(seed);
        const Outcome once = strike(seed, Reading::pairByPair),
                      twice = strike(seed, Reading::twice);
        REQUIRE(once.events.size() == twice.events.size());
        for (size_t e = 0; e < once.events.size(); ++e)
            CHECK(once.events[e].energy == doctest::Approx(twice.events[e].energy).epsilon(0.01));
    }
}

TEST_CASE("a body breaks after the game has let it collide again with another") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
    btRigidBody& ball = bullet.addBall(0.2F, 50, btVector3(-2, 0, 0), btVector3(10, 0, 0));
    btRigidBody& body = *destruction.body(box);
    bool isBroken = false;
    for (int i = 0; i < 60 && !isBroken; ++i) {
        // Bullet forgets then that it has to ask.
        body.setIgnoreCollisionCheck(&ball, true);
        body.setIgnoreCollisionCheck(&ball, false);
        bullet.step();
        isBroken = !destruction.events().empty();
    }
    CHECK(isBroken);
}

TEST_CASE("a body breaks in its first substep, though the game has just let it collide again") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    btRigidBody& ball = bullet.addBall(0.2F, 50, btVector3(-0.75F, 0, 0), btVector3(10, 0, 0));
    const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
    destruction.body(box)->setIgnoreCollisionCheck(&ball, true);
    destruction.body(box)->setIgnoreCollisionCheck(&ball, false);
    for (int i = 0; i < 2; ++i) bullet.step();
    CHECK(destruction.events().size() == 1);
}

TEST_CASE("objects break under a dispatcher of the game's that asks nobody") {
    struct Layers : btCollisionDispatcher {
        using btCollisionDispatcher::btCollisionDispatcher;
        bool needsCollision(const btCollisionObject* /*a*/,
                            const btCollisionObject* /*b*/) override {
            return true;
        }
    };
    btDefaultCollisionConfiguration configuration;
    Layers dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    world.setGravity(btVector3(0, 0, 0));
    btSphereShape sphere(0.2F);
    btRigidBody ball(50, nullptr, &sphere, btVector3(1, 1, 1));
    ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(-2, 0, 0)));
    ball.setLinearVelocity(btVector3(10, 0, 0));
    world.addRigidBody(&ball);
    {
        DestructionWorld destruction(world);
        (void)destruction.spawn(makeBox(), at(0, 0, 0)).value();
        for (int i = 0; i < 60; ++i) world.stepSimulation(kStep, 0);
        CHECK(destruction.events().size() == 1);
    }
    world.removeRigidBody(&ball);
}

TEST_CASE("a light body made kinematic, that only turns, breaks a heavy object") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    (void)destruction.spawn(makeBox({.toughness = 20}), at(0, 0, 0)).value();
    btRigidBody& arm = bullet.add(std::make_unique<btBoxShape>(btVector3(0.05F, 1, 0.05F)), 0.1F,
                                  btVector3(-1.2F, 0, 0), btVector3(0, 0, 0));
    arm.setCollisionFlags(arm.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    arm.setActivationState(DISABLE_DEACTIVATION);
    bool isBroken = false;
    for (int i = 0; i < 60 && !isBroken; ++i) {
        arm.setWorldTransform(btTransform(btQuaternion(btVector3(0, 0, 1), -0.1F * float(i)),
                                          btVector3(-1.2F, 0, 0)));
        bullet.world.stepSimulation(kStep, 1, kStep);
        isBroken = !destruction.events().empty();
    }
    CHECK(isBroken);
}

TEST_CASE("a ball that the game has stopped after it looked for collisions itself breaks nothing") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    (void)destruction.spawn(makeBox({.toughness = 0.01F}), at(0, 0, 0)).value();
    btRigidBody& ball = bullet.addBall(0.2F, 50, btVector3(-0.71F, 0, 0), btVector3(10, 0, 0));
    bullet.world.performDiscreteCollisionDetection();
    ball.setLinearVelocity(btVector3(0.001F, 0, 0));
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(destruction.events().empty());
}

TEST_CASE("a hitter that another action takes away in the substep of its hit is not looked at") {
    struct Thief : btActionInterface {
        BulletWorld* bullet = nullptr;
        btRigidBody* body = nullptr;
        void updateAction(btCollisionWorld* /*world*/, btScalar /*dt*/) override {
            if (!body || body->getLinearVelocity().x() > 9) return;
            bullet->take(*body);
            body = nullptr;
        }
        void debugDraw(btIDebugDraw* /*drawer*/) override {}
    };
    BulletWorld bullet;
    Thief thief;
    thief.bullet = &bullet;
    bullet.world.addAction(&thief);
    {
        DestructionWorld destruction(bullet.world);
        const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
        thief.body = &bullet.addBall(0.2F, 50, btVector3(-2, 0, 0), btVector3(10, 0, 0));
        for (int i = 0; i < 60; ++i) bullet.step();
        CHECK(thief.body == nullptr);
        CHECK(destruction.isAlive(box));
    }
    bullet.world.removeAction(&thief);
}
