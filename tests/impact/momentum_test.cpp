// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

struct Measured {
    Totals before;  ///< the substep
    Totals solved;  ///< right before Sherd's change
    Totals after;   ///< right after it
    double consumed = 0;
};

/// One random hit, measured around the change it caused.
bool randomHit(uint32_t seed, Measured& measured) {
    std::mt19937 random(seed);
    const auto uniform = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world, drivenByHand());
    // Braces evaluate in order, on every compiler.
    const auto triple = [&](float x, float y, float z) {
        return glm::vec3{uniform(-x, x), uniform(-y, y), uniform(-z, z)};
    };
    const glm::vec3 stretch = triple(0.5F, 0.5F, 0.5F);
    const auto asset = makeBox({.size = glm::vec3(1.0F) + stretch,
                                .level2 = {2, 1, 2},
                                .toughness = 10,
                                .center = {0.3F, -0.2F, 0.1F}});
    SpawnOptions options;
    options.linearVelocity = triple(2, 2, 2);
    options.angularVelocity = triple(3, 3, 3);
    (void)destruction.spawn(asset, at(0, 0, 0), options).value();
    const glm::vec3 place = triple(0, 0.3F, 0.3F);
    const glm::vec3 aim = triple(8.5F, 2, 2);
    const glm::vec3 spin = triple(5, 5, 5);
    const float mass = uniform(20, 500);
    btRigidBody& ball = bullet.addBall(0.2F, mass, btVector3(-1.5F, place.y, place.z),
                                       btVector3(16.5F + aim.x, aim.y, aim.z));
    ball.setAngularVelocity(btVector3(spin.x, spin.y, spin.z));
    for (int i = 0; i < 60; ++i) {
        measured.before = totals(bullet.world);
        bullet.step();
        measured.solved = totals(bullet.world);
        destruction.afterStep(kStep);
        const auto events = destruction.events();
        if (events.empty()) continue;
        measured.after = totals(bullet.world);
        for (const BreakEvent& event : events) measured.consumed += event.consumed;
        return true;
    }
    return false;
}

}  // namespace

TEST_CASE("a hit keeps momentum and takes what breaking consumed out of the energy") {
    int hits = 0;
    double worstLinear = 0;
    double worstAngular = 0;
    double worstGain = 0;
    for (uint32_t seed = 1; seed <= 1000; ++seed) {
        Measured m;
        if (!randomHit(seed, m)) continue;
        ++hits;
        const double linear =
            (m.after.momentum - m.solved.momentum).length() / m.before.momentumScale;
        const double angular =
            (m.after.angularMomentum - m.solved.angularMomentum).length() / m.before.angularScale;
        const double gain = (m.after.energy - (m.before.energy - m.consumed)) / m.before.energy;
        worstLinear = std::max(worstLinear, linear);
        worstAngular = std::max(worstAngular, angular);
        worstGain = std::max(worstGain, gain);
    }
    MESSAGE(hits << " hits, worst |dp| " << worstLinear << ", |dL| " << worstAngular
                 << ", energy gain " << worstGain);
    CHECK(hits > 800);
    CHECK(worstLinear < 1e-5);
    CHECK(worstAngular < 1e-5);
    CHECK(worstGain < 1e-3);
}

TEST_CASE("the parts of a spinning body fly off with the velocity they had") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level2 = {2, 2, 2}});
    SpawnOptions options;
    options.linearVelocity = {1, 2, 3};
    options.angularVelocity = {0, 0, 4};
    const ObjectId box = destruction.spawn(asset, at(5, 0, 0), options).value();
    const Totals before = totals(bullet.world);
    REQUIRE(destruction.breakFragment(box, 0));
    REQUIRE(destruction.breakFragment(box, 3));
    const Totals after = totals(bullet.world);
    CHECK((after.momentum - before.momentum).length() < 1e-5 * before.momentumScale);
    CHECK((after.angularMomentum - before.angularMomentum).length() < 1e-5 * before.angularScale);
    CHECK(after.energy == doctest::Approx(before.energy).epsilon(1e-5));

    const btRigidBody* piece = destruction.body(box, 1);
    REQUIRE(piece != nullptr);
    const glm::vec3 arm = asset->fragment(1).centerOfMass;
    CHECK(piece->getLinearVelocity().x() == doctest::Approx(1 - 4 * arm.y));
    CHECK(piece->getLinearVelocity().y() == doctest::Approx(2 + 4 * arm.x));
    CHECK(piece->getLinearVelocity().z() == doctest::Approx(3));
    CHECK(piece->getAngularVelocity().z() == doctest::Approx(4));
}

TEST_CASE("an object struck against the ground does not jump at its hitter") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world);
    (void)destruction.spawn(makeBox({.size = {1, 0.5F, 1}, .toughness = 20}), at(0, 0.25F, 0));
    bullet.addBall(0.2F, 100, btVector3(0.1F, 2, 0.1F), btVector3(0, -10, 0));
    for (int i = 0; i < 60; ++i) {
        const double before = totals(bullet.world, btVector3(0, -10 * kStep, 0)).energy;
        bullet.step();
        const auto events = destruction.events();
        if (events.empty()) continue;
        CHECK(totals(bullet.world).energy <= (before - events[0].consumed) * 1.0001);
        return;
    }
    FAIL("nothing broke");
}

TEST_CASE("bodies made in the first substep feel gravity in the others too") {
    const auto fall = [](int calls, int substeps) {
        BulletWorld bullet(btVector3(0, -10, 0));
        DestructionWorld destruction(bullet.world);
        const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
        btRigidBody& ball =
            bullet.addBall(0.2F, 50, btVector3(-0.75F, 0.1F, 0.1F), btVector3(20, 0, 0));
        ball.setGravity(btVector3(0, 0, 0));
        for (int i = 0; i < calls; ++i) {
            bullet.world.stepSimulation(kStep * float(substeps), substeps, kStep);
        }
        const btRigidBody* corner = destruction.body(box, 8);
        REQUIRE(corner != nullptr);
        return corner->getLinearVelocity();
    };
    CHECK((fall(1, 4) - fall(4, 1)).length() < 1e-5F);
}
