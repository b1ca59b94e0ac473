// SPDX-License-Identifier: MIT
// What Bullet is told of bodies by their level and size; fast ones and thin walls.
#include <doctest/doctest.h>

#include <cmath>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

WorldOptions with(const BodyRule& rule) {
    WorldOptions options;
    options.rules = {rule};
    return options;
}

/// A wall of the game's, 2 cm thick, at x = 0.
void addThinWall(BulletWorld& bullet) {
    bullet.add(std::make_unique<btBoxShape>(btVector3(0.01F, 2, 2)), 0, btVector3(0, 0, 0),
               btVector3(0, 0, 0));
}

/// A piece that flies at 60 m/s: whether it gets through the wall, from any of many distances.
bool passes(const WorldOptions& options) {
    for (int phase = 0; phase < 20; ++phase) {
        BulletWorld bullet;
        addThinWall(bullet);
        DestructionWorld destruction(bullet.world, options);
        const auto asset = makeBox({.size = {0.1F, 0.3F, 0.3F}, .level1 = {1, 2, 2}});
        SpawnOptions fast;
        fast.linearVelocity = {60, 0, 0};
        const ObjectId box =
            destruction.spawn(asset, at(-3 - 0.05F * float(phase), 0, 0), fast).value();
        REQUIRE(destruction.breakFragment(box));
        for (int i = 0; i < 30; ++i) bullet.step();
        for (uint32_t f = 1; f <= 4; ++f)
            if (destruction.body(box, f)->getCenterOfMassPosition().x() > 0) return true;
    }
    return false;
}

}  // namespace

TEST_CASE("a piece of 60 m/s stops at a wall of 2 cm where rules say it moves continuously") {
    BodyRule pieces;
    pieces.fromLevel = 1;
    pieces.continuous = true;
    CHECK_FALSE(passes(with(pieces)));
    CHECK(passes({}));      // or the test would prove nothing
    pieces.toSize = 0.05F;  // smaller ones only
    CHECK(passes(with(pieces)));
}

TEST_CASE("a ball of the game of 60 m/s that moves continuously breaks a wall of 2 cm") {
    // From every place within a substep's way before the wall; whole, and cracked into a compound.
    for (const bool cracked : {false, true}) {
        int broken = 0, struck = 0;
        for (int phase = 0; phase < 20; ++phase) {
            CAPTURE(cracked);
            CAPTURE(phase);
            BulletWorld bullet;
            DestructionWorld destruction(bullet.world);
            SpawnOptions fixed;
            fixed.dynamic = false;
            const auto asset =
                makeBox({.size = {0.02F, 2, 2}, .level1 = {1, 8, 8}, .toughness = 30});
            const ObjectId wall = destruction.spawn(asset, at(0, 0, 0), fixed).value();
            REQUIRE(destruction.anchorInBox(wall, {-1, -1.1F, -1.1F}, {1, -0.9F, 1.1F}) == 8);
            if (cracked) {
                AreaDamage corner;
                corner.a = {0, -0.75F, -0.75F};
                corner.radius = 0.3F;
                corner.falloff = 0;
                corner.fluence = INFINITY;
                REQUIRE(destruction.damage(wall, corner).value() > 0);
                (void)destruction.events();
            }
            btRigidBody& ball = bullet.addBall(
                0.1F, 2, btVector3(-2 - 0.05F * btScalar(phase), 0.6F, 0.6F), btVector3(60, 0, 0));
            ball.setCcdMotionThreshold(0.1F);
            ball.setCcdSweptSphereRadius(0.08F);
            for (int i = 0; i < 20; ++i) {
                bullet.step();
                for (const BreakEvent& event : destruction.events()) {
                    if (broken == phase) ++broken;
                    // Where it struck, and as fast as it was.
                    CHECK(event.approachSpeed == doctest::Approx(60).epsilon(0.02));
                    CHECK(event.energy == doctest::Approx(3600).epsilon(0.05));
                    const Fragment& piece = asset->fragment(event.fragment);
                    if (event.fragment == 0 ||
                        glm::distance(piece.centerOfMass, glm::vec3(0, 0.6F, 0.6F)) < 0.2F)
                        ++struck;
                    CHECK(std::abs(event.point.x) < 0.15F);
                    break;
                }
            }
            // A 2 kg ball against some 100 J of bonds: it goes through.
            CHECK(ball.getCenterOfMassPosition().x() > 1);
        }
        CHECK(broken == 20);
        CHECK(struck == 20);
    }
}

TEST_CASE("rules give filters, friction and restitution by level and size") {
    BodyRule small;
    small.fromLevel = 1;
    small.toSize = 0.4F;
    small.collisionGroup = 64;
    small.collisionMask = 1;
    small.friction = 0.9F;
    small.restitution = 0.3F;
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world, with(small));
    const auto asset = makeBox({.size = {1, 1, 1}, .level1 = {2, 2, 2}, .level2 = {2, 2, 2}});
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    const auto groupOf = [&](uint32_t fragment) {
        return destruction.body(box, fragment)->getBroadphaseProxy()->m_collisionFilterGroup;
    };
    CHECK(groupOf(0) == btBroadphaseProxy::DefaultFilter);
    REQUIRE(destruction.breakFragment(box));
    CHECK(groupOf(1) == btBroadphaseProxy::DefaultFilter);  // 0.5 m
    REQUIRE(destruction.breakFragment(box, 1));
    const uint32_t crumb = asset->fragment(1).children.first;
    CHECK(groupOf(crumb) == 64);
    CHECK(destruction.body(box, crumb)->getBroadphaseProxy()->m_collisionFilterMask == 1);
    CHECK(destruction.body(box, crumb)->getFriction() == 0.9F);
    CHECK(destruction.body(box, crumb)->getRestitution() == 0.3F);
    CHECK(destruction.body(box, 2)->getFriction() == asset->fragment(2).friction);
}
