// SPDX-License-Identifier: MIT
// Quiet pieces are frozen one by one, and give way and fall as if they were not.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

WorldOptions freezing(float after = 0.5F) {
    WorldOptions options;
    options.damage.minimumImpulse = 1e9F;  // contacts break nothing
    options.freezeAfter = after;
    options.maxNewBodiesPerStep = UINT32_MAX;
    options.maxAwakeBodies = UINT32_MAX;
    return options;
}

/// In steps small enough for Bullet to hold a stack.
void frame(BulletWorld& bullet) {
    bullet.world.stepSimulation(kStep, 8, kStep / 4);
}

/// An object on the ground, all in pieces.
struct Heap {
    explicit Heap(const BoxFracture& recipe, float freezeAfter = 0.5F)
        : destruction(bullet.world, freezing(freezeAfter)), asset(makeBox(recipe)) {
        bullet.addGround(0);
        object = destruction.spawn(asset, at(0, recipe.size.y / 2, 0)).value();
        REQUIRE(destruction.breakAll(object));
    }
    void steps(int count) {
        for (int i = 0; i < count; ++i) frame(bullet);
    }
    btRigidBody& piece(uint32_t f) { return *destruction.body(object, f); }

    BulletWorld bullet{btVector3(0, -10, 0)};
    DestructionWorld destruction;
    std::shared_ptr<const Asset> asset;
    ObjectId object;
};

/// Three layers, 216 pieces of 2 kg.
const BoxFracture kHeap{.size = {1.2F, 0.3F, 1.2F}, .level1 = {12, 3, 6}};
/// Bricks from fragment 1, the lowest, to 10.
const BoxFracture kThinColumn{.size = {0.4F, 2, 0.4F}, .level1 = {1, 10, 1}};

/// A ball that never stops turning beside a heap.
uint32_t frozenBesideTurningBall(float freezeAfter) {
    Heap heap(kHeap, freezeAfter);
    btRigidBody& ball = heap.bullet.addBall(0.1F, 1, btVector3(0.71F, 0.1F, 0), btVector3(0, 0, 0));
    ball.setActivationState(DISABLE_DEACTIVATION);
    for (int i = 0; i < 300; ++i) {
        ball.setAngularVelocity(btVector3(0, 5, 0));
        heap.steps(1);
    }
    uint32_t asleep = 0;
    for (uint32_t f = 1; f <= 216; ++f) asleep += heap.piece(f).isActive() ? 0 : 1;
    CHECK(heap.destruction.frozenCount() <= asleep);
    return asleep;
}

}  // namespace

TEST_CASE("most of a heap is frozen while a ball beside it never stops turning") {
    CHECK(frozenBesideTurningBall(INFINITY) == 0);
    CHECK(frozenBesideTurningBall(0.5F) > 180);
}

TEST_CASE("a frozen piece is the same body in the same place of Bullet's world, with its mass") {
    Heap heap(kThinColumn);
    const btRigidBody* body = &heap.piece(5);
    const float mass = 1 / body->getInvMass();
    const void* proxy = body->getBroadphaseProxy();
    const int index = body->getWorldArrayIndex();
    heap.steps(90);
    REQUIRE(heap.destruction.frozenCount() == 10);
    CHECK(heap.destruction.isFrozen(heap.object, 5));
    CHECK(&heap.piece(5) == body);
    CHECK(body->getBroadphaseProxy() == proxy);
    CHECK(body->getWorldArrayIndex() == index);
    CHECK(1 / body->getInvMass() == mass);
    CHECK_FALSE(body->isActive());
    CHECK(body->getLinearVelocity().length() == 0);
}

TEST_CASE("a ball meets a frozen piece as one with mass, not as a wall") {
    float speeds[2]{};
    for (const bool freezes : {false, true}) {
        // Four cubes of 1 kg in a row.
        Heap heap({.size = {0.4F, 0.1F, 0.1F}, .level1 = {4, 1, 1}}, freezes ? 0.5F : INFINITY);
        heap.steps(60);
        CHECK(heap.destruction.frozenCount() == (freezes ? 4 : 0));
        btRigidBody& ball =
            heap.bullet.addBall(0.05F, 50, btVector3(-0.6F, 0.05F, 0), btVector3(5, 0, 0));
        heap.steps(10);
        // 50 / (50 + 4) of its speed, less some friction; a wall would have stopped it.
        speeds[freezes ? 1 : 0] = ball.getLinearVelocity().x();
        for (uint32_t f = 1; f <= 4; ++f) CHECK(heap.piece(f).getLinearVelocity().x() > 3);
    }
    CHECK(speeds[0] > 4);
    CHECK(speeds[1] == doctest::Approx(speeds[0]).epsilon(0.01));
}

