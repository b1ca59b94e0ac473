// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("removing an object, broken or not, leaves the world as it was") {
    BulletWorld bullet;
    bullet.addGround(-10);
    DestructionWorld destruction(bullet.world);
    const int before = bullet.world.getNumCollisionObjects();
    const auto asset = makeBox({.level2 = {2, 2, 2}, .hullGrowth = 0.02F});
    const ObjectId intact = destruction.spawn(asset, at(0, 0, 0)).value();
    const ObjectId broken = destruction.spawn(asset, at(3, 0, 0)).value();
    REQUIRE(destruction.breakFragment(broken));
    REQUIRE(destruction.breakFragment(broken, 4));
    bullet.step();
    CHECK(destruction.remove(broken));
    CHECK(destruction.ignoredPairCount() == 0);
    CHECK(destruction.poses().size() == 1);
    CHECK(destruction.remove(intact));
    CHECK(bullet.world.getNumCollisionObjects() == before);
    CHECK(destruction.bodyCount() == 0);
    CHECK(destruction.poses().empty());
    bullet.step();
}

TEST_CASE("the handle of a removed object stays invalid when its place is used again") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    const ObjectId old = destruction.spawn(asset, at(0, 0, 0)).value();
    CHECK(destruction.isAlive(old));
    CHECK(destruction.remove(old));
    const ObjectId fresh = destruction.spawn(asset, at(0, 0, 0)).value();
    CHECK(fresh.index == old.index);
    CHECK_FALSE(fresh == old);
    CHECK_FALSE(destruction.isAlive(old));
    CHECK_FALSE(destruction.remove(old));
    CHECK_FALSE(destruction.breakFragment(old));
    CHECK(destruction.body(old) == nullptr);
    CHECK_FALSE(destruction.isAlive(ObjectId{}));
}

TEST_CASE("a DestructionWorld destroyed in the middle of it all takes only its own bodies along") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    bullet.addBall(0.2F, 100, btVector3(-2, 0.5F, 0), btVector3(15, 0, 0));
    {
        DestructionWorld destruction(bullet.world);
        (void)destruction.spawn(makeBox({.level2 = {2, 2, 2}, .hullGrowth = 0.01F}),
                                at(0, 0.6F, 0));
        REQUIRE(stepUntilBreak(bullet, destruction, 60));
    }
    CHECK(bullet.world.getNumCollisionObjects() == 2);
    for (int i = 0; i < 60; ++i) bullet.step();
}

TEST_CASE("two DestructionWorlds on one Bullet world do not touch each other's bodies") {
    BulletWorld bullet;
    DestructionWorld one(bullet.world);
    DestructionWorld two(bullet.world);
    const auto asset = makeBox();
    const ObjectId box = one.spawn(asset, at(0, 0, 0)).value();
    (void)two.spawn(asset, at(2, 0, 0)).value();
    CHECK(one.find(*one.body(box)).has_value());
    CHECK_FALSE(two.find(*one.body(box)).has_value());
    bullet.addBall(0.2F, 50, btVector3(-2, 0, 0), btVector3(15, 0, 0));
    CHECK(stepUntilBreak(bullet, one, 60));
    CHECK(two.bodyCount() == 1);
}

TEST_CASE("a body found by the game names its object and fragment, a foreign one nothing") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
    REQUIRE(destruction.breakFragment(box));
    const auto info = destruction.find(*destruction.body(box, 5));
    REQUIRE(info.has_value());
    CHECK(info->object == box);
    CHECK(info->fragment == 5);
    btRigidBody& ball = bullet.addBall(0.1F, 1, btVector3(9, 9, 9), btVector3(0, 0, 0));
    CHECK_FALSE(destruction.find(ball).has_value());
    ball.setUserIndex3(2);  // the game's own number
    CHECK_FALSE(destruction.find(ball).has_value());
}

TEST_CASE("bad arguments to spawn are errors and leave the world alone") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto code = [](const Result<ObjectId>& result) {
        REQUIRE_FALSE(result.has_value());
        return result.error().code;
    };
    CHECK(code(destruction.spawn(nullptr, at(0, 0, 0))) == ErrorCode::badArgument);
    CHECK(code(destruction.spawn(asset, at(nan, 0, 0))) == ErrorCode::badArgument);
    RigidPose skewed;
    skewed.rotation = glm::quat(0, 0, 0, 0);
    CHECK(code(destruction.spawn(asset, skewed)) == ErrorCode::badArgument);
    SpawnOptions options;
    options.linearVelocity.y = nan;
    CHECK(code(destruction.spawn(asset, at(0, 0, 0), options)) == ErrorCode::badArgument);
    options = {};
    options.damage.toughnessScale = 0;
    CHECK(code(destruction.spawn(asset, at(0, 0, 0), options)) == ErrorCode::badArgument);
    CHECK(bullet.world.getNumCollisionObjects() == 0);
}

TEST_CASE("a game that steps by hand breaks the same things") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world, drivenByHand());
    (void)destruction.spawn(makeBox(), at(0, 0, 0)).value();
    bullet.addBall(0.2F, 50, btVector3(-2, 0.1F, 0.1F), btVector3(10, 0, 0));
    size_t breaks = 0;
    for (int i = 0; i < 60; ++i) {
        bullet.step();
        destruction.afterStep(kStep);
        breaks += destruction.events().size();
    }
    CHECK(breaks == 1);
    CHECK(destruction.bodyCount() == 8);
}

TEST_CASE("events are kept over the substeps of a frame and listed once") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    (void)destruction.spawn(asset, at(0, 0, 0)).value();
    bullet.addBall(0.2F, 50, btVector3(-2, 0.1F, 0.1F), btVector3(10, 0, 0));
    bullet.world.stepSimulation(1, 60, kStep);
    CHECK(destruction.events().size() == 1);
    CHECK(destruction.events().empty());

    BulletWorld crowded;
    WorldOptions few;
    few.maxPendingEvents = 1;
    DestructionWorld forgetful(crowded.world, few);
    const ObjectId one = forgetful.spawn(asset, at(0, 0, 0)).value();
    const ObjectId two = forgetful.spawn(asset, at(5, 0, 0)).value();
    REQUIRE(forgetful.breakFragment(one));
    REQUIRE(forgetful.breakFragment(two));
    CHECK(forgetful.events().size() == 1);
}

TEST_CASE("breaking what is not there, or has no children, does nothing") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
    CHECK_FALSE(destruction.breakFragment(box, 1));
    CHECK_FALSE(destruction.breakFragment(box, 1000));
    CHECK(destruction.breakFragment(box, 0));
    CHECK_FALSE(destruction.breakFragment(box, 0));
    CHECK_FALSE(destruction.breakFragment(box, 1));
}

TEST_CASE("the game may take a body of Sherd's out of the world without harm") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
    bullet.world.removeRigidBody(destruction.body(box));
    bullet.step();
    CHECK(destruction.remove(box));
}

TEST_CASE("Sherd leaves Bullet's solver settings and globals as the game set them") {
    const btScalar threshold = gContactBreakingThreshold;
    BulletWorld bullet;
    const int iterations = bullet.world.getSolverInfo().m_numIterations;
    const int mode = bullet.world.getSolverInfo().m_solverMode;
    DestructionWorld destruction(bullet.world);
    (void)destruction.spawn(makeBox(), at(0, 0, 0)).value();
    bullet.step();
    CHECK(gContactBreakingThreshold == threshold);
    CHECK(bullet.world.getSolverInfo().m_numIterations == iterations);
    CHECK(bullet.world.getSolverInfo().m_solverMode == mode);
}
