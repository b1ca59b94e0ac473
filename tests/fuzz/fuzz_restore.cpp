// SPDX-License-Identifier: MIT
// What a saved game or a stranger on the network gives: an object that is whole in its parts and
// goes on, or an error that changes nothing. The same bytes go to Bullet's adapter and to a table.
#include <cmath>

#include "fuzzed_promise.h"
#include "impact/bullet_world.h"
#include "saved_object_mutation.h"
#include "sherd/runtime/object_state.h"
#include "support/still_bodies.h"

namespace {

using namespace sherd;
using fuzz::require;

/// How many leaves were not removed.
uint32_t leavesLeft(const Structure& structure) {
    uint32_t count = 0;
    for (uint32_t leaf = 0; leaf < structure.graph().leafCount(); ++leaf)
        count += structure.isGone(leaf) ? 0 : 1;
    return count;
}

/// Its leaves that are left, each drawn once.
void requireWhole(const Structure& structure, std::span<const FragmentPose> poses) {
    const Asset& asset = structure.asset();
    std::vector<uint8_t> seen(asset.fragmentCount(), 0);
    uint32_t leaves = 0;
    for (const FragmentPose& pose : poses) {
        require(seen[pose.fragment]++ == 0, "no fragment is drawn twice");
        leaves += asset.graph().leavesOf(pose.fragment).count;
        require(std::isfinite(pose.pose.translation.x), "a pose is finite");
    }
    require(leaves == leavesLeft(structure), "every leaf is drawn");
}

WorldOptions byHand() {
    WorldOptions options;
    options.drive = Drive::manual;
    return options;
}

/// Made once: an asset, and objects of it in every state there is.
struct Starts {
    std::shared_ptr<const Asset> asset =
        test::makeBox({.level1 = {2, 2, 1}, .level2 = {2, 1, 2}, .toughness = 5});
    test::BulletWorld bullet;
    std::vector<std::vector<uint8_t>> saved;

    Starts() {
        add([](DestructionWorld&, ObjectId) {});
        add([](DestructionWorld& world, ObjectId object) { (void)world.breakFragment(object); });
        add([](DestructionWorld& world, ObjectId object) { (void)world.breakAll(object); });
        add([](DestructionWorld& world, ObjectId object) {
            (void)world.breakAll(object);
            require(world.removePiece(object, world.poses()[2].fragment), "a piece goes");
        });
        add([](DestructionWorld& world, ObjectId object) {
            (void)world.anchorInBox(object, glm::vec3(-9, -9, -9), glm::vec3(0, 0, 0));
            AreaDamage damage;
            damage.radius = 0.6F;
            damage.a = {0.4F, 0.4F, 0};
            damage.fluence = 30;
            (void)world.damage(object, damage);
        });
    }
    template <class Work>
    void add(const Work& work) {
        DestructionWorld world(bullet.world, byHand());
        const ObjectId object = world.spawn(asset, {}).value();
        work(world, object);
        bullet.step();
        world.afterStep(test::kStep);
        saved.push_back(world.save(object));
        const auto parts = fuzz::SavedParts::parse(saved.back());
        require(parts && parts->bytes() == saved.back(), "the mutations know the format");
        require(readSavedObject(asset, saved.back()).has_value(), "what was saved can be read");
    }
};

Starts& starts() {
    static Starts made;
    return made;
}

void restoreInBullet(std::span<const uint8_t> bytes, bool isReadable) {
    Starts& start = starts();
    DestructionWorld world(start.bullet.world, byHand());
    const ObjectId object = world.spawn(start.asset, {}).value();
    const auto restored = world.restore(object, bytes);
    require(isReadable || !restored, "the adapter restores what the core can read");
    requireWhole(*world.structure(object), world.poses());
    if (!restored) {
        require(!restored.error().message.empty(), "an error says what");
        require(world.bodyCount() == 1, "a refused save changes nothing");
        return;
    }
    const std::vector<uint8_t> again = world.save(object);
    const ObjectId other = world.spawn(start.asset, {}).value();
    require(world.restore(other, again).has_value(), "what was restored can be saved");
    require(world.save(other) == again, "and is the same, to the bit");
    (void)world.remove(other);
    start.bullet.step();
    world.afterStep(test::kStep);
    (void)world.breakAll(object);
    require(world.poses().size() == leavesLeft(*world.structure(object)), "all of it breaks");
}

void restoreInTable(SavedObject&& saved) {
    const auto& asset = starts().asset;
    test::StillBodies bodies;
    IslandWorld world(bodies);
    const ObjectId object = world.spawn(asset, {}, {}, true, {});
    restoreObject(world, object.index, std::move(saved));
    const Structure& structure = *world.object(object.index).structure;
    require(world.takeEvents().empty(), "restoring fires nothing");
    requireWhole(structure, world.poses());
    for (uint32_t i = 0; i < world.islands().size(); ++i)
        if (world.island(i).isAlive) world.follow(i);
    world.workOnStress({0, -10, 0}, 16);
    world.workOnStress({0, -1e9F, 0}, 16);
    requireWhole(structure, world.poses());
    world.breakAll(object.index);
    require(world.poses().size() == leavesLeft(structure), "all of it breaks");
    world.remove(object.index);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::span<const uint8_t> bytes(data, size);
    auto saved = readSavedObject(starts().asset, bytes);
    restoreInBullet(bytes, saved.has_value());
    if (saved) restoreInTable(std::move(*saved));
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize,
                                          unsigned seed) {
    return fuzz::SavedObjectMutation(seed)(data, size, maxSize, starts().saved);
}