TEST_CASE("a ball goes as far into a frozen heap as into one that is awake") {
    float speeds[2]{}, given[2]{};
    for (const bool freezes : {false, true}) {
        Heap heap(kHeap, freezes ? 0.5F : INFINITY);
        heap.steps(90);
        CHECK(heap.destruction.frozenCount() == (freezes ? 216 : 0));
        btRigidBody& ball =
            heap.bullet.addBall(0.1F, 30, btVector3(-0.75F, 0.15F, 0.02F), btVector3(6, 0, 0));
        heap.steps(3);
        speeds[freezes ? 1 : 0] = ball.getLinearVelocity().x();
        for (uint32_t f = 1; f <= 216; ++f)
            given[freezes ? 1 : 0] +=
                heap.piece(f).getLinearVelocity().x() / heap.piece(f).getInvMass();
    }
    CHECK(speeds[0] > 0.5F);
    CHECK(speeds[0] < 5);
    CHECK(6 - speeds[1] == doctest::Approx(6 - speeds[0]).epsilon(0.1));
    CHECK(given[1] == doctest::Approx(given[0]).epsilon(0.1));
}

TEST_CASE("when the lowest brick of a column is taken, nothing floats half a second later") {
    for (const int way : {0, 1, 2, 3}) {
        CAPTURE(way);
        Heap heap(kThinColumn);
        heap.steps(90);
        REQUIRE(heap.destruction.frozenCount() == 10);
        std::vector<float> before;
        for (uint32_t f = 2; f <= 10; ++f)
            before.push_back(heap.piece(f).getCenterOfMassPosition().y());
        btRigidBody& lowest = heap.piece(1);
        const btVector3 away(40, 0, 0);
        if (way == 0) heap.bullet.world.removeRigidBody(&lowest);
        if (way == 1) lowest.translate(btVector3(3, 0, 0));
        if (way == 2) lowest.applyCentralImpulse(away / lowest.getInvMass());
        if (way == 3) {
            lowest.activate(true);
            lowest.setLinearVelocity(away);
        }
        heap.steps(30);
        for (uint32_t f = 2; f <= 10; ++f) {
            CAPTURE(f);
            CHECK(heap.piece(f).getCenterOfMassPosition().y() < before[f - 2] - 0.1F);
        }
        heap.steps(600);
        uint32_t high = 0;
        for (uint32_t f = 2; f <= 10; ++f)
            high += heap.piece(f).getCenterOfMassPosition().y() > 0.2F * float(f) - 0.15F ? 1 : 0;
        CHECK(high == 0);
    }
}

TEST_CASE("a column on something of the game's falls when that goes, sinks or slides away") {
    for (const int way : {0, 1, 2, 3}) {  // 3: it was adopted, and is deleted
        BulletWorld bullet(btVector3(0, -10, 0));
        bullet.addGround(0);
        btRigidBody& table = bullet.add(std::make_unique<btBoxShape>(btVector3(0.5F, 0.5F, 0.5F)),
                                        0, btVector3(0, 0.5F, 0), btVector3(0, 0, 0));
        // Others, so that places in Bullet's world change.
        btRigidBody& other = bullet.addBall(0.1F, 1, btVector3(9, 0.1F, 0), btVector3(0, 0, 0));
        const bool isMoved = way == 1 || way == 2;
        if (isMoved) {
            table.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
            table.setActivationState(DISABLE_DEACTIVATION);
        }
        DestructionWorld destruction(bullet.world, freezing());
        if (way == 3) REQUIRE(destruction.adopt(table, makeBox()));
        const ObjectId column = destruction.spawn(makeBox(kThinColumn), at(0, 2, 0)).value();
        REQUIRE(destruction.breakAll(column));
        for (int i = 0; i < 90; ++i) frame(bullet);
        REQUIRE(destruction.frozenCount() == 10);
        bullet.world.removeRigidBody(&other);
        frame(bullet);
        CHECK(destruction.frozenCount() == 10);
        if (way == 0) bullet.world.removeRigidBody(&table);
        if (way == 3) bullet.take(table);
        for (int i = 0; i < 60; ++i) {
            // 12 cm/s down, or 9 m/s aside
            const btVector3 move = way == 1 ? btVector3(0, -0.002F, 0) : btVector3(0.15F, 0, 0);
            if (isMoved)
                table.setWorldTransform(btTransform(table.getWorldTransform().getBasis(),
                                                    table.getWorldTransform().getOrigin() + move));
            frame(bullet);
            if (i != 30 && i != 59) continue;
            const float least = way == 1 ? 0.002F * float(i) - 0.03F : 0.1F;
            for (uint32_t f = 1; f <= 10; ++f) {
                CAPTURE(way);
                CAPTURE(f);
                CHECK(destruction.body(column, f)->getCenterOfMassPosition().y() <
                      1 + 0.2F * float(f) - 0.1F - least);
            }
        }
    }
}

