// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <map>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Every leaf of every object is shown exactly once: by itself or by one ancestor.
bool showsEverythingOnce(std::span<const FragmentPose> poses, size_t objects) {
    struct Shown {
        const Asset* asset = nullptr;
        std::vector<int> times;  ///< per fragment
    };
    std::map<uint32_t, Shown> shown;
    for (const FragmentPose& pose : poses) {
        const Asset& asset = *pose.asset;
        Shown& object = shown[pose.object.index];
        object.asset = &asset;
        object.times.resize(asset.fragmentCount());
        for (uint32_t leaf = 0; leaf < asset.fragmentCount(); ++leaf) {
            if (asset.fragment(leaf).children.count > 0) continue;
            for (auto f = int32_t(leaf); f >= 0; f = asset.fragment(uint32_t(f)).parent) {
                if (uint32_t(f) == pose.fragment) ++object.times[leaf];
            }
        }
    }
    for (const auto& [index, object] : shown) {
        for (uint32_t f = 0; f < object.times.size(); ++f) {
            const bool leaf = object.asset->fragment(f).children.count == 0;
            if (leaf && object.times[f] != 1) return false;
        }
    }
    return shown.size() == objects;
}

}  // namespace

TEST_CASE("in every frame each part is drawn exactly once, through hits at all levels") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level2 = {2, 2, 2}, .toughness = 5});
    (void)destruction.spawn(asset, at(0, 0.5F, 0)).value();
    (void)destruction.spawn(asset, at(1.2F, 1.5F, 0)).value();
    (void)destruction.spawn(asset, at(0, 5, 0)).value();
    bullet.addBall(0.2F, 100, btVector3(-3, 0.6F, 0.1F), btVector3(20, 0, 0));
    int breaks = 0;
    CHECK(showsEverythingOnce(destruction.poses(), 3));
    for (int i = 0; i < 120; ++i) {
        bullet.step();
        breaks += int(destruction.events().size());
        REQUIRE(showsEverythingOnce(destruction.poses(), 3));
        REQUIRE(destruction.poses().size() >= destruction.bodyCount());
    }
    CHECK(breaks >= 3);
}

TEST_CASE("a fragment appears exactly where its part of the object was, to the bit") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    SpawnOptions options;
    options.linearVelocity = {1, 0, 0};
    options.angularVelocity = {1, 2, 3};
    const ObjectId box = destruction.spawn(makeBox(), at(1, 2, 3), options).value();
    for (int i = 0; i < 10; ++i) bullet.step();
    const FragmentPose before = destruction.poses()[0];
    CHECK(before.previous.translation != before.pose.translation);
    REQUIRE(destruction.breakFragment(box));
    REQUIRE(destruction.poses().size() == 8);
    for (const FragmentPose& pose : destruction.poses()) {
        CHECK(pose.pose.translation == before.pose.translation);
        CHECK(pose.pose.rotation == before.pose.rotation);
        CHECK(pose.previous.translation == before.previous.translation);
    }
}

TEST_CASE("an object whose centre of mass is off its origin is drawn where it was spawned") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    RigidPose pose = at(4, 5, 6);
    pose.rotation = glm::quat(0.5F, 0.5F, 0.5F, 0.5F);
    const ObjectId box = destruction.spawn(makeBox({.center = {0, 2, 0}}), pose).value();
    bullet.step();
    const FragmentPose drawn = destruction.poses()[0];
    CHECK(glm::length(drawn.pose.translation - pose.translation) < 1e-5F);
    CHECK(std::abs(glm::dot(drawn.pose.rotation, pose.rotation)) == doctest::Approx(1));
    // The body itself is where the mass is: (0, 2, 0) turned.
    const btVector3 body = destruction.body(box)->getCenterOfMassPosition();
    CHECK((body - btVector3(4, 5, 8)).length() < 1e-5F);
}

TEST_CASE("what stands fixed is drawn where it was spawned, to the bit") {
    BulletWorld bullet;  // which rounds the attitude of what could move anew in every step
    DestructionWorld destruction(bullet.world);
    RigidPose pose = at(4.1F, -5.3F, 6.7F);
    pose.rotation = glm::normalize(glm::quat(0.9F, 0.1F, 0.3F, 0.2F));
    SpawnOptions options;
    options.dynamic = false;
    (void)destruction.spawn(makeBox({.center = {0, 2, 0}}), pose, options).value();
    for (int i = 0; i < 4; ++i) {
        const FragmentPose drawn = destruction.poses()[0];
        CHECK(drawn.pose.translation == pose.translation);
        CHECK(drawn.pose.rotation == pose.rotation);
        CHECK(drawn.previous.translation == pose.translation);
        CHECK(drawn.previous.rotation == pose.rotation);
        for (int step = 0; step <= i; ++step) bullet.step();
    }
}

TEST_CASE("poses are listed by object, then by fragment") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level2 = {2, 1, 1}});
    const ObjectId first = destruction.spawn(asset, at(0, 0, 0)).value();
    const ObjectId second = destruction.spawn(asset, at(5, 0, 0)).value();
    REQUIRE(destruction.breakFragment(second));
    REQUIRE(destruction.breakFragment(first));
    REQUIRE(destruction.breakFragment(first, 2));
    REQUIRE(destruction.breakFragment(first, 1));
    const auto poses = destruction.poses();
    for (size_t i = 1; i < poses.size(); ++i) {
        const bool ordered = std::pair(poses[i - 1].object.index, poses[i - 1].fragment) <
                             std::pair(poses[i].object.index, poses[i].fragment);
        CHECK(ordered);
    }
}
