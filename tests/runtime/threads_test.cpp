// SPDX-License-Identifier: MIT
// Worlds of their own on threads of their own, over assets they share. The thread sanitizer runs
// this (`./dev test`); it sees Sherd's code and what of Bullet is in headers, not the library that
// the distribution compiled.
#include <doctest/doctest.h>

#include <atomic>
#include <cstring>
#include <mutex>
#include <thread>

#include "impact/bullet_world.h"
#include "sherd/formats/glb_write.h"
#include "sherd/runtime/sherd.h"
#include "support/fractured_cube.h"

using namespace sherd;
using namespace sherd::test;

namespace {

std::vector<uint8_t> bakedCube() {
    FracturedCubeOptions options;
    options.splits = {{2, 1, 1}, {1, 2, 2}, {2, 1, 1}};
    FractureSet set = makeFracturedCube(options);
    const GltfDocument document = makeIntactDocument(set);
    const NewMaterial inside{"inside", {0.8F, 0.7F, 0.6F, 1.0F}, 0.0F, 1.0F};
    return attachFractureSets(document, {&set, 1}, {&inside, 1}).value();
}

/// What the loading thread hands over.
class Newest {
  public:
    explicit Newest(std::shared_ptr<const Asset> asset) : asset_(std::move(asset)) {}
    void put(std::shared_ptr<const Asset> asset) {
        const std::lock_guard lock(mutex_);
        asset_ = std::move(asset);
    }
    std::shared_ptr<const Asset> get() {
        const std::lock_guard lock(mutex_);
        return asset_;
    }

  private:
    std::mutex mutex_;
    std::shared_ptr<const Asset> asset_;
};

struct Outcome {
    std::vector<float> places;
    uint32_t bonds = 0, restored = 0, refused = 0;
};

/// A row of objects, balls that fly into it, and all a game may ask meanwhile.
Outcome play(const std::shared_ptr<const Asset>& shared, Newest& newest) {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world);
    std::vector<ObjectId> row;
    row.reserve(4);
    for (int i = 0; i < 4; ++i)
        row.push_back(destruction.spawn(shared, at(3.0F * float(i), 0.55F, 0)).value());
    for (int i = 0; i < 4; ++i)
        bullet.addBall(0.3F, 200, btVector3(3.0F * float(i), 0.6F, -3), btVector3(0, 0, 20));
    Outcome outcome;
    for (int step = 0; step < 60; ++step) {
        bullet.step();
        for (const BreakEvent& event : destruction.events()) outcome.bonds += event.bonds;
        // Loaded on another thread just now; the same bake.
        const ObjectId late = destruction.spawn(newest.get(), at(0, 50, 0)).value();
        if (destruction.restore(late, destruction.save(row[0]))) ++outcome.restored;
        if (!destruction.restore(late, {})) ++outcome.refused;
        destruction.remove(late);
    }
    for (const ObjectId object : row) destruction.breakAll(object);
    for (const FragmentPose& pose : destruction.poses())
        for (int i = 0; i < 3; ++i) outcome.places.push_back(pose.pose.translation[i]);
    return outcome;
}

void ignoreBody(void*, const sherd_body*) {}
void ignoreRemoval(void*, uint32_t) {}
void stay(void*, uint32_t, sherd_motion*) {}

/// The same through C: worlds come and go, and hold an asset that others release.
uint32_t playInC(sherd_asset shared) {
    const sherd_body_table table{nullptr, ignoreBody, ignoreBody, ignoreRemoval, stay};
    uint32_t broken = 0;
    for (int round = 0; round < 50; ++round) {
        sherd_world world{};
        sherd_object object{};
        const sherd_pose place{{0, 0, 0}, {0, 0, 0, 1}};
        if (sherd_world_create(&table, nullptr, &world, nullptr) != SHERD_OK) return 0;
        if (sherd_spawn(world, shared, &place, nullptr, &object, nullptr) != SHERD_OK) return 0;
        sherd_break_all(world, object);
        uint32_t count = 0;
        const sherd_break_event* event = sherd_events(world, &count);
        for (uint32_t e = 0; e < count; ++e) broken += event[e].bonds;
        sherd_world_destroy(world);
    }
    return broken;
}

}  // namespace

TEST_CASE("two worlds on two threads break one shared asset while a third thread loads more") {
    const std::vector<uint8_t> glb = bakedCube();
    const auto shared = loadAssets(glb).value().front();
    Newest newest(shared);
    std::atomic<bool> isOver{false};
    uint32_t loaded = 0;
    std::thread loader([&] {
        do {
            newest.put(loadAssets(glb).value().front());
            ++loaded;
        } while (!isOver);
    });
    Outcome first, second;
    std::thread other([&] { second = play(shared, newest); });
    first = play(shared, newest);
    other.join();
    isOver = true;
    loader.join();
    CHECK(loaded > 0);
    CHECK(first.bonds > 0);
    CHECK(first.restored == 60);
    CHECK(first.refused == 60);
    // Neither disturbs the other: the same bits.
    CHECK(first.places == second.places);
    CHECK(first.bonds == second.bonds);
}

TEST_CASE("C worlds on two threads share an asset that a third loads and releases meanwhile") {
    const std::vector<uint8_t> glb = bakedCube();
    uint32_t count = 0;
    sherd_asset shared{};
    REQUIRE(sherd_load(glb.data(), glb.size(), &shared, 1, &count, nullptr) == SHERD_OK);
    std::atomic<bool> isOver{false};
    uint32_t wrong = 0;
    std::thread loader([&] {
        do {
            sherd_asset mine{};
            sherd_asset_info info{};
            uint32_t one = 0;
            if (sherd_load(glb.data(), glb.size(), &mine, 1, &one, nullptr) != SHERD_OK) ++wrong;
            if (sherd_asset_get_info(mine, &info) != SHERD_OK) ++wrong;
            if (std::strlen(info.name) > 1000) ++wrong;
            sherd_asset_release(mine);
            if (sherd_asset_get_info(mine, &info) != SHERD_GONE) ++wrong;
        } while (!isOver);
    });
    uint32_t first = 0, second = 0;
    std::thread other([&] { second = playInC(shared); });
    first = playInC(shared);
    other.join();
    isOver = true;
    loader.join();
    CHECK(wrong == 0);
    CHECK(first > 0);
    CHECK(first == second);
    sherd_asset_release(shared);
    sherd_asset_info info{};
    CHECK(sherd_asset_get_info(shared, &info) == SHERD_GONE);
}
