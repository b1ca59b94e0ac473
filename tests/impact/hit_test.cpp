// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("a hard hit swaps the intact body for its level 1 fragments") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    bullet.addBall(0.2F, 50, btVector3(-2, 0.1F, 0.1F), btVector3(10, 0, 0));
    CHECK(destruction.bodyCount() == 1);

    std::vector<BreakEvent> events;
    REQUIRE(stepUntilBreak(bullet, destruction, 60, &events));
    REQUIRE(events.size() == 1);
    CHECK(events[0].object == box);
    CHECK(events[0].fragment == 0);
    CHECK(events[0].bodies == 7);
    CHECK(events[0].bonds == 12);
    CHECK(events[0].area == doctest::Approx(3));
    CHECK(events[0].level == 1);
    CHECK(events[0].approachSpeed == doctest::Approx(10).epsilon(0.01));
    CHECK(events[0].normal.x == doctest::Approx(1).epsilon(0.01));
    CHECK(events[0].point.x == doctest::Approx(-0.5).epsilon(0.02));
    CHECK(events[0].impulse > 0);
    CHECK(events[0].consumed == doctest::Approx(150));
    CHECK(events[0].energy > events[0].consumed);
    CHECK(events[0].time > 0);
    CHECK(events[0].time == doctest::Approx(destruction.time()));
    CHECK(destruction.bodyCount() == 8);
    CHECK(destruction.body(box, 0) == nullptr);
    CHECK(destruction.body(box, 8) != nullptr);
    CHECK(destruction.events().empty());
}

TEST_CASE("below the threshold nothing breaks, and the hitter bounces as Bullet has it") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
    btRigidBody& ball = bullet.addBall(0.2F, 5, btVector3(-1, 0, 0), btVector3(5, 0, 0));
    CHECK_FALSE(stepUntilBreak(bullet, destruction, 60));
    CHECK(destruction.body(box) != nullptr);

    BulletWorld plain;
    const auto asset = makeBox();
    btRigidBody& plainBall = plain.addBall(0.2F, 5, btVector3(-1, 0, 0), btVector3(5, 0, 0));
    DestructionWorld idle(plain.world, unbreakable());
    (void)idle.spawn(asset, at(0, 0, 0));
    for (int i = 0; i < 60; ++i) plain.step();
    CHECK(ball.getLinearVelocity().x() == plainBall.getLinearVelocity().x());
}

TEST_CASE("the threshold is an energy: it follows speed, mass and the tuning factor") {
    const auto breaksAt = [](float speed, float mass, float toughnessScale) {
        BulletWorld bullet;
        DestructionWorld destruction(bullet.world);
        SpawnOptions options;
        options.dynamic = false;
        options.damage.toughnessScale = toughnessScale;
        (void)destruction.spawn(makeBox({.level1 = {2, 1, 1}}), at(0, 0, 0), options).value();
        bullet.addBall(0.2F, mass, btVector3(-1, 0.1F, 0.2F), btVector3(speed, 0, 0));
        return stepUntilBreak(bullet, destruction, 120);
    };
    // 50 J: 4 kg at 5 m/s.
    CHECK(breaksAt(5.1F, 4, 1));
    CHECK_FALSE(breaksAt(4.9F, 4, 1));
    CHECK(breaksAt(2.55F, 16, 1));
    CHECK_FALSE(breaksAt(2.45F, 16, 1));
    CHECK_FALSE(breaksAt(5.1F, 4, 2));
    CHECK(breaksAt(7.15F, 4, 2));
}

TEST_CASE("the energy measured is the same whether one point touches or a face") {
    const auto energyOf = [](std::unique_ptr<btCollisionShape> shape) {
        BulletWorld bullet;
        DestructionWorld destruction(bullet.world);
        SpawnOptions options;
        options.dynamic = false;
        (void)destruction.spawn(makeBox(), at(0, 0, 0), options).value();
        bullet.add(std::move(shape), 10, btVector3(-1.5F, 0, 0), btVector3(8, 0, 0));
        std::vector<BreakEvent> events;
        REQUIRE(stepUntilBreak(bullet, destruction, 60, &events));
        return events[0].energy;
    };
    const float ball = energyOf(std::make_unique<btSphereShape>(0.2F));
    const float face = energyOf(std::make_unique<btBoxShape>(btVector3(0.2F, 0.2F, 0.2F)));
    CHECK(ball == doctest::Approx(320).epsilon(0.02));
    CHECK(face == doctest::Approx(320).epsilon(0.05));
}

TEST_CASE("the energy measured depends neither on the step rate nor on when in a step it hits") {
    for (const float rate : {30.0F, 60.0F, 120.0F, 240.0F}) {
        for (int phase = 0; phase < 10; ++phase) {
            CAPTURE(rate);
            CAPTURE(phase);
            BulletWorld bullet;
            DestructionWorld destruction(bullet.world);
            SpawnOptions options;
            options.dynamic = false;
            (void)destruction.spawn(makeBox(), at(0, 0, 0), options).value();
            const float start = -1 - 0.1F * float(phase) * 6 / rate;
            bullet.addBall(0.2F, 10, btVector3(start, 0.1F, 0.1F), btVector3(6, 0, 0));
            std::vector<BreakEvent> events;
            for (int i = 0; i < 240 && events.empty(); ++i) {
                bullet.step(1 / rate);
                const auto broken = destruction.events();
                events.assign(broken.begin(), broken.end());
            }
            REQUIRE(events.size() == 1);
            CHECK(events[0].energy == doctest::Approx(180).epsilon(0.02));
        }
    }
}

