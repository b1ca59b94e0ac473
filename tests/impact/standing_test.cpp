// SPDX-License-Identifier: MIT
// What stands, and what falls when its support is gone.
#include <doctest/doctest.h>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Bonds of weak mortar, so that a few bricks hold, and many do not.
FractureSet weak(FractureSet set, float strength) {
    for (Bond& bond : set.bonds) bond.strength = strength;
    return set;
}

/// Of eight courses of eight bricks.
std::shared_ptr<const Asset> weakWall() {
    const BoxFracture wall{.size = {4, 2, 0.2F}, .level1 = {8, 8, 1}};
    return Asset::fromFractureSet(weak(makeBoxFracture(wall), 2e5F)).value();
}

/// Fragments of an object that is 1 m of bricks high and long, and now lie below where they were.
uint32_t fallen(const DestructionWorld& destruction, float y) {
    uint32_t count = 0;
    for (const FragmentPose& pose : destruction.poses())
        if (pose.pose.translation.y < y - 0.05F) ++count;
    return count;
}

AreaDamage boxAt(const glm::vec3& middle, const glm::vec3& half) {
    AreaDamage damage;
    damage.shape = AreaDamage::Shape::box;
    damage.a = middle;
    damage.b = half;
    damage.fluence = INFINITY;
    return damage;
}

}  // namespace

TEST_CASE("an anchored wall stands for ever, however its bricks are cracked on top") {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    const auto asset = weakWall();
    const ObjectId wall = destruction.spawn(asset, at(0, 1, 0)).value();
    CHECK(destruction.anchorInBox(wall, {-9, -0.1F, -9}, {9, 0.1F, 9}) == 8);
    // One seam beside the top corner: the object opens, and is solved.
    REQUIRE(destruction.damage(wall, boxAt({1.5F, 1.875F, 0}, {0.05F, 0.05F, 1})).value() == 1);
    for (int i = 0; i < 300; ++i) bullet.step();
    CHECK(destruction.bodyCount() == 1);
    CHECK(fallen(destruction, 1) == 0);
    float most = 0;
    for (uint32_t b = 0; b < asset->graph().bonds().size(); ++b)
        most = std::max(most, destruction.overload(wall, b));
    CHECK(most > 0);
    CHECK(most < 1);
}

TEST_CASE("a wall that is undercut far enough breaks off and falls") {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    const auto asset = weakWall();
    const ObjectId wall = destruction.spawn(asset, at(0, 1, 0)).value();
    // Only the first two bricks of the lowest course are left to stand on.
    CHECK(destruction.anchorInBox(wall, {-2, -0.1F, -9}, {-1.1F, 0.1F, 9}) == 2);
    REQUIRE(destruction.damage(wall, boxAt({1.5F, 1.875F, 0}, {0.05F, 0.05F, 1})).value() == 1);
    CHECK(destruction.bodyCount() == 1);
    for (int i = 0; i < 300; ++i) bullet.step();
    CHECK(destruction.bodyCount() > 1);
    CHECK(fallen(destruction, 1) > 30);
    CHECK(destruction.body(wall, 1)->isStaticObject());
}

TEST_CASE("a bridge stands on two pillars, and falls when one is taken") {
    const auto broken = [](bool takePillar) {
        BulletWorld bullet(btVector3(0, -10, 0));
        DestructionWorld destruction(bullet.world);
        FractureSet set =
            weak(makeBoxFracture({.size = {12, 0.5F, 1}, .level1 = {24, 1, 1}}), 4e6F);
        const auto asset = Asset::fromFractureSet(std::move(set)).value();
        const ObjectId bridge = destruction.spawn(asset, at(0, 5, 0)).value();
        REQUIRE(destruction.anchor(bridge, 0));
        REQUIRE(destruction.damage(bridge, boxAt({9, 9, 9}, {1, 1, 1})).value() == 0);
        AreaDamage scratch = boxAt({-5.5F, 5, 0}, {0.1F, 0.1F, 1});
        REQUIRE(destruction.damage(bridge, scratch).value() == 1);
        for (uint32_t f = 1; f <= 24; ++f)
            if (f != 2 && f != 24) REQUIRE(destruction.anchor(bridge, f, false));
        if (takePillar) REQUIRE(destruction.anchor(bridge, 24, false));
        for (int i = 0; i < 200; ++i) bullet.step();
        return fallen(destruction, 5);
    };
    CHECK(broken(false) == 1);  // what was cut off
    CHECK(broken(true) > 10);
}

