// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

SpawnOptions ofSize(float scale) {
    SpawnOptions options;
    options.scale = scale;
    return options;
}

/// Hits a fixed box of 1 m x `scale`, scaled as a whole, with `energy`; what happened.
BreakEvent hitFixed(const std::shared_ptr<const Asset>& asset, float scale, float energy,
                    float speed) {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    SpawnOptions fixed = ofSize(scale);
    fixed.dynamic = false;
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0), fixed).value();
    ReportedHit hit;
    hit.point = glm::vec3(-0.5F, 0.1F, 0.1F) * scale * asset->scale();
    hit.normal = {1, 0, 0};
    hit.energy = energy;
    hit.speed = speed;
    hit.impulse = 1;
    REQUIRE(destruction.reportHit(*destruction.body(box), hit).has_value());
    const auto events = destruction.events();
    return events.empty() ? BreakEvent{} : events[0];
}

}  // namespace

TEST_CASE("an instance of another size has the masses, inertias and colliders of that size") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.size = {1, 2, 0.5F}});
    const ObjectId one = destruction.spawn(asset, at(0, 0, 0)).value();
    const ObjectId three = destruction.spawn(asset, at(20, 0, 0), ofSize(3)).value();
    const btRigidBody &small = *destruction.body(one), &large = *destruction.body(three);
    CHECK(large.getMass() == doctest::Approx(27 * small.getMass()));
    for (int k = 0; k < 3; ++k)
        CHECK(small.getInvInertiaDiagLocal()[k] ==
              doctest::Approx(243 * large.getInvInertiaDiagLocal()[k]));
    btVector3 low, high, smallLow, smallHigh;
    large.getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
    small.getCollisionShape()->getAabb(btTransform::getIdentity(), smallLow, smallHigh);
    for (int k = 0; k < 3; ++k)
        CHECK(high[k] - low[k] == doctest::Approx(3 * (smallHigh[k] - smallLow[k])));

    REQUIRE(destruction.breakFragment(three));
    CHECK(destruction.bodyCount() == 9);
    float mass = 0;
    for (uint32_t f = 1; f <= 8; ++f) mass += float(destruction.body(three, f)->getMass());
    CHECK(mass == doctest::Approx(27 * small.getMass()));
    // A piece is where it was: its centre three times as far from the object's frame.
    const btVector3 place = destruction.body(three, 1)->getCenterOfMassPosition();
    const glm::vec3 center = asset->fragment(1).centerOfMass;
    CHECK(place.x() == doctest::Approx(20 + 3 * center.x));
    CHECK(place.y() == doctest::Approx(3 * center.y));
}

TEST_CASE(
    "instances of one size share their shapes, also those of an asset that is scaled itself") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    const auto third = Asset::scaled(asset, 0.3F).value();
    for (const float scale : {0.7F, 1.1F, 3.0F, 9.7F}) {
        CAPTURE(scale);
        const ObjectId one = destruction.spawn(third, at(0, 0, 0), ofSize(scale)).value();
        const ObjectId two = destruction.spawn(third, at(9, 0, 0), ofSize(scale)).value();
        const ObjectId three = destruction.spawn(asset, at(9, 0, 0), ofSize(0.3F * scale)).value();
        CHECK(destruction.body(one)->getCollisionShape() ==
              destruction.body(two)->getCollisionShape());
        CHECK(destruction.body(one)->getCollisionShape() ==
              destruction.body(three)->getCollisionShape());
    }
}

TEST_CASE("poses name the asset that is drawn, and its scale") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    (void)destruction.spawn(asset, at(0, 0, 0)).value();
    const ObjectId large = destruction.spawn(asset, at(9, 0, 0), ofSize(2)).value();
    REQUIRE(destruction.breakFragment(large));
    REQUIRE(destruction.poses().size() == 9);
    for (const FragmentPose& pose : destruction.poses()) {
        CHECK(pose.asset == asset.get());
        CHECK(pose.scale == (pose.object == large ? 2.0F : 1.0F));
    }
    REQUIRE(destruction.events().size() == 1);
}

