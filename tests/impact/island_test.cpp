// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <set>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// A bar of cubes along x, from 0 on; `anchored` at its first.
std::shared_ptr<const Asset> makeBar(int cubes, bool anchored, float toughness = 50) {
    const auto n = float(cubes);
    FractureSet set = makeBoxFracture({.size = {n, 1, 1},
                                       .level1 = {cubes, 1, 1},
                                       .toughness = toughness,
                                       .center = {n / 2, 0, 0}});
    if (anchored) {
        Bond anchor;
        anchor.a = 1;
        anchor.area = 1;
        anchor.strength = 1e12F;
        anchor.normal = {-1, 0, 0};
        set.bonds.push_back(anchor);
    }
    return Asset::fromFractureSet(std::move(set)).value();
}

/// Strikes the bar from below at `x`.
btRigidBody& strike(BulletWorld& bullet, float x, float mass, float speed) {
    return bullet.addBall(0.2F, mass, btVector3(x, -1.0F, 0), btVector3(0, speed, 0));
}

}  // namespace

TEST_CASE("what still holds together stays one body, the largest part the old one") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBar(6, false);
    const ObjectId bar = destruction.spawn(asset, at(0, 0, 0)).value();
    const btRigidBody* before = destruction.body(bar);
    strike(bullet, 0.5F, 50, 3);
    std::vector<BreakEvent> events;
    REQUIRE(stepUntilBreak(bullet, destruction, 60, &events));
    REQUIRE(events[0].bodies >= 1);
    CHECK(destruction.bodyCount() == events[0].bodies + 1);
    CHECK(destruction.bodyCount() < 6);
    CHECK(destruction.poses().size() == 6);
    const btRigidBody* last = destruction.body(bar, 6);
    CHECK(last == before);
    CHECK(destruction.body(bar, 5) == last);
    CHECK(destruction.body(bar, 1) != last);
    CHECK(last->getCollisionShape()->isCompound());
    // The part is as heavy as its cubes, and its centre is where theirs is.
    std::set<const btRigidBody*> bodies;
    double mass = 0;
    for (uint32_t f = 1; f <= 6; ++f) bodies.insert(destruction.body(bar, f));
    for (const btRigidBody* body : bodies) mass += double(body->getMass());
    CHECK(mass == doctest::Approx(6000));
}

TEST_CASE(
    "two hits in one substep each break what is near them, though the first opens the object") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    // Two rows of eight; the first and the last bond of the lower one are weak, but not so weak
    // that a hit at the other end would break them.
    const BoxFracture rows{.size = {8, 2, 1}, .level1 = {8, 2, 1}, .toughness = 1};
    FractureSet set = makeBoxFracture(rows);
    const float weak = 0.45F * contactStress(*makeBox(rows), 0, 3);
    const auto bondOf = [&set](int32_t a, int32_t b) {
        for (size_t i = 0; i < set.bonds.size(); ++i)
            if (set.bonds[i].a == a && set.bonds[i].b == b) return uint32_t(i);
        FAIL("there is no such bond");
        return uint32_t(0);
    };
    const uint32_t left = bondOf(1, 2), right = bondOf(7, 8);
    for (size_t b = 0; b < set.bonds.size(); ++b)
        set.bonds[b].strength = b == left || b == right ? weak : 1e12F;
    const auto asset = Asset::fromFractureSet(std::move(set)).value();
    const ObjectId wall = destruction.spawn(asset, at(0, 0, 0)).value();
    for (const float x : {-3.5F, 3.5F})
        bullet.addBall(0.2F, 50, btVector3(x, -2, 0), btVector3(0, 3, 0));
    std::vector<BreakEvent> events;
    REQUIRE(stepUntilBreak(bullet, destruction, 60, &events));
    CHECK(events.size() == 2);
    CHECK(destruction.bodyCount() == 1);
    CHECK(destruction.structure(wall)->isBroken(left));
    CHECK(destruction.structure(wall)->isBroken(right));
}

TEST_CASE("a crack that separates nothing changes neither pose nor velocity, to the bit") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    // A ring of four: one broken bond leaves it whole.
    FractureSet set = makeBoxFracture({.size = {2, 2, 1}, .level1 = {2, 2, 1}, .toughness = 1});
    for (size_t b = 1; b < set.bonds.size(); ++b) set.bonds[b].strength = 1e12F;
    const auto asset = Asset::fromFractureSet(std::move(set)).value();
    SpawnOptions options;
    options.linearVelocity = {1, 0, 0};
    options.angularVelocity = {0, 0.1F, 0.3F};
    const ObjectId ring = destruction.spawn(asset, at(0, 0, 0), options).value();

    BulletWorld plain;
    DestructionWorld idle(plain.world, unbreakable());
    const ObjectId twin = idle.spawn(asset, at(0, 0, 0), options).value();
    for (BulletWorld* world : {&bullet, &plain})
        world->addBall(0.2F, 20, btVector3(0.2F, -2, 0.1F), btVector3(0.9F, 5, 0));
    std::vector<BreakEvent> events;
    bool cracked = false;
    for (int i = 0; i < 60 && !cracked; ++i) {
        bullet.step();
        plain.step();
        for (const BreakEvent& event : destruction.events()) {
            cracked = true;
            CHECK(event.bodies == 0);
            CHECK(event.bonds == 1);
        }
    }
    REQUIRE(cracked);
    const btRigidBody& body = *destruction.body(ring, 1);
    const btRigidBody& other = *idle.body(twin);
    CHECK(body.getLinearVelocity() == other.getLinearVelocity());
    CHECK(body.getAngularVelocity() == other.getAngularVelocity());
    CHECK(destruction.poses()[0].pose.translation == idle.poses()[0].pose.translation);
    CHECK(destruction.poses()[0].pose.rotation == idle.poses()[0].pose.rotation);
    CHECK(destruction.poses().size() == 4);
    CHECK(destruction.bodyCount() == 1);
}

