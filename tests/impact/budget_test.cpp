// SPDX-License-Identifier: MIT
// Over budget there are fewer and larger islands now, and never the hit later.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "impact/bullet_world.h"
#include "sherd/runtime/island_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

WorldOptions limits(uint32_t newBodies, uint32_t awake = UINT32_MAX) {
    WorldOptions options;
    options.maxNewBodiesPerStep = newBodies;
    options.maxAwakeBodies = awake;
    return options;
}

AreaDamage everything(float fluence = 1e9F) {
    AreaDamage damage;
    damage.radius = 1e3F;
    damage.falloff = 0;
    damage.fluence = fluence;
    return damage;
}

/// Masses of all bodies that move, ascending.
std::vector<float> masses(const BulletWorld& bullet) {
    std::vector<float> result;
    for (int i = 0; i < bullet.world.getNumCollisionObjects(); ++i) {
        const btRigidBody* body = btRigidBody::upcast(bullet.world.getCollisionObjectArray()[i]);
        if (body->getInvMass() > 0) result.push_back(1 / body->getInvMass());
    }
    std::sort(result.begin(), result.end());
    return result;
}

std::shared_ptr<const Asset> withoutBonds(const BoxFracture& recipe) {
    FractureSet set = makeBoxFracture(recipe);
    set.bonds.clear();
    return Asset::fromFractureSet(std::move(set)).value();
}

const BoxFracture kCubes{.level1 = {8, 8, 8}};

}  // namespace

TEST_CASE("a hit that would make 512 bodies makes as many as it may, of like size") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world, limits(20));
    const auto asset = makeBox(kCubes);
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    const uint32_t broken = destruction.damage(everything()).value();
    CHECK(destruction.bodyCount() == 21);
    CHECK(destruction.poses().size() == 512);
    const std::vector<float> mass = masses(bullet);
    float sum = 0;
    for (const float m : mass) sum += m;
    CHECK(sum == doctest::Approx(1000));
    CHECK(mass.front() > 1000.0F / 21 / 6);
    CHECK(mass.back() < 1000.0F / 21 * 6);
    const auto events = destruction.events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].bodies == 20);
    CHECK(events[0].bonds == broken);
    uint32_t gone = 0;
    for (uint32_t b = 0; b < asset->graph().bonds().size(); ++b)
        gone += destruction.structure(box)->isBroken(b) ? 1 : 0;
    CHECK(gone == broken);
}

TEST_CASE("what the budget held together never comes apart by itself, and does at the next touch") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world, limits(20));
    (void)destruction.spawn(makeBox(kCubes), at(0, 0, 0)).value();
    REQUIRE(destruction.damage(everything()).value() > 0);
    for (int i = 0; i < 120; ++i) bullet.step();
    CHECK(destruction.bodyCount() == 21);
    // A thousandth of what the bonds cost when they were sound, 50 J/m^2.
    REQUIRE(destruction.damage(everything(0.05F)).value() > 0);
    CHECK(destruction.bodyCount() == 41);
    // In the same step nothing more may come off.
    CHECK(destruction.damage(everything(0.05F)).value() == 0);
    CHECK(destruction.bodyCount() == 41);
    bullet.step();
    REQUIRE(destruction.damage(everything(0.05F)).value() > 0);
    CHECK(destruction.bodyCount() == 61);
}

TEST_CASE("contacts keep to the budget of the step, whatever the number of objects struck") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world, limits(9));
    const auto asset = makeBox({.level1 = {4, 4, 4}, .toughness = 1});
    for (int i = 0; i < 4; ++i) {
        const float z = 3 * float(i);
        (void)destruction.spawn(asset, at(0, 0, z)).value();
        bullet.addBall(0.3F, 100, btVector3(-2, 0.1F, z), btVector3(20, 0, 0));
    }
    uint32_t before = destruction.bodyCount();
    for (int i = 0; i < 60; ++i) {
        bullet.step();
        CHECK(destruction.bodyCount() <= before + 9);
        before = destruction.bodyCount();
        CHECK(destruction.poses().size() >= before);
    }
    CHECK(before > 4 + 9);
}

TEST_CASE("children without bonds stay in what they were when there are too many") {
    for (const uint32_t budget : {100U, 5U}) {
        BulletWorld bullet;
        DestructionWorld destruction(bullet.world, limits(budget));
        const ObjectId box = destruction.spawn(withoutBonds({}), at(0, 0, 0)).value();
        ReportedHit hit;
        hit.energy = 10;
        hit.speed = 10;
        hit.impulse = 10;
        CHECK(destruction.reportHit(*destruction.body(box), hit).has_value());
        CHECK(destruction.bodyCount() == (budget == 100 ? 8 : 1));
        CHECK(destruction.poses().size() == destruction.bodyCount());
        CHECK(destruction.events().size() == (budget == 100 ? 1 : 0));
    }
}

