// SPDX-License-Identifier: MIT
// What Sherd takes from the heap while a game runs.
#include <LinearMath/btAlignedAllocator.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "impact/bullet_world.h"
#include "impact/by_hand.h"
#include "support/allocation_count.h"
#include "support/counting_memory.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Two levels, anchored by the first of its pieces.
std::shared_ptr<const Asset> anchoredWall() {
    FractureSet set = makeBoxFracture(
        {.size = {2, 2, 0.4F}, .level1 = {4, 4, 1}, .level2 = {2, 2, 1}, .toughness = 5});
    for (int32_t leaf = 0; leaf < int32_t(set.fragments.size()); ++leaf) {
        if (set.fragments[size_t(leaf)].children.count > 0) continue;
        if (set.fragments[size_t(leaf)].centerOfMass.y > -0.7F) continue;
        Bond anchor;
        anchor.a = leaf;
        anchor.area = 0.05F;
        anchor.normal = {0, -1, 0};
        anchor.centroid = set.fragments[size_t(leaf)].centerOfMass;
        set.bonds.push_back(anchor);
    }
    return Asset::fromFractureSet(std::move(set)).value();
}

struct Taken {
    uint64_t byAllocator = 0;
    uint64_t inAll = 0;
};

/// Walls are shot to pieces that fall, come to rest, freeze, fade and go; everything is asked for
/// in every step, as a game does. Returns how often Sherd took memory in its part of the steps.
Taken playThrough(BulletWorld& bullet, DestructionWorld& destruction, const CountingMemory& memory,
                  const std::shared_ptr<const Asset>& asset, int walls) {
    std::vector<ObjectId> objects;
    objects.reserve(size_t(walls));
    for (int w = 0; w < walls; ++w)
        objects.push_back(destruction.spawn(asset, at(4 * float(w), 1, 0)).value());
    Taken taken;
    uint32_t most = 0;
    std::vector<btRigidBody*> balls;
    for (int i = 0; i < 400; ++i) {
        for (int w = 0; i % 100 == 10 && w < walls; ++w) {
            const float x = 4 * float(w) - 0.6F + 0.004F * float(i);
            balls.push_back(
                &bullet.addBall(0.2F, 100, btVector3(x, 1.5F, -2), btVector3(0, 0, 12)));
        }
        bullet.step();
        const uint64_t before = memory.count(), beforeInAll = allocationCount();
        destruction.afterStep(kStep);
        (void)destruction.poses();
        (void)destruction.changedPoses();
        (void)destruction.events();
        (void)destruction.impacts();
        (void)destruction.islandEvents();
        (void)destruction.removals();
        taken.byAllocator += memory.count() - before;
        taken.inAll += allocationCount() - beforeInAll;
        most = std::max(most, destruction.bodyCount());
    }
    CHECK(most > 20);                       // they broke
    CHECK(destruction.bodyCount() < most);  // and pieces went
    for (const ObjectId object : objects) REQUIRE(destruction.remove(object));
    for (btRigidBody* ball : balls) bullet.take(*ball);
    return taken;
}

}  // namespace

TEST_CASE("after a busier time, Sherd takes no memory in steps, whatever breaks, rests and goes") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    CountingMemory memory;
    WorldOptions options = drivenByHand();
    options.allocator = &memory;
    options.leastImpact = 0.01F;
    options.debris.lifetime = 2;
    options.debris.fade = 0.5F;
    DestructionWorld destruction(bullet.world, options);
    const auto asset = anchoredWall();
    for (int i = 0; i < 3; ++i) (void)playThrough(bullet, destruction, memory, asset, 3);
    CHECK(memory.count() > 0);
    const Taken later = playThrough(bullet, destruction, memory, asset, 1);
    CHECK(later.byAllocator == 0);
    CHECK(later.inAll == 0);
}

TEST_CASE("what grows in steps comes from the game's allocator") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    CountingMemory memory;
    WorldOptions options = drivenByHand();
    options.allocator = &memory;
    options.debris.lifetime = 2;
    DestructionWorld destruction(bullet.world, options);
    // The counting memory takes it from `new`: more than it asked for would be Sherd's own asking.
    const Taken first = playThrough(bullet, destruction, memory, anchoredWall(), 1);
    CHECK(first.byAllocator > 0);
    CHECK(first.inAll <= first.byAllocator);
}

namespace {

uint64_t bulletAllocations = 0;
void* countedAllocation(size_t size) {
    ++bulletAllocations;
    return std::malloc(size);
}
void countedFree(void* memory) {
    std::free(memory);
}

/// Puts Bullet's own counting in and, in the end, its default back.
class BulletCount {
  public:
    BulletCount() { btAlignedAllocSetCustom(countedAllocation, countedFree); }
    ~BulletCount() { btAlignedAllocSetCustom(nullptr, nullptr); }
    BulletCount(const BulletCount&) = delete;
    BulletCount& operator=(const BulletCount&) = delete;
};

}  // namespace

TEST_CASE("Bullet takes no more memory for a break than when the same is done by hand") {
    const BulletCount counting;
    const auto asset = makeBox({.level1 = {5, 5, 5}});
    uint64_t ours = 0, byHand = 0;
    {
        BulletWorld bullet;
        DestructionWorld destruction(bullet.world);
        const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
        bullet.step();
        const uint64_t before = bulletAllocations;
        REQUIRE(destruction.breakFragment(box));
        ours = bulletAllocations - before;
    }
    {
        BulletWorld bullet;
        const FragmentShapes shapes(asset);
        std::vector<std::unique_ptr<btRigidBody>> bodies;
        const auto add = [&](uint32_t f) {
            bodies.push_back(bodyByHand(shapes, f));
            bullet.world.addRigidBody(bodies.back().get());
        };
        add(0);
        bullet.step();
        const uint64_t before = bulletAllocations;
        bullet.world.removeRigidBody(bodies[0].get());
        for (uint32_t f = 1; f < asset->fragmentCount(); ++f) add(f);
        byHand = bulletAllocations - before;
        for (size_t b = 1; b < bodies.size(); ++b) bullet.world.removeRigidBody(bodies[b].get());
    }
    CHECK(byHand > 0);
    CHECK(ours <= byHand);
}

TEST_CASE("bodies lie one behind the other, and places of those that are gone are used again") {
    BulletWorld bullet;
    CountingMemory memory;
    WorldOptions options;
    options.allocator = &memory;
    DestructionWorld destruction(bullet.world, options);
    const auto asset = makeBox();
    std::vector<ObjectId> objects;
    std::vector<std::uintptr_t> places;
    for (int i = 0; i < 500; ++i) {
        objects.push_back(destruction.spawn(asset, at(2 * float(i), 0, 0)).value());
        places.push_back(std::uintptr_t(destruction.body(objects.back())));
        CHECK(places.back() % 64 == places.front() % 64);
    }
    size_t behind = 0;
    for (size_t i = 1; i < places.size(); ++i)
        if (places[i] - places[i - 1] == places[1] - places[0]) ++behind;
    CHECK(behind > 480);
    for (const ObjectId object : objects) REQUIRE(destruction.remove(object));
    const uint64_t before = memory.count();
    for (int i = 0; i < 500; ++i) {
        const ObjectId again = destruction.spawn(asset, at(2 * float(i), 0, 0)).value();
        const auto place = std::uintptr_t(destruction.body(again));
        CHECK(std::find(places.begin(), places.end(), place) != places.end());
    }
    CHECK(memory.count() == before);
}
