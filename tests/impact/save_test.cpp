// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstring>
#include <random>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

const BoxFracture kBox{.level2 = {2, 2, 2}, .toughness = 5, .hullGrowth = 0.005F};

/// A world in which a box lies broken on the ground, still rolling.
struct Scene {
    explicit Scene(const std::shared_ptr<const Asset>& asset, bool authority = true)
        : bullet(btVector3(0, -10, 0)), destruction(bullet.world, options(authority)) {
        bullet.addGround(0);
        box = destruction.spawn(asset, at(0, 0.5F, 0)).value();
    }
    static WorldOptions options(bool authority) {
        WorldOptions result;
        result.authority = authority;
        return result;
    }
    void breakUp() {
        bullet.addBall(0.2F, 60, btVector3(-3, 0.6F, 0.1F), btVector3(15, 0, 0));
        for (int i = 0; i < 40; ++i) bullet.step();
        REQUIRE(destruction.bodyCount() > 4);
        (void)destruction.events();
    }
    std::vector<uint8_t> poses() const {
        std::vector<uint8_t> bytes;
        for (const FragmentPose& pose : destruction.poses()) {
            const auto put = [&bytes](const auto& value) {
                const auto* first = reinterpret_cast<const uint8_t*>(&value);
                bytes.insert(bytes.end(), first, first + sizeof(value));
            };
            put(pose.fragment);
            put(pose.pose.translation);
            put(pose.pose.rotation);
            put(pose.previous.translation);
        }
        return bytes;
    }
    BulletWorld bullet;
    DestructionWorld destruction;
    ObjectId box;
};

}  // namespace

TEST_CASE("a saved object comes back bit for bit, and two restored ones go on alike") {
    const auto asset = makeBox(kBox);
    Scene first(asset);
    first.breakUp();
    const std::vector<uint8_t> saved = first.destruction.save(first.box);
    Scene second(asset), third(asset);
    for (Scene* scene : {&second, &third}) {
        REQUIRE(scene->destruction.restore(scene->box, saved).has_value());
        CHECK(scene->poses() == first.poses());
        CHECK(scene->destruction.events().empty());
        CHECK(scene->destruction.bodyCount() == first.destruction.bodyCount());
        for (uint32_t b = 0; b < asset->graph().bonds().size(); ++b)
            CHECK(scene->destruction.structure(scene->box)->lost(b) ==
                  first.destruction.structure(first.box)->lost(b));
        CHECK(scene->destruction.save(scene->box).size() == saved.size());
    }
    for (int i = 0; i < 300; ++i) {
        second.bullet.step();
        third.bullet.step();
        REQUIRE(second.poses() == third.poses());
    }
}

TEST_CASE("a late joiner who has hit the object himself gets the same end state") {
    const auto asset = makeBox(kBox);
    Scene first(asset), late(asset);
    first.breakUp();
    REQUIRE(late.destruction.breakFragment(late.box));
    (void)late.destruction.events();
    REQUIRE(late.destruction.restore(late.box, first.destruction.save(first.box)).has_value());
    CHECK(late.poses() == first.poses());
    CHECK(late.destruction.events().empty());
    CHECK(late.bullet.world.getNumCollisionObjects() == 1 + int(late.destruction.bodyCount()));
}

TEST_CASE("a whole object takes few bytes, and comes back whole") {
    const auto asset = makeBox(kBox);
    Scene first(asset), second(asset);
    for (int i = 0; i < 10; ++i) first.bullet.step();
    const auto saved = first.destruction.save(first.box);
    CHECK(saved.size() < 256);
    REQUIRE(second.destruction.breakAll(second.box));
    REQUIRE(second.destruction.restore(second.box, saved).has_value());
    CHECK(second.poses() == first.poses());
    CHECK(second.destruction.bodyCount() == 1);
}

TEST_CASE("a save of another bake, or one that was spoiled, is refused and changes nothing") {
    const auto asset = makeBox(kBox);
    Scene first(asset);
    first.breakUp();
    const auto saved = first.destruction.save(first.box);
    Scene other(makeBox({.level1 = {3, 2, 2}}));
    const auto refused = other.destruction.restore(other.box, saved);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().message.find("another bake") != std::string::npos);

    Scene second(asset);
    const auto before = second.poses();
    for (size_t length = 0; length < saved.size(); length += 1 + length / 16) {
        const auto cut = second.destruction.restore(second.box, std::span(saved).first(length));
        CHECK_FALSE(cut.has_value());
    }
    std::vector<uint8_t> longer(saved);
    longer.push_back(0);
    CHECK_FALSE(second.destruction.restore(second.box, longer).has_value());
    CHECK(second.poses() == before);
    CHECK(second.destruction.bodyCount() == 1);
}

TEST_CASE("a save with any byte changed is refused or still a sound object") {
    const auto asset = makeBox(kBox);
    Scene first(asset), second(asset);
    first.breakUp();
    const auto saved = first.destruction.save(first.box);
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
        std::vector<uint8_t> spoiled(saved);
        for (int k = 0; k <= i % 3; ++k) spoiled[random() % spoiled.size()] = uint8_t(random());
        if (!second.destruction.restore(second.box, spoiled)) continue;
        std::vector<int> times(asset->fragmentCount(), 0);
        for (const FragmentPose& pose : second.destruction.poses()) ++times[pose.fragment];
        uint32_t leaves = 0;
        for (uint32_t f = 0; f < times.size(); ++f) {
            CHECK(times[f] <= 1);
            if (times[f] == 1) leaves += asset->graph().leavesOf(f).count;
        }
        CHECK(leaves == asset->graph().leafCount());
    }
}

TEST_CASE("a world without authority breaks nothing by itself, only what it is told") {
    const auto asset = makeBox(kBox);
    Scene scene(asset, false);
    scene.bullet.addBall(0.2F, 60, btVector3(-3, 0.6F, 0.1F), btVector3(15, 0, 0));
    for (int i = 0; i < 40; ++i) scene.bullet.step();
    CHECK(scene.destruction.bodyCount() == 1);
    CHECK(scene.destruction.events().empty());
    Scene first(asset);
    first.breakUp();
    REQUIRE(scene.destruction.restore(scene.box, first.destruction.save(first.box)).has_value());
    CHECK(scene.destruction.bodyCount() == first.destruction.bodyCount());
}
