// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

AreaDamage sphere(const glm::vec3& centre, float radius, float fluence) {
    AreaDamage damage;
    damage.a = centre;
    damage.radius = radius;
    damage.fluence = fluence;
    return damage;
}

const BoxFracture kWall{.size = {4, 2, 0.2F}, .level1 = {8, 4, 1}};

}  // namespace

TEST_CASE("damage in a sphere breaks the bonds inside, and none outside") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox(kWall);
    const ObjectId wall = destruction.spawn(asset, at(10, 0, 0)).value();
    AreaDamage damage = sphere({11, 0.25F, 0}, 0.3F, 1e6F);
    damage.falloff = 0;
    const uint32_t broken = destruction.damage(wall, damage).value();
    CHECK(broken > 0);
    for (uint32_t b = 0; b < asset->graph().bonds().size(); ++b) {
        const float distance =
            glm::distance(asset->graph().bond(b).centroid, glm::vec3(1, 0.25F, 0));
        CHECK(destruction.structure(wall)->isBroken(b) == (distance <= 0.3F));
    }
    const auto events = destruction.events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].bonds == broken);
    CHECK(events[0].consumed == doctest::Approx(events[0].area * 50));
}

TEST_CASE("damage that does not break is kept, falls off towards the rim, and can be healed") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.size = {8, 1, 1}, .level1 = {8, 1, 1}});  // bonds of 50 J/m^2
    const ObjectId bar = destruction.spawn(asset, at(0, 0, 0)).value();
    CHECK(destruction.damage(bar, sphere({-3, 0, 0}, 4, 40)).value() == 0);
    const Structure& structure = *destruction.structure(bar);
    CHECK(structure.health(0) == doctest::Approx(1 - 40.0 / 50));
    CHECK(structure.health(2) == doctest::Approx(1 - 20.0 / 50));
    CHECK(structure.health(5) == 1);
    CHECK(destruction.poses().size() == 1);
    REQUIRE(destruction.heal(bar, 0.3F));
    CHECK(structure.health(0) == doctest::Approx(0.5));
    CHECK(structure.health(2) == doctest::Approx(0.9));
    CHECK(destruction.damage(bar, sphere({-3, 0, 0}, 4, 40)).value() == 1);
    CHECK(structure.isBroken(0));
    CHECK(destruction.bodyCount() == 2);
    REQUIRE(destruction.heal(bar));
    CHECK(structure.isBroken(0));
    CHECK(structure.health(1) == 1);
}

TEST_CASE("a capsule cuts along its way, a box what it holds, however the object is turned") {
    const auto asset = makeBox(kWall);
    RigidPose turned = at(0, 3, 0);
    turned.rotation = glm::angleAxis(0.7F, glm::normalize(glm::vec3(1, 2, 3)));
    const auto place = [&](const glm::vec3& p) { return turned.translation + turned.rotation * p; };
    AreaDamage ray;
    ray.shape = AreaDamage::Shape::capsule;
    ray.a = place({0, -3, 0});
    ray.b = place({0, 3, 0});
    ray.radius = 0.1F;
    ray.falloff = 0;
    ray.fluence = INFINITY;
    AreaDamage box;
    box.shape = AreaDamage::Shape::box;
    box.a = turned.translation;
    box.b = {0.1F, 3, 1};
    box.rotation = turned.rotation;
    box.fluence = INFINITY;
    for (const AreaDamage& damage : {ray, box}) {
        BulletWorld bullet;
        DestructionWorld destruction(bullet.world);
        const ObjectId wall = destruction.spawn(asset, turned).value();
        CHECK(destruction.damage(damage).value() == 4);  // the vertical seam in the middle
        CHECK(destruction.bodyCount() == 2);
        CHECK(destruction.body(wall, 1) != destruction.body(wall, 8));
    }
}

TEST_CASE("shear breaks bonds that lie along it and spares those it presses on") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox(kWall);
    const ObjectId wall = destruction.spawn(asset, at(0, 0, 0)).value();
    AreaDamage damage = sphere({0, 0, 0}, 10, INFINITY);
    damage.falloff = 0;
    damage.fluence = 51;
    damage.shear = {1, 0, 0};
    CHECK(destruction.damage(wall, damage).value() == 8 * 3);  // the level seams
    CHECK(destruction.bodyCount() == 4);
}

TEST_CASE("damage follows the parts of an object to where they are now") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.size = {8, 1, 1}, .level1 = {8, 1, 1}});
    const ObjectId bar = destruction.spawn(asset, at(0, 0, 0)).value();
    AreaDamage middle = sphere({0, 0, 0}, 0.1F, INFINITY);
    CHECK(destruction.damage(bar, middle).value() == 1);
    destruction.body(bar, 8)->translate(btVector3(0, 5, 0));
    bullet.step();
    CHECK(destruction.damage(bar, sphere({2, 0, 0}, 0.1F, INFINITY)).value() == 0);
    CHECK(destruction.damage(bar, sphere({2, 5, 0}, 0.1F, INFINITY)).value() == 1);
}