TEST_CASE("an anchored object stands, and what comes off it falls while the rest stands on") {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBar(6, true, 20);
    const ObjectId bar = destruction.spawn(asset, at(0, 0, 0)).value();
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(destruction.poses()[0].pose.translation == glm::vec3(0));
    strike(bullet, 5.5F, 10, 8);
    REQUIRE(stepUntilBreak(bullet, destruction, 60));
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(destruction.body(bar, 1)->isStaticObject());
    CHECK_FALSE(destruction.body(bar, 6)->isStaticObject());
    for (const FragmentPose& pose : destruction.poses()) {
        if (pose.fragment == 1) CHECK(pose.pose.translation == glm::vec3(0));
        if (pose.fragment == 6) CHECK(pose.pose.translation.y < -1);
    }
}

TEST_CASE("a body that loses its last anchor falls, and stays the same body") {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    FractureSet set = makeBoxFracture({.size = {4, 1, 1}, .level1 = {4, 1, 1}});
    Bond anchor;
    anchor.a = 1;
    anchor.area = 0.1F;
    anchor.centroid = {-2, 0, 0};
    anchor.toughness = 10;
    set.bonds.push_back(anchor);
    const auto asset = Asset::fromFractureSet(std::move(set)).value();
    const ObjectId bar = destruction.spawn(asset, at(0, 0, 0)).value();
    const btRigidBody* body = destruction.body(bar);
    CHECK(body->isStaticObject());
    strike(bullet, -1.9F, 1, 10);
    REQUIRE(stepUntilBreak(bullet, destruction, 60));
    CHECK(destruction.bodyCount() == 1);
    CHECK(destruction.body(bar) == body);
    CHECK_FALSE(body->isStaticObject());
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(destruction.poses()[0].pose.translation.y < -3);
}

TEST_CASE("an island of many fragments names the one a child of its shape belongs to") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBar(6, false);
    const ObjectId bar = destruction.spawn(asset, at(0, 0, 0)).value();
    strike(bullet, 0.5F, 50, 3);
    REQUIRE(stepUntilBreak(bullet, destruction, 60));
    const btRigidBody* body = destruction.body(bar, 6);
    btCollisionWorld::ClosestRayResultCallback ray(btVector3(0, 0, 0), btVector3(0, 0, 0));
    struct ChildRay : btCollisionWorld::ClosestRayResultCallback {
        using ClosestRayResultCallback::ClosestRayResultCallback;
        int child = -1;
        btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool isWorld) override {
            child = result.m_localShapeInfo ? result.m_localShapeInfo->m_triangleIndex : -1;
            return ClosestRayResultCallback::addSingleResult(result, isWorld);
        }
    };
    for (const uint32_t f : {5U, 6U}) {
        const float x = float(f) - 0.5F;
        ChildRay down(btVector3(x, 5, 0), btVector3(x, -5, 0));
        bullet.world.rayTest(down.m_rayFromWorld, down.m_rayToWorld, down);
        REQUIRE(down.hasHit());
        CHECK(down.m_collisionObject == body);
        CHECK(destruction.find(*body, down.child)->fragment == f);
    }
}

TEST_CASE("what has just broken off takes no damage for as long as it is immune") {
    const auto breaks = [](float immunity) {
        BulletWorld bullet;
        WorldOptions options;
        options.damage.immunity = immunity;
        DestructionWorld destruction(bullet.world, options);
        const auto asset = makeBox({.level2 = {2, 2, 2}, .toughness = 5});
        const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
        REQUIRE(destruction.breakFragment(box));
        (void)destruction.events();
        bullet.addBall(0.1F, 5, btVector3(-1, -1, -1), btVector3(15, 15, 15));
        return stepUntilBreak(bullet, destruction, 30);
    };
    CHECK(breaks(0));
    CHECK_FALSE(breaks(10));
}

TEST_CASE("masses of islands and their parts compose to those of the whole") {
    FractureSet set = makeBoxFracture({.level1 = {3, 2, 2}, .level2 = {2, 1, 2}});
    // A file whose pieces are a little light and off, as hollow ones are.
    for (size_t f = 1; f < set.fragments.size(); ++f) {
        set.fragments[f].mass *= 0.97F;
        set.fragments[f].centerOfMass += glm::vec3(0.002F * float(f % 5), 0, -0.001F);
    }
    const auto asset = Asset::fromFractureSet(std::move(set)).value();
    CHECK(asset->fragment(0).mass == doctest::Approx(1000).epsilon(1e-6));
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    SpawnOptions options;
    options.linearVelocity = {1, 2, 3};
    options.angularVelocity = {3, -2, 1};
    const ObjectId box = destruction.spawn(asset, at(1, 2, 3), options).value();
    const Totals before = totals(bullet.world);
    for (uint32_t f = 0; f < 6; ++f) REQUIRE(destruction.breakFragment(box, f));
    const Totals after = totals(bullet.world);
    CHECK((after.momentum - before.momentum).length() < 1e-5 * before.momentumScale);
    CHECK((after.angularMomentum - before.angularMomentum).length() < 1e-5 * before.angularScale);
    CHECK(after.energy == doctest::Approx(before.energy).epsilon(1e-5));
}