TEST_CASE("an object may be removed while its stress is worked on, and another take its place") {
    BulletWorld bullet(btVector3(0, -10, 0));
    WorldOptions slow;
    slow.stressIterations = 1;
    DestructionWorld destruction(bullet.world, slow);
    const auto big = Asset::fromFractureSet(
                         weak(makeBoxFracture({.size = {4, 2, 0.2F}, .level1 = {16, 16, 1}}), 1e3F))
                         .value();
    const auto small = Asset::fromFractureSet(weak(makeBoxFracture({.level1 = {2, 1, 1}}), 1e9F));
    for (int i = 0; i < 20; ++i) {
        const ObjectId wall = destruction.spawn(big, at(0, 1, 0)).value();
        destruction.anchorInBox(wall, {-9, -0.1F, -9}, {9, 0.1F, 9});
        REQUIRE(destruction.damage(wall, boxAt({0, 1.9F, 0}, {0.05F, 0.05F, 1})).value() > 0);
        for (int k = 0; k < i; ++k) bullet.step();
        REQUIRE(destruction.remove(wall));
        const ObjectId other = destruction.spawn(small.value(), at(0, 9, 0)).value();
        REQUIRE(destruction.anchor(other, 0));
        for (int k = 0; k < 20; ++k) bullet.step();
        CHECK(destruction.bodyCount() == 1);
        REQUIRE(destruction.remove(other));
    }
}

TEST_CASE("without a budget for stress nothing falls by its own weight") {
    BulletWorld bullet(btVector3(0, -10, 0));
    WorldOptions options;
    options.stressIterations = 0;
    DestructionWorld destruction(bullet.world, options);
    const auto asset = weakWall();
    const ObjectId wall = destruction.spawn(asset, at(0, 1, 0)).value();
    CHECK(destruction.anchorInBox(wall, {-9, -0.1F, -9}, {9, 0.1F, 9}) == 8);
    REQUIRE(destruction.damage(wall, boxAt({0.5F, 0.25F, 0}, {1.9F, 0.05F, 1})).value() == 7);
    for (int i = 0; i < 300; ++i) bullet.step();
    CHECK(destruction.bodyCount() == 1);
}

TEST_CASE("a bridge that is whole carries a load up to what its bonds hold") {
    const auto stands = [](float load) {
        BulletWorld bullet(btVector3(0, -10, 0));
        DestructionWorld destruction(bullet.world);
        FractureSet set = weak(makeBoxFracture({.size = {6, 0.5F, 1}, .level1 = {12, 1, 1}}), 4e6F);
        const auto asset = Asset::fromFractureSet(std::move(set)).value();
        const ObjectId bridge = destruction.spawn(asset, at(0, 5, 0)).value();
        REQUIRE(destruction.anchorInBox(bridge, {-3.1F, 4, -1}, {-2.8F, 6, 1}) == 1);
        REQUIRE(destruction.anchorInBox(bridge, {2.8F, 4, -1}, {3.1F, 6, 1}) == 1);
        REQUIRE(destruction.setLoad(bridge, 6, {0, -load, 0}));
        for (int i = 0; i < 200; ++i) bullet.step();
        if (fallen(destruction, 5) > 0) {
            CHECK(destruction.bodyCount() > 1);
            return false;
        }
        CHECK(destruction.poses().size() == 1);  // it was not even opened
        return true;
    };
    CHECK(stands(1e3F));
    CHECK_FALSE(stands(1e6F));
}

TEST_CASE("a load may be taken away again, and one that is none is refused") {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    const auto asset = weakWall();
    const ObjectId wall = destruction.spawn(asset, at(0, 1, 0)).value();
    REQUIRE(destruction.anchorInBox(wall, {-9, -0.1F, -9}, {9, 0.1F, 9}) == 8);
    CHECK(destruction.setLoad(wall, 64, {0, 0, 1e7F}));
    CHECK(destruction.setLoad(wall, 64, {0, 0, 0}));
    CHECK_FALSE(destruction.setLoad(wall, 65, {0, 0, 1}));
    CHECK_FALSE(destruction.setLoad(wall, 64, {0, NAN, 0}));
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(destruction.poses().size() == 1);
    CHECK(destruction.setLoad(wall, 64, {0, 0, 1e7F}));
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(destruction.bodyCount() > 1);
    REQUIRE(destruction.remove(wall));
    CHECK_FALSE(destruction.setLoad(wall, 64, {0, 0, 1}));
}
