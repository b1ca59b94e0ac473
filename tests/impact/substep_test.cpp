// SPDX-License-Identifier: MIT
// Bullet gives gravity once for all substeps of a step: what is made in between must not miss it.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

// A power of two: Bullet adds up times.
constexpr float kSubstep = 1.0F / 256;

using Scene = std::function<void(BulletWorld&, DestructionWorld&)>;

struct Outcome {
    std::vector<btVector3> places, velocities, spins;  ///< step by step, body by body
    size_t bodies = 0;
};

Outcome run(const Scene& scene, bool substeps) {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    scene(bullet, destruction);
    Outcome outcome;
    for (int i = 0; i < 40; ++i) {
        if (substeps) {
            bullet.world.stepSimulation(4 * kSubstep, 4, kSubstep);
        } else {
            for (int k = 0; k < 4; ++k) bullet.world.stepSimulation(kSubstep, 1, kSubstep);
        }
        for (int b = 0; b < bullet.world.getNumCollisionObjects(); ++b) {
            const auto* body = btRigidBody::upcast(bullet.world.getCollisionObjectArray()[b]);
            outcome.places.push_back(body->getCenterOfMassPosition());
            outcome.velocities.push_back(body->getLinearVelocity());
            outcome.spins.push_back(body->getAngularVelocity());
        }
    }
    outcome.bodies = destruction.bodyCount();
    return outcome;
}

btScalar farthest(const std::vector<btVector3>& x, const std::vector<btVector3>& y) {
    REQUIRE(x.size() == y.size());
    btScalar most = 0;
    for (size_t i = 0; i < x.size(); ++i) most = std::max(most, (x[i] - y[i]).length());
    return most;
}

void compare(const Scene& scene, size_t leastBodies) {
    const Outcome one = run(scene, true), four = run(scene, false);
    CHECK(one.bodies >= leastBodies);
    CHECK(one.bodies == four.bodies);
    CHECK(farthest(one.places, four.places) <= 1e-5F);
    CHECK(farthest(one.velocities, four.velocities) <= 1e-5F);
    CHECK(farthest(one.spins, four.spins) <= 1e-5F);
}

}  // namespace

TEST_CASE("one step of four substeps breaks what is struck in the air as four steps of one do") {
    // The hit falls into another substep of a step each time.
    for (int phase = 0; phase < 4; ++phase) {
        CAPTURE(phase);
        compare(
            [phase](BulletWorld& bullet, DestructionWorld& destruction) {
                (void)destruction.spawn(makeBox({.level2 = {2, 2, 1}}), at(0, 0, 0)).value();
                bullet.addBall(0.2F, 60, btVector3(-1 - 0.04F * btScalar(phase), 0.1F, 0.15F),
                               btVector3(10, 0, 0));
            },
            8);
    }
}

TEST_CASE("one step of four substeps wakes and breaks what slept as four steps of one do") {
    for (int phase = 0; phase < 4; ++phase) {
        CAPTURE(phase);
        compare(
            [phase](BulletWorld& bullet, DestructionWorld& destruction) {
                bullet.addGround(-0.5F);
                const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
                destruction.body(box)->forceActivationState(ISLAND_SLEEPING);
                bullet.addBall(0.2F, 60, btVector3(-1 - 0.04F * btScalar(phase), 0.1F, 0.15F),
                               btVector3(10, 2, 0));
            },
            8);
    }
}

TEST_CASE("what loses its hold in a substep falls as four steps of one have it") {
    for (int phase = 0; phase < 4; ++phase) {
        CAPTURE(phase);
        compare(
            [phase](BulletWorld& bullet, DestructionWorld& destruction) {
                SpawnOptions fixed;
                fixed.dynamic = false;
                (void)destruction.spawn(makeBox(), at(0, 0, 0), fixed).value();
                bullet.addBall(0.2F, 60, btVector3(-1 - 0.04F * btScalar(phase), 0.1F, 0.15F),
                               btVector3(10, 0, 0));
            },
            8);
    }
}
