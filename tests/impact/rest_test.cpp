// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

float fastest(const btDiscreteDynamicsWorld& world) {
    float speed = 0;
    for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
        const btRigidBody* body = btRigidBody::upcast(world.getCollisionObjectArray()[i]);
        speed = std::max(speed, float(body->getLinearVelocity().length()));
    }
    return speed;
}

/// Speed of the fastest fragment a second after everything broke in zero gravity.
float fastestAfterRelease(const BoxFracture& recipe, uint32_t* ignored = nullptr) {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox(recipe);
    const ObjectId box = destruction.spawn(asset, at(3, 2, 1)).value();
    for (uint32_t f = 0; f < asset->fragmentCount(); ++f) {
        if (asset->fragment(f).children.count > 0) REQUIRE(destruction.breakFragment(box, f));
    }
    if (ignored) *ignored = destruction.ignoredPairCount();
    for (int i = 0; i < 60; ++i) bullet.step();
    return fastest(bullet.world);
}

}  // namespace

TEST_CASE("tightly fitting fragments released at rest in zero gravity stay at rest") {
    CHECK(fastestAfterRelease({.level2 = {2, 2, 2}}) < 1e-3F);
    CHECK(fastestAfterRelease({.size = {0.05F, 0.05F, 0.05F}, .level2 = {2, 2, 2}}) < 1e-3F);
    CHECK(fastestAfterRelease({.size = {20, 20, 20}, .level2 = {2, 2, 2}}) < 1e-3F);
}

TEST_CASE("fragments whose colliders overlap do not blow the pile up") {
    uint32_t ignored = 0;
    CHECK(fastestAfterRelease({.level2 = {2, 2, 2}, .hullGrowth = 0.02F}, &ignored) < 1e-3F);
    CHECK(ignored > 0);
}

TEST_CASE("pairs overlapping at release collide again as soon as they are apart") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level1 = {2, 1, 1}, .hullGrowth = 0.02F});
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(destruction.breakFragment(box));
    CHECK(destruction.ignoredPairCount() == 1);
    btRigidBody* left = destruction.body(box, 1);
    btRigidBody* right = destruction.body(box, 2);
    left->setLinearVelocity(btVector3(-1, 0, 0));
    right->setLinearVelocity(btVector3(1, 0, 0));
    for (int i = 0; i < 10; ++i) bullet.step();
    CHECK(destruction.ignoredPairCount() == 0);
    CHECK(right->getLinearVelocity().x() == doctest::Approx(1));  // nothing pushed meanwhile
    left->setLinearVelocity(btVector3(1, 0, 0));
    right->setLinearVelocity(btVector3(-1, 0, 0));
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(right->getWorldTransform().getOrigin().x() > left->getWorldTransform().getOrigin().x());
    CHECK(std::abs(right->getLinearVelocity().x()) < 0.5F);  // they met and stopped
}

TEST_CASE("children inherit the overlaps of their parent with its neighbours") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level1 = {2, 1, 1}, .level2 = {2, 1, 1}, .hullGrowth = 0.02F});
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(destruction.breakFragment(box, 0));
    REQUIRE(destruction.breakFragment(box, 1));
    CHECK(destruction.ignoredPairCount() == 2);  // the two halves of 1, and the inner one with 2
    REQUIRE(destruction.breakFragment(box, 2));
    CHECK(destruction.ignoredPairCount() == 3);
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(fastest(bullet.world) < 1e-3F);
}

TEST_CASE("a released pile on the ground does not gain energy and keeps its shape") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level1 = {3, 3, 3}, .density = 100});
    const ObjectId box = destruction.spawn(asset, at(0, 0.5F, 0)).value();
    for (int i = 0; i < 60; ++i) bullet.step();
    REQUIRE(destruction.breakFragment(box));
    double most = 0;
    for (int i = 0; i < 120; ++i) {
        bullet.step();
        most = std::max(most, totals(bullet.world).energy);
    }
    // What falling freely for one substep gives: until the solver has found the new contacts'
    // forces.
    CHECK(most < 0.5 * 100 * (10 * kStep) * (10 * kStep));
    CHECK(totals(bullet.world).energy < 0.05);
    for (const FragmentPose& pose : destruction.poses()) {
        CHECK(glm::length(pose.pose.translation - glm::vec3(0, 0.5F, 0)) < 0.02F);
    }
}
