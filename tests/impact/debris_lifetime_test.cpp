// SPDX-License-Identifier: MIT
// Pieces that came off fade and go, a few at a time, and say so.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

WorldOptions withDebris(const DebrisOptions& debris) {
    WorldOptions options;
    options.debris = debris;
    options.damage.minimumImpulse = 1e9F;  // contacts break nothing
    return options;
}

DebrisOptions shortLived() {
    DebrisOptions debris;
    debris.lifetime = 1;
    debris.fade = 0.5F;
    debris.maxRemovalsPerStep = 2;
    return debris;
}

uint32_t leavesShown(const DestructionWorld& destruction, const Asset& asset) {
    uint32_t leaves = 0;
    for (const FragmentPose& pose : destruction.poses())
        leaves += asset.graph().leavesOf(pose.fragment).count;
    return leaves;
}

const BoxFracture kCube{.level1 = {3, 3, 3}};

}  // namespace

TEST_CASE("pieces fade when their time is over, and go a few at a time but for the heaviest") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world, withDebris(shortLived()));
    const auto asset = makeBox(kCube);
    const ObjectId box = destruction.spawn(asset, at(0, 0.5F, 0)).value();
    REQUIRE(destruction.breakAll(box));
    std::vector<int> removed(asset->fragmentCount(), 0);
    std::vector<float> fade(asset->fragmentCount(), 0);
    std::vector<glm::vec3> place(asset->fragmentCount());
    for (int i = 0; i < 180; ++i) {
        bullet.step();
        const auto removals = destruction.removals();
        CHECK(removals.size() <= 2);
        for (const RemovalEvent& event : removals) {
            CHECK(event.object == box);
            CHECK(event.asset == asset.get());
            CHECK(event.why == RemovalReason::age);
            CHECK(event.level == 1);
            CHECK(event.size == doctest::Approx(std::sqrt(3.0) / 3).epsilon(0.01));
            CHECK(event.mass == doctest::Approx(1000.0 / 27));
            CHECK(event.time == destruction.time());
            CHECK(fade[event.fragment] > 0.9F);
            CHECK(glm::distance(event.position, place[event.fragment]) < 0.1F);
            ++removed[event.fragment];
        }
        std::vector<int> shown(removed);
        for (const FragmentPose& pose : destruction.poses()) {
            ++shown[pose.fragment];
            CHECK(pose.fade >= fade[pose.fragment]);
            CHECK((pose.fade > 0) <= (destruction.time() > 1));
            fade[pose.fragment] = pose.fade;
            place[pose.fragment] = pose.pose.translation +
                                   pose.pose.rotation * asset->fragment(pose.fragment).centerOfMass;
        }
        // Drawn or told to be gone, each once and never both.
        for (uint32_t f = 1; f < shown.size(); ++f) REQUIRE(shown[f] == 1);
        if (i < 85) CHECK(destruction.bodyCount() == 27);
        CHECK(destruction.bodyCount() == destruction.poses().size());
        CHECK(bullet.world.getNumCollisionObjects() == 1 + int(destruction.bodyCount()));
    }
    CHECK(destruction.bodyCount() == 1);
    CHECK(destruction.isAlive(box));
}

TEST_CASE("without options nothing ever goes by itself") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    destruction.setViewer({1e6F, 0, 0});
    const ObjectId box = destruction.spawn(makeBox(kCube), at(0, 0, 0)).value();
    REQUIRE(destruction.breakAll(box));
    for (int i = 0; i < 600; ++i) bullet.step();
    CHECK(destruction.bodyCount() == 27);
    CHECK(destruction.removals().empty());
}

TEST_CASE("the game is asked first, and may keep a piece for another lifetime") {
    BulletWorld bullet;
    DebrisOptions debris = shortLived();
    int asked = 0;
    debris.mayGo = [&asked](const DebrisInfo& piece) {
        if (piece.fragment != 5) return true;
        ++asked;
        return asked > 2;
    };
    DestructionWorld destruction(bullet.world, withDebris(debris));
    const ObjectId box = destruction.spawn(makeBox(kCube), at(0, 0, 0)).value();
    REQUIRE(destruction.breakAll(box));
    for (int i = 0; i < 150; ++i) bullet.step();
    CHECK(destruction.bodyCount() == 2);
    CHECK(destruction.body(box, 5) != nullptr);
    CHECK(asked >= 2);
    for (int i = 0; i < 120; ++i) bullet.step();
    CHECK(asked == 3);
    CHECK(destruction.body(box, 5) == nullptr);
}

TEST_CASE("what is whole, stands fixed, is large or the heaviest of its object stays") {
    BulletWorld bullet;
    DebrisOptions debris = shortLived();
    debris.maxShare = 0.2F;
    DestructionWorld destruction(bullet.world, withDebris(debris));
    const auto asset = makeBox({.size = {4, 2, 0.2F}, .level1 = {8, 4, 1}});
    (void)destruction.spawn(asset, at(0, 0, 9)).value();
    const ObjectId wall = destruction.spawn(asset, at(0, 1, 0)).value();
    REQUIRE(destruction.anchorInBox(wall, {-9, -0.1F, -9}, {9, 0.1F, 9}) == 8);
    REQUIRE(destruction.breakFragment(wall));
    for (int i = 0; i < 240; ++i) bullet.step();
    // All bricks that came off went, those on anchors and the whole wall are there.
    CHECK(destruction.bodyCount() == 1 + 8);
    debris.maxShare = 0.01F;
    BulletWorld other;
    DestructionWorld keeping(other.world, withDebris(debris));
    const ObjectId box = keeping.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(keeping.breakAll(box));
    for (int i = 0; i < 240; ++i) other.step();
    CHECK(keeping.bodyCount() == 32);
}