TEST_CASE("what lies on frozen pieces does not sink in, and lets them sleep") {
    Heap heap(kHeap);
    heap.steps(90);
    REQUIRE(heap.destruction.frozenCount() == 216);
    btRigidBody& load = heap.bullet.add(std::make_unique<btBoxShape>(btVector3(0.2F, 0.1F, 0.2F)),
                                        500, btVector3(0, 0.41F, 0), btVector3(0, 0, 0));
    load.setActivationState(DISABLE_DEACTIVATION);
    heap.steps(240);
    CHECK(heap.destruction.frozenCount() == 216);
    CHECK(load.getCenterOfMassPosition().y() == doctest::Approx(0.4F).epsilon(0.02));
    CHECK(load.getLinearVelocity().length() < 0.01F);
}

TEST_CASE("nothing is frozen in mid-air, nor on what is awake") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    btRigidBody& raft = bullet.add(std::make_unique<btBoxShape>(btVector3(1, 0.1F, 1)), 1000,
                                   btVector3(0, 0.1F, 0), btVector3(0, 0, 0));
    raft.setActivationState(DISABLE_DEACTIVATION);
    DestructionWorld destruction(bullet.world, freezing());
    const ObjectId heap = destruction.spawn(makeBox({}), at(0, 0.7F, 0)).value();
    REQUIRE(destruction.breakAll(heap));
    for (int i = 0; i < 60; ++i) frame(bullet);
    CHECK(destruction.frozenCount() == 0);
    raft.forceActivationState(ISLAND_SLEEPING);
    BulletWorld space;
    DestructionWorld floating(space.world, freezing());
    const ObjectId box = floating.spawn(makeBox({}), at(0, 0, 0)).value();
    REQUIRE(floating.breakAll(box));
    for (int i = 0; i < 60; ++i) frame(space);
    CHECK(floating.frozenCount() == 0);
}

TEST_CASE("a whole object asleep on another one falls when that is removed") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world, freezing());
    const auto asset = makeBox({});
    const ObjectId lower = destruction.spawn(asset, at(0, 0.5F, 0)).value();
    const ObjectId upper = destruction.spawn(asset, at(0, 1.5F, 0)).value();
    for (int i = 0; i < 240; ++i) frame(bullet);
    REQUIRE_FALSE(destruction.body(upper)->isActive());
    REQUIRE(destruction.remove(lower));
    for (int i = 0; i < 30; ++i) frame(bullet);
    CHECK(destruction.body(upper)->getCenterOfMassPosition().y() < 1);
}

TEST_CASE("an explosion throws frozen pieces") {
    Heap heap(kHeap);
    heap.steps(90);
    REQUIRE(heap.destruction.frozenCount() == 216);
    AreaDamage blast;
    blast.a = {0, 0.15F, 0};
    blast.radius = 2;
    REQUIRE(heap.destruction.explode(blast, 1000).has_value());
    CHECK(heap.destruction.frozenCount() == 0);
    heap.steps(30);
    CHECK(heap.piece(1).getCenterOfMassPosition().length() > 0.6F);
}

TEST_CASE("frozen pieces break like others, and what lay on them wakes") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world, freezing());
    const BoxFracture recipe{.size = {0.4F, 2, 0.4F}, .level1 = {1, 10, 1}, .level2 = {2, 2, 2}};
    const ObjectId column = destruction.spawn(makeBox(recipe), at(0, 1, 0)).value();
    REQUIRE(destruction.breakFragment(column));
    for (int i = 0; i < 90; ++i) frame(bullet);
    REQUIRE(destruction.frozenCount() == 10);
    REQUIRE(destruction.breakFragment(column, 5));
    CHECK(destruction.bodyCount() == 17);
    CHECK(destruction.isFrozen(column, 1));
    CHECK_FALSE(destruction.isFrozen(column, 6));
    CHECK_FALSE(destruction.isFrozen(column, 10));
    for (int i = 0; i < 10; ++i) frame(bullet);
    REQUIRE(destruction.remove(column));
    CHECK(destruction.frozenCount() == 0);
    CHECK(bullet.world.getNumCollisionObjects() == 1);
}