TEST_CASE("an explosion breaks and throws outwards") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level1 = {3, 3, 3}});
    (void)destruction.spawn(asset, at(0, 0, 0)).value();
    AreaDamage blast = sphere({0.01F, 0, 0}, 3, 1e5F);
    CHECK(destruction.explode(blast, 100).value() == 54);
    CHECK(destruction.bodyCount() == 27);
    int outwards = 0;
    for (int i = 0; i < bullet.world.getNumCollisionObjects(); ++i) {
        const btRigidBody* body = btRigidBody::upcast(bullet.world.getCollisionObjectArray()[i]);
        const btVector3 from = body->getCenterOfMassPosition() - btVector3(0.01F, 0, 0);
        if (body->getLinearVelocity().dot(from) > 0) ++outwards;
    }
    CHECK(outwards == 27);
}

TEST_CASE("a reported hit does what a contact of that energy and speed does") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({});
    const ObjectId box = destruction.spawn(asset, at(1, 2, 3)).value();
    ReportedHit hit;
    hit.point = {0.5F, 2.1F, 3.1F};
    hit.normal = {1, 0, 0};
    hit.energy = 151;
    hit.speed = 10;
    hit.impulse = 30;
    CHECK(destruction.reportHit(*destruction.body(box), hit).value() == doctest::Approx(150));
    CHECK(destruction.bodyCount() == 8);
    const auto events = destruction.events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].point == hit.point);
    CHECK(events[0].energy == 151);
    hit.speed = 1e-3F;  // sets up no stress
    CHECK(destruction.reportHit(*destruction.body(box, 1), hit).value() == 0);
}

TEST_CASE("detach takes one fragment out whole, break all leaves nothing together") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level2 = {2, 2, 2}});
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    CHECK_FALSE(destruction.detach(box, 3));
    AreaDamage corner = sphere({0, 0.25F, 0.25F}, 0.2F, INFINITY);
    REQUIRE(destruction.damage(box, corner).value() > 0);
    REQUIRE(destruction.detach(box, 3));
    CHECK(destruction.bodyCount() == 2);
    CHECK(destruction.body(box, 3) != destruction.body(box, 1));
    CHECK_FALSE(destruction.detach(box, 9));
    REQUIRE(destruction.breakAll(box));
    CHECK(destruction.bodyCount() == 64);
    CHECK(destruction.poses().size() == 64);
}

TEST_CASE("anchors set by the game hold, and let go") {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox(kWall);
    const ObjectId wall = destruction.spawn(asset, at(0, 5, 0)).value();
    CHECK(destruction.anchorInBox(wall, {-9, 3.9F, -9}, {9, 4.1F, 9}) == 8);
    for (int i = 0; i < 30; ++i) bullet.step();
    CHECK(destruction.poses()[0].pose.translation == glm::vec3(0, 5, 0));
    REQUIRE(destruction.damage(wall, sphere({1.75F, 5.75F, 0}, 0.4F, 1e6F)).value() > 0);
    for (int i = 0; i < 30; ++i) bullet.step();
    CHECK(destruction.body(wall, 1)->isStaticObject());
    CHECK_FALSE(destruction.body(wall, 32)->isStaticObject());
    for (uint32_t f = 1; f <= 8; ++f) REQUIRE(destruction.anchor(wall, f, false));
    CHECK_FALSE(destruction.body(wall, 1)->isStaticObject());
    for (int i = 0; i < 30; ++i) bullet.step();
    CHECK(destruction.body(wall, 1)->getLinearVelocity().y() < -1);
}

TEST_CASE("an object put on static ground can be anchored where it touches") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world);
    SpawnOptions options;
    options.anchorToStatic = true;
    const ObjectId wall = destruction.spawn(makeBox(kWall), at(0, 1, 0), options).value();
    CHECK(destruction.body(wall)->isStaticObject());
    for (uint32_t leaf = 0; leaf < 32; ++leaf)
        CHECK(destruction.structure(wall)->isPinned(leaf) == (leaf < 8));
    const ObjectId flying = destruction.spawn(makeBox(kWall), at(0, 9, 0), options).value();
    CHECK_FALSE(destruction.body(flying)->isStaticObject());
}

TEST_CASE("damage that makes no sense is refused, and changes nothing") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto refused = [&](const AreaDamage& damage) {
        const auto result = destruction.damage(box, damage);
        return !result && result.error().code == ErrorCode::badArgument;
    };
    CHECK(refused(sphere({nan, 0, 0}, 1, 1)));
    CHECK(refused(sphere({0, 0, 0}, 0, 1)));
    CHECK(refused(sphere({0, 0, 0}, INFINITY, 1)));
    CHECK(refused(sphere({0, 0, 0}, 1, nan)));
    CHECK(refused(sphere({0, 0, 0}, 1, -1)));
    AreaDamage steep = sphere({0, 0, 0}, 1, 1);
    steep.falloff = 2;
    CHECK(refused(steep));
    CHECK_FALSE(destruction.damage(ObjectId{}, sphere({0, 0, 0}, 1, 1)).has_value());
    CHECK_FALSE(destruction.explode(sphere({0, 0, 0}, 1, 1), nan).has_value());
    btRigidBody& ball = bullet.addBall(0.1F, 1, btVector3(9, 9, 9), btVector3(0, 0, 0));
    CHECK_FALSE(destruction.reportHit(ball, {}).has_value());
    CHECK_FALSE(destruction.structure(box)->isDamaged());
    CHECK(destruction.events().empty());
}
