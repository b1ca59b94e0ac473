// SPDX-License-Identifier: MIT
// Saved by one engine's adapter, restored by another's.
#include <doctest/doctest.h>

#include <cmath>

#include "impact/bullet_world.h"
#include "sherd/runtime/object_state.h"
#include "support/still_bodies.h"

using namespace sherd;
using namespace sherd::test;

namespace {

const BoxFracture kSavedBox{.level2 = {2, 2, 2}, .toughness = 5};

void checkSamePlaces(std::span<const FragmentPose> x, std::span<const FragmentPose> y) {
    REQUIRE(x.size() == y.size());
    for (size_t i = 0; i < x.size(); ++i) {
        CHECK(x[i].fragment == y[i].fragment);
        CHECK(x[i].pose.translation == y[i].pose.translation);
        CHECK(x[i].pose.rotation == y[i].pose.rotation);
        CHECK(x[i].previous.translation == y[i].previous.translation);
    }
}

std::vector<uint8_t> brokenInBullet(BulletWorld& bullet, DestructionWorld& destruction,
                                    ObjectId object) {
    bullet.addBall(0.2F, 60, btVector3(-3, 0.1F, 0.1F), btVector3(15, 0, 0));
    for (int i = 0; i < 40; ++i) bullet.step();
    REQUIRE(destruction.bodyCount() > 4);
    return destruction.save(object);
}

}  // namespace

TEST_CASE("what Bullet's adapter saved a table restores, and the other way round") {
    const auto asset = makeBox(kSavedBox);
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    const auto saved = brokenInBullet(bullet, destruction, box);

    StillBodies bodies;
    IslandWorld table(bodies);
    const ObjectId there = table.spawn(asset, at(5, 5, 5), {}, true, {});
    auto read = readSavedObject(asset, saved);
    REQUIRE(read.has_value());
    CHECK(read->engine != 0);
    CHECK_FALSE(read->engineBytes.empty());
    restoreObject(table, there.index, std::move(*read));
    CHECK(table.islandCount() == destruction.bodyCount());
    CHECK(table.takeEvents().empty());
    checkSamePlaces(table.poses(), destruction.poses());
    for (uint32_t b = 0; b < asset->graph().bonds().size(); ++b)
        CHECK(table.object(there.index).structure->lost(b) == destruction.structure(box)->lost(b));

    // The table's engine sees the very motion that Bullet's bodies had.
    for (const FragmentPose& pose : table.poses()) {
        const btRigidBody& body = *destruction.body(box, pose.fragment);
        const BodyMotion& motion = bodies.motions[table.findIsland(there.index, pose.fragment)];
        CHECK(motion.pose.translation.x == body.getCenterOfMassPosition().x());
        CHECK(motion.linearVelocity.y == body.getLinearVelocity().y());
        CHECK(motion.angularVelocity.z == body.getAngularVelocity().z());
    }

    BulletWorld otherBullet;
    DestructionWorld other(otherBullet.world);
    const ObjectId back = other.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(other.restore(back, saveObject(table, there.index)).has_value());
    checkSamePlaces(other.poses(), destruction.poses());
    otherBullet.step();
    CHECK(other.bodyCount() == destruction.bodyCount());
}

TEST_CASE("a save with another adapter's bytes, or of another version, is told apart") {
    const auto asset = makeBox(kSavedBox);
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    StillBodies bodies;
    IslandWorld table(bodies);
    const ObjectId there = table.spawn(asset, at(1, 2, 3), {}, true, {});
    const std::vector<uint8_t> own{1, 2, 3};
    CHECK(destruction.restore(box, saveObject(table, there.index, 7, own)).has_value());
    CHECK(destruction.poses()[0].pose.translation == glm::vec3(1, 2, 3));

    auto saved = destruction.save(box);
    const size_t basis = saved.size() - 41;  // of the only body: where Bullet's own bytes begin
    saved[basis + 3] ^= 0x40;
    CHECK_FALSE(destruction.restore(box, saved).has_value());
    saved[basis + 3] ^= 0x40;
    saved[basis + 3] ^= 0x80;  // a mirror, whose rows are of unit length
    CHECK_FALSE(destruction.restore(box, saved).has_value());
    saved[basis + 3] ^= 0x80;
    REQUIRE(destruction.restore(box, saved).has_value());
    saved[3] = '1';
    const auto refused = destruction.restore(box, saved);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().message.find("another version") != std::string::npos);
    saved[0] = 'X';
    CHECK_FALSE(destruction.restore(box, saved).has_value());
}