TEST_CASE("awake pieces use up a budget, but every hit takes off something") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world, limits(UINT32_MAX, 30));
    for (int i = 0; i < 3; ++i)
        (void)destruction.spawn(makeBox(kCubes), at(0, 0, 3 * float(i))).value();
    REQUIRE(destruction.damage(everything()).value() > 0);
    // All of the budget for the first, and one for each of the others.
    CHECK(destruction.bodyCount() == 3 + 30 + 1 + 1);
    bullet.step();
    // 30 and the largest rest of each are awake now.
    const uint32_t before = destruction.bodyCount();
    AreaDamage corner = everything();
    corner.radius = 0.4F;
    corner.a = {0.4F, 0.4F, 6.4F};
    CHECK(destruction.damage(corner).value() > 0);
    CHECK(destruction.bodyCount() > before);
}

TEST_CASE("what the game breaks piece by piece comes off whatever the budget") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world, limits(1, 1));
    const auto asset = makeBox(kCubes);
    const ObjectId first = destruction.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(destruction.breakAll(first));
    CHECK(destruction.bodyCount() == 512);
    const ObjectId second = destruction.spawn(asset, at(5, 0, 0)).value();
    REQUIRE(destruction.breakFragment(second));
    CHECK(destruction.bodyCount() == 1024);
}

TEST_CASE("clumps come off an anchored wall rather than hang on it by next to nothing") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world, limits(4));
    const auto asset = makeBox({.size = {4, 2, 0.2F}, .level1 = {16, 8, 1}});
    const ObjectId wall = destruction.spawn(asset, at(0, 1, 0)).value();
    REQUIRE(destruction.anchorInBox(wall, {-9, -0.1F, -9}, {9, 0.1F, 9}) == 16);
    AreaDamage blast = everything();
    blast.a = {0, 2, 0};
    blast.radius = 0.7F;
    REQUIRE(destruction.damage(wall, blast).value() > 0);
    CHECK(destruction.bodyCount() == 5);
    // What is left standing hangs by sound bonds only.
    const Structure& structure = *destruction.structure(wall);
    const btRigidBody* standing = destruction.body(wall, 1);
    REQUIRE(standing->isStaticObject());
    uint32_t hanging = 0;
    for (uint32_t b = 0; b < asset->graph().bonds().size(); ++b) {
        const BondGraph::Bond& bond = asset->graph().bond(b);
        if (structure.isBroken(b) || structure.health(b) > 0.5F) continue;
        if (destruction.body(wall, asset->graph().fragmentOfLeaf(bond.a)) == standing) ++hanging;
    }
    CHECK(hanging == 0);
}

TEST_CASE("whatever is hit, however little may come off, all of it is somewhere once") {
    std::mt19937 random(5);
    const auto bonded = makeBox({.level1 = {3, 3, 3}, .level2 = {2, 2, 2}, .toughness = 2});
    const auto loose = withoutBonds({.level1 = {3, 3, 3}, .level2 = {2, 2, 2}});
    for (int run = 0; run < 40; ++run) {
        BulletWorld bullet;
        const uint32_t budget = random() % 12;
        DestructionWorld destruction(bullet.world, limits(budget));
        const auto& asset = run % 2 == 0 ? bonded : loose;
        const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
        uint32_t before = 1;
        for (int hits = 0; hits < 10; ++hits) {
            AreaDamage damage = everything(float(random() % 5));
            damage.radius = 0.2F + 0.1F * float(random() % 8);
            damage.a = {0.25F * float(random() % 4), 0.2F, 0};
            (void)destruction.damage(damage).value();
            if (destruction.body(box, 0)) {
                ReportedHit hit;
                hit.energy = float(random() % 40);
                hit.speed = 10;
                hit.impulse = 10;
                (void)destruction.reportHit(*destruction.body(box, 0), hit);
            }
            CHECK(destruction.bodyCount() <= before + budget);
            uint32_t leaves = 0;
            for (const FragmentPose& pose : destruction.poses()) {
                CHECK(destruction.structure(box)->stands(pose.fragment));
                leaves += asset->graph().leavesOf(pose.fragment).count;
            }
            REQUIRE(leaves == asset->graph().leafCount());
            bullet.step();
            before = destruction.bodyCount();
        }
        const auto saved = destruction.save(box);
        CHECK(destruction.restore(box, saved).has_value());
        CHECK(destruction.bodyCount() == before);
    }
}