TEST_CASE("what breaks an instance grows with the square of its size") {
    const auto asset = makeBox({.level1 = {2, 1, 1}});
    // 50 J/m^2 over 1 m^2.
    for (const float scale : {0.05F, 1.0F, 4.0F, 50.0F}) {
        CAPTURE(scale);
        const float needed = 50 * scale * scale;
        CHECK(hitFixed(asset, scale, 0.95F * needed, 50).bonds == 0);
        const BreakEvent event = hitFixed(asset, scale, 1.05F * needed, 50);
        CHECK(event.bonds == 1);
        CHECK(event.area == doctest::Approx(scale * scale));
        CHECK(event.consumed == doctest::Approx(needed));
        CHECK(event.asset == asset.get());
    }
}

TEST_CASE("a scaled instance breaks as one baked in that size") {
    const auto small = makeBox({.level1 = {3, 2, 2}, .level2 = {2, 2, 1}, .toughness = 10});
    const auto large =
        makeBox({.size = glm::vec3(4), .level1 = {3, 2, 2}, .level2 = {2, 2, 1}, .toughness = 10});
    for (const float energy : {50.0F, 200.0F, 800.0F, 3000.0F}) {
        CAPTURE(energy);
        const BreakEvent scaled = hitFixed(small, 4, energy, 8);
        BulletWorld bullet;
        DestructionWorld destruction(bullet.world);
        SpawnOptions fixed;
        fixed.dynamic = false;
        const ObjectId box = destruction.spawn(large, at(0, 0, 0), fixed).value();
        ReportedHit hit;
        hit.point = glm::vec3(-2, 0.4F, 0.4F);
        hit.energy = energy;
        hit.speed = 8;
        hit.impulse = 1;
        REQUIRE(destruction.reportHit(*destruction.body(box), hit).has_value());
        const auto events = destruction.events();
        CHECK(scaled.bonds == (events.empty() ? 0 : events[0].bonds));
        CHECK(scaled.bodies == (events.empty() ? 0 : events[0].bodies));
    }
}

TEST_CASE("a scale that is none is refused, and a saved object fits one of its own size only") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    for (const float scale : {0.0F, -2.0F, std::numeric_limits<float>::quiet_NaN(), HUGE_VALF}) {
        const auto spawned = destruction.spawn(asset, at(0, 0, 0), ofSize(scale));
        REQUIRE_FALSE(spawned.has_value());
        CHECK(spawned.error().code == ErrorCode::badArgument);
    }
    CHECK(bullet.world.getNumCollisionObjects() == 0);
    const ObjectId large = destruction.spawn(asset, at(0, 0, 0), ofSize(2)).value();
    const ObjectId small = destruction.spawn(asset, at(9, 0, 0)).value();
    const ObjectId other = destruction.spawn(asset, at(18, 0, 0), ofSize(2)).value();
    REQUIRE(destruction.breakFragment(large));
    const std::vector<uint8_t> bytes = destruction.save(large);
    CHECK_FALSE(destruction.restore(small, bytes).has_value());
    CHECK(destruction.restore(other, bytes).has_value());
}

TEST_CASE("from 5 cm to 50 m, pieces released at rest stay at rest, with or without weight") {
    const auto asset = makeBox({.level2 = {2, 2, 2}});
    for (const float scale : {0.05F, 0.2F, 1.0F, 8.0F, 50.0F}) {
        CAPTURE(scale);
        BulletWorld bullet;
        DestructionWorld destruction(bullet.world);
        const ObjectId box = destruction.spawn(asset, at(1, 2, 3), ofSize(scale)).value();
        REQUIRE(destruction.breakAll(box));
        CHECK(destruction.bodyCount() == 64);
        for (int i = 0; i < 60; ++i) bullet.step();
        for (uint32_t f = 9; f < asset->fragmentCount(); ++f)
            CHECK(destruction.body(box, f)->getLinearVelocity().length() < 1e-3F);
    }
}