TEST_CASE("what is broken at rest and released asleep stands as it stood, until it is touched") {
    // At 60 Hz Bullet cannot hold such a column by itself.
    const BoxFracture column{.size = {0.4F, 2, 0.4F}, .level1 = {1, 10, 1}};
    const BoxFracture wall{.size = {4, 2, 0.4F}, .level1 = {8, 8, 1}};
    for (const BoxFracture& recipe : {column, wall}) {
        BulletWorld bullet(btVector3(0, -10, 0));
        bullet.addGround(0);
        DestructionWorld destruction(bullet.world, freezing());
        SpawnOptions asleep;
        asleep.releaseAsleep = true;
        const auto asset = makeBox(recipe);
        const ObjectId object = destruction.spawn(asset, at(0, 1, 0), asleep).value();
        for (int i = 0; i < 30; ++i) bullet.step();
        const glm::vec3 stood = destruction.poses()[0].pose.translation;
        REQUIRE(destruction.breakAll(object));
        CHECK(destruction.frozenCount() == asset->graph().leafCount());
        for (int i = 0; i < 300; ++i) bullet.step();
        for (const FragmentPose& pose : destruction.poses())
            CHECK(glm::distance(pose.pose.translation, stood) < 0.01F);
        const btVector3 lowest = destruction.body(object, 1)->getCenterOfMassPosition();
        bullet.addBall(0.15F, 200, lowest + btVector3(0, 0, -2), btVector3(0, 0, 12));
        for (int i = 0; i < 90; ++i) bullet.step();
        CHECK(destruction.body(object, 1)->getCenterOfMassPosition().z() > 0.3F);
        uint32_t moved = 0;
        for (const FragmentPose& pose : destruction.poses())
            moved += glm::distance(pose.pose.translation, stood) > 0.05F ? 1 : 0;
        CHECK(moved >= 5);
    }
}

TEST_CASE("what nothing bears is not released asleep") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world, freezing());
    SpawnOptions asleep;
    asleep.releaseAsleep = true;
    // A beam that sticks out of a pillar; only the pillar stands on the ground.
    const auto asset = makeBox({.size = {4, 1, 1}, .level1 = {4, 1, 1}});
    bullet.add(std::make_unique<btBoxShape>(btVector3(0.5F, 1, 0.5F)), 0, btVector3(-1.5F, 1, 0),
               btVector3(0, 0, 0));
    asleep.dynamic = false;
    const ObjectId beam = destruction.spawn(asset, at(0, 2.5F, 0), asleep).value();
    REQUIRE(destruction.breakAll(beam));
    CHECK(destruction.isFrozen(beam, 1));
    CHECK(destruction.frozenCount() == 1);
    for (int i = 0; i < 60; ++i) bullet.step();
    for (uint32_t f = 2; f <= 4; ++f)
        CHECK(destruction.body(beam, f)->getCenterOfMassPosition().y() < 2);
}

TEST_CASE("two identical runs with freezing and waking give identical bits") {
    const auto record = [] {
        std::vector<float> log;
        Heap heap(kHeap);
        for (int i = 0; i < 400; ++i) {
            if (i == 120)
                heap.bullet.addBall(0.1F, 30, btVector3(-2, 0.15F, 0.02F), btVector3(8, 0, 0));
            if (i == 200) heap.bullet.world.removeRigidBody(&heap.piece(40));
            heap.steps(1);
            log.push_back(float(heap.destruction.frozenCount()));
            for (const FragmentPose& pose : heap.destruction.poses()) {
                const glm::vec3& p = pose.pose.translation;
                log.insert(log.end(), {p.x, p.y, p.z, pose.pose.rotation.w});
            }
        }
        return log;
    };
    const auto first = record(), second = record();
    REQUIRE(first.size() == second.size());
    CHECK(std::memcmp(first.data(), second.data(), first.size() * sizeof(float)) == 0);
    CHECK(first[first.size() - 1 - 216 * 4] > 100);
}