TEST_CASE("a state that no object gets into is refused") {
    const auto asset = makeBox(kSavedBox);
    StillBodies bodies;
    IslandWorld table(bodies);
    const ObjectId box = table.spawn(asset, at(0, 0, 0), {}, true, {});
    Structure& structure = *table.object(box.index).structure;
    const auto refusal = [&] {
        const auto read = readSavedObject(asset, saveObject(table, box.index));
        return read ? std::string() : read.error().message;
    };
    CHECK(refusal().empty());
    structure.breakBond(0);  // and nothing opens
    CHECK(refusal().find("stands whole") != std::string::npos);
    structure.open(0);
    table.regroup(0);
    (void)table.split(0, {});
    REQUIRE(table.islandCount() == 1);
    while (structure.fragmentAt(structure.graph().bond(0).a) ==
           structure.fragmentAt(structure.graph().bond(0).b)) {
        structure.open(structure.fragmentAt(structure.graph().bond(0).a));
        table.regroup(0);
        (void)table.split(0, {});
    }
    CHECK(refusal().empty());
    for (const uint32_t fragment : table.island(0).fragments)
        for (uint32_t b = 0; b < structure.graph().bonds().size(); ++b)
            if (structure.fragmentAt(structure.graph().bond(b).a) == fragment &&
                structure.fragmentAt(structure.graph().bond(b).b) != fragment)
                structure.breakBond(b);  // and nothing comes apart
    CHECK(refusal().find("hang together") != std::string::npos);
}

TEST_CASE("an object breaks however far away it is") {
    const auto asset = makeBox(kSavedBox);
    StillBodies bodies;
    IslandWorld table(bodies);
    const ObjectId box = table.spawn(asset, at(1e30F, 0, 0), {}, true, {});
    table.breakAll(box.index);
    CHECK(table.islandCount() == asset->graph().leafCount());
}

TEST_CASE("what adapters take from a game is refused for the same reasons") {
    BulletWorld bullet;
    WorldOptions options;
    options.damage.immunity = -1;
    DestructionWorld destruction(bullet.world, options);
    const auto spawned = destruction.spawn(makeBox(), at(0, 0, 0));
    REQUIRE_FALSE(spawned.has_value());
    CHECK(spawned.error().where == "WorldOptions::damage");

    CHECK(whyRefused(DamageOptions{}) == nullptr);
    CHECK(whyRefused(DamageOptions{.toughnessScale = 0}) != nullptr);
    CHECK(whyRefused(DamageOptions{.levelScale = NAN}) != nullptr);
    CHECK(whyRefused(DamageOptions{.minimumEnergy = NAN}) != nullptr);
    CHECK(whyRefused(Contact{}) == nullptr);
    CHECK(whyRefused(Contact{.approachSpeed = -3}) == nullptr);  // they part
    CHECK(whyRefused(Contact{.impulse = -1}) != nullptr);
    CHECK(whyRefused(Contact{.effectiveMass = INFINITY}) != nullptr);
    CHECK(whyRefused(ReportedHit{}) == nullptr);
    CHECK(whyRefused(ReportedHit{.normal = {0, NAN, 0}}) != nullptr);
    CHECK(whyRefused(ReportedHit{.energy = INFINITY}) != nullptr);
    CHECK(whyRefused(RigidPose{}) == nullptr);
    CHECK(whyRefused(RigidPose{.rotation = glm::quat(0, 0, 0, 0)}) != nullptr);
    BodyMotion motion;
    CHECK(whyRefused(motion) == nullptr);
    motion.angularVelocity.x = INFINITY;
    CHECK(whyRefused(motion) != nullptr);
}