TEST_CASE("the hitter goes through instead of bouncing off an intact wall") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    SpawnOptions fixed;
    fixed.dynamic = false;
    const auto wall =
        makeBox({.size = {0.05F, 2, 2}, .level1 = {1, 8, 8}, .density = 500, .toughness = 2});
    (void)destruction.spawn(wall, at(0, 0, 0), fixed).value();
    btRigidBody& ball = bullet.addBall(0.1F, 20, btVector3(-1, 0.05F, 0.05F), btVector3(15, 0, 0));
    // Finely: at 60 Hz the ball would move by more than its size and never touch the wall.
    for (int i = 0; i < 120; ++i) bullet.step(1.0F / 480);
    CHECK(destruction.bodyCount() == 64);
    CHECK(ball.getWorldTransform().getOrigin().x() > 0.5F);
    CHECK(ball.getLinearVelocity().x() > 8);
    CHECK(ball.getLinearVelocity().x() < 15);
}

TEST_CASE("an object that falls on the ground breaks by its own weight and speed") {
    const auto breaksFrom = [](float height) {
        BulletWorld bullet(btVector3(0, -10, 0));
        bullet.addGround(0);
        DestructionWorld destruction(bullet.world);
        (void)destruction.spawn(makeBox({.size = {0.2F, 0.2F, 0.2F}}), at(0, height + 0.1F, 0));
        return stepUntilBreak(bullet, destruction, 120);
    };
    // 8 kg and 6 J of bonds: 7.5 cm.
    CHECK_FALSE(breaksFrom(0.05F));
    CHECK(breaksFrom(0.15F));
    CHECK(breaksFrom(2));
}

TEST_CASE("a supported weight breaks nothing, however long and heavy it rests") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world);
    (void)destruction.spawn(makeBox({.toughness = 0.5F}), at(0, 0.5F, 0)).value();
    bullet.add(std::make_unique<btBoxShape>(btVector3(0.4F, 0.4F, 0.4F)), 3000,
               btVector3(0, 1.4F, 0), btVector3(0, 0, 0));
    CHECK_FALSE(stepUntilBreak(bullet, destruction, 300));
}

TEST_CASE("energy left over descends to level 2 around the hit") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level2 = {2, 2, 2}, .toughness = 10});
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    bullet.addBall(0.2F, 100, btVector3(-2, 0.25F, 0.25F), btVector3(20, 0, 0));
    std::vector<BreakEvent> events;
    REQUIRE(stepUntilBreak(bullet, destruction, 60, &events));
    REQUIRE(events.size() == 1);
    CHECK(events[0].fragment == 0);
    CHECK(events[0].level == 2);
    CHECK(events[0].consumed <= events[0].energy);
    CHECK(destruction.bodyCount() == 15);
    uint32_t broken = 0;
    for (uint32_t f = 1; f <= 8; ++f) {
        if (destruction.body(box, f)) continue;
        broken = f;
    }
    REQUIRE(broken != 0);
    const Fragment& struck = asset->fragment(broken);
    CHECK(struck.centerOfMass.x == doctest::Approx(-0.25));  // the corner that was hit
    CHECK(struck.centerOfMass.y == doctest::Approx(0.25));
    CHECK(struck.centerOfMass.z == doctest::Approx(0.25));
    CHECK(destruction.body(box, struck.children.first) != nullptr);
}

TEST_CASE("a fragment lying about breaks when it is hit hard later, and only that one") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level2 = {2, 2, 2}, .toughness = 10});
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(destruction.breakFragment(box));
    (void)destruction.events();
    for (int i = 0; i < 30; ++i) bullet.step();
    CHECK(destruction.events().empty());
    // From outside along the diagonal of one corner.
    bullet.addBall(0.1F, 1, btVector3(-1, -1, -1), btVector3(15, 15, 15));
    std::vector<BreakEvent> events;
    REQUIRE(stepUntilBreak(bullet, destruction, 60, &events));
    CHECK(events.size() == 1);
    CHECK(asset->fragment(events[0].fragment).level == 1);
    CHECK(asset->fragment(events[0].fragment).centerOfMass.x < 0);
}

TEST_CASE("two objects that hit each other break both") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    SpawnOptions right;
    right.linearVelocity = {10, 0, 0};
    SpawnOptions left;
    left.linearVelocity = {-10, 0, 0};
    (void)destruction.spawn(asset, at(-1, 0, 0), right).value();
    (void)destruction.spawn(asset, at(1, 0.1F, 0), left).value();
    std::vector<BreakEvent> events;
    REQUIRE(stepUntilBreak(bullet, destruction, 60, &events));
    REQUIRE(events.size() == 2);
    CHECK(events[0].object != events[1].object);
    CHECK(destruction.bodyCount() == 16);
}

TEST_CASE("a kinematic hitter breaks what it meets") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    (void)destruction.spawn(makeBox(), at(0, 0, 0)).value();
    btRigidBody& hammer = bullet.add(std::make_unique<btBoxShape>(btVector3(0.2F, 0.2F, 0.2F)), 0,
                                     btVector3(-1.5F, 0, 0), btVector3(0, 0, 0));
    hammer.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    hammer.setActivationState(DISABLE_DEACTIVATION);
    bool broken = false;
    for (int i = 0; i < 60 && !broken; ++i) {
        btTransform place = hammer.getWorldTransform();
        place.getOrigin() += btVector3(10 * kStep, 0, 0);
        hammer.setWorldTransform(place);
        bullet.world.stepSimulation(kStep, 1, kStep);
        broken = !destruction.events().empty();
    }
    CHECK(broken);
}