TEST_CASE("an object may go to the last piece when the game says so") {
    BulletWorld bullet;
    DebrisOptions debris = shortLived();
    debris.largestToo = true;
    DestructionWorld destruction(bullet.world, withDebris(debris));
    const auto asset = makeBox(kCube);
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(destruction.breakAll(box));
    for (int i = 0; i < 240; ++i) bullet.step();
    CHECK(destruction.bodyCount() == 0);
    CHECK(destruction.poses().empty());
    CHECK(destruction.isAlive(box));
    // Nothing is left to damage or to break, and it can be saved like that.
    AreaDamage everything;
    everything.radius = 100;
    everything.fluence = 1e9F;
    CHECK(destruction.damage(everything).value() == 0);
    CHECK_FALSE(destruction.breakFragment(box));
    const auto saved = destruction.save(box);
    const ObjectId other = destruction.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(destruction.restore(other, saved).has_value());
    CHECK(destruction.bodyCount() == 0);
    CHECK(destruction.remove(box));
    CHECK(destruction.remove(other));
}

TEST_CASE("pieces far from the viewer go, near ones stay") {
    BulletWorld bullet;
    DebrisOptions debris;
    debris.distance = 10;
    debris.fade = 0;
    DestructionWorld destruction(bullet.world, withDebris(debris));
    const auto asset = makeBox(kCube);
    const ObjectId near = destruction.spawn(asset, at(0, 0, 0)).value();
    const ObjectId far = destruction.spawn(asset, at(20, 0, 0)).value();
    REQUIRE(destruction.breakAll(near));
    REQUIRE(destruction.breakAll(far));
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(destruction.bodyCount() == 54);
    destruction.setViewer({std::numeric_limits<float>::quiet_NaN(), 0, 0});
    destruction.setViewer({1, 0, 0});
    uint32_t removed = 0;
    for (int i = 0; i < 60; ++i) {
        bullet.step();
        for (const RemovalEvent& event : destruction.removals()) {
            CHECK(event.object == far);
            CHECK(event.why == RemovalReason::distance);
            ++removed;
        }
    }
    CHECK(removed == 26);
    CHECK(destruction.bodyCount() == 28);
}

TEST_CASE("a piece the game takes is gone for good, and what is left breaks as ever") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level1 = {3, 3, 3}, .level2 = {2, 2, 2}});
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(destruction.breakFragment(box));
    REQUIRE(destruction.removePiece(box, 14));
    CHECK_FALSE(destruction.removePiece(box, 14));
    CHECK(destruction.body(box, 14) == nullptr);
    CHECK_FALSE(destruction.breakFragment(box, 14));
    CHECK_FALSE(destruction.structure(box)->stands(14));
    const auto removals = destruction.removals();
    REQUIRE(removals.size() == 1);
    CHECK(removals[0].fragment == 14);
    CHECK(removals[0].why == RemovalReason::game);
    CHECK(destruction.removals().empty());
    CHECK(leavesShown(destruction, *asset) == 26 * 8);
    REQUIRE(destruction.breakAll(box));
    CHECK(destruction.bodyCount() == 26 * 8);
    CHECK(leavesShown(destruction, *asset) == 26 * 8);
}

TEST_CASE("what was removed stays removed in a saved game, and what fades goes on fading") {
    BulletWorld bullet;
    DestructionWorld first(bullet.world, withDebris(shortLived()));
    const auto asset = makeBox(kCube);
    const ObjectId box = first.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(first.breakAll(box));
    REQUIRE(first.removePiece(box, 7));
    for (int i = 0; i < 75; ++i) bullet.step();
    const auto saved = first.save(box);
    BulletWorld other;
    DestructionWorld second(other.world, withDebris(shortLived()));
    const ObjectId copy = second.spawn(asset, at(0, 0, 0)).value();
    for (int i = 0; i < 30; ++i) other.step();
    REQUIRE(second.restore(copy, saved).has_value());
    CHECK(second.removals().empty());
    const auto theirs = first.poses(), ours = second.poses();
    REQUIRE(ours.size() == 26);
    REQUIRE(theirs.size() == 26);
    int fading = 0;
    for (size_t i = 0; i < ours.size(); ++i) {
        CHECK(ours[i].fragment == theirs[i].fragment);
        CHECK(ours[i].fade == doctest::Approx(theirs[i].fade));
        fading += ours[i].fade > 0 ? 1 : 0;
    }
    CHECK(fading == 25);
    CHECK(second.save(copy).size() == saved.size());
    for (int i = 0; i < 60; ++i) other.step();
    CHECK(second.bodyCount() == 1);
}

TEST_CASE("when the lowest brick fades away, the column comes down") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world, withDebris({}));
    const BoxFracture recipe{.size = {0.4F, 2, 0.4F}, .level1 = {1, 10, 1}};
    const ObjectId column = destruction.spawn(makeBox(recipe), at(0, 1, 0)).value();
    REQUIRE(destruction.breakAll(column));
    for (int i = 0; i < 90; ++i) bullet.world.stepSimulation(kStep, 8, kStep / 4);
    REQUIRE(destruction.frozenCount() == 10);
    REQUIRE(destruction.removePiece(column, 1));
    CHECK(destruction.frozenCount() == 0);
    for (int i = 0; i < 30; ++i) bullet.world.stepSimulation(kStep, 8, kStep / 4);
    for (uint32_t f = 2; f <= 10; ++f) {
        CAPTURE(f);
        CHECK(destruction.body(column, f)->getCenterOfMassPosition().y() < 0.2F * float(f) - 0.2F);
    }
}
