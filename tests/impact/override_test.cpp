// SPDX-License-Identifier: MIT
// What the file says of single pieces.
#include <doctest/doctest.h>

#include <cmath>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

constexpr uint32_t kPiece = 3;

/// Four pieces in a row, of which one is as its own row of the file says.
template <class Change>
std::shared_ptr<const Asset> rowWith(const Change& change) {
    FractureSet set = makeBoxFracture({.size = {2, 0.5F, 0.5F}, .level1 = {4, 1, 1}});
    change(set);
    return Asset::fromFractureSet(std::move(set)).value();
}

bool isOf(const Bond& bond, uint32_t fragment) {
    return bond.a == int32_t(fragment) || bond.b == int32_t(fragment);
}

/// Which bonds a blow in the middle breaks.
std::vector<bool> brokenBy(const std::shared_ptr<const Asset>& asset, float energy, float speed) {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId row = destruction.spawn(asset, at(0, 0, 0)).value();
    ReportedHit hit;
    hit.point = {0, 0.25F, 0};
    hit.energy = energy;
    hit.speed = speed;
    hit.impulse = 1;
    REQUIRE(destruction.reportHit(*destruction.body(row), hit).has_value());
    std::vector<bool> broken;
    for (uint32_t b = 0; b < asset->graph().bonds().size(); ++b)
        broken.push_back(destruction.structure(row)->isBroken(b));
    return broken;
}

}  // namespace

TEST_CASE(
    "a piece has the friction and the restitution that the file gives it, its neighbours theirs") {
    const auto asset = rowWith([](FractureSet& set) {
        set.fragments[kPiece].friction = 0.9F;
        set.fragments[kPiece].restitution = 0.4F;
    });
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId row = destruction.spawn(asset, at(0, 0, 0)).value();
    REQUIRE(destruction.breakAll(row));
    for (uint32_t f = 1; f <= 4; ++f) {
        const btRigidBody& body = *destruction.body(row, f);
        CHECK(body.getFriction() == (f == kPiece ? 0.9F : asset->fragment(f).friction));
        CHECK(body.getRestitution() == (f == kPiece ? 0.4F : asset->fragment(f).restitution));
    }
}

TEST_CASE("bonds that the file makes strong or tough hold where their neighbours break") {
    const auto all = brokenBy(rowWith([](FractureSet&) {}), 1e4F, 100);
    REQUIRE(all.size() == 3);
    CHECK(std::count(all.begin(), all.end(), true) == 3);
    const auto strong = rowWith([](FractureSet& set) {
        for (Bond& bond : set.bonds)
            if (isOf(bond, kPiece)) bond.strength = 1e12F;
    });
    const auto tough = rowWith([](FractureSet& set) {
        for (Bond& bond : set.bonds)
            if (isOf(bond, kPiece)) bond.toughness = 1e9F;
    });
    for (const auto& asset : {strong, tough}) {
        const auto broken = brokenBy(asset, 1e4F, 100);
        for (uint32_t b = 0; b < broken.size(); ++b) {
            const BondGraph::Bond& bond = asset->graph().bond(b);
            const bool isHeld = asset->graph().fragmentOfLeaf(bond.a) == kPiece ||
                                asset->graph().fragmentOfLeaf(bond.b) == kPiece;
            CHECK(broken[b] != isHeld);
        }
    }
}

TEST_CASE("of two objects that meet, the one of weaker pieces takes the damage first") {
    const auto weak = rowWith([](FractureSet& set) {
        for (Fragment& fragment : set.fragments) fragment.strength = 1e3F;
    });
    const auto plain = rowWith([](FractureSet&) {});
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    SpawnOptions fast;
    fast.linearVelocity = {3, 0, 0};
    const ObjectId left = destruction.spawn(plain, at(-2.1F, 0, 0), fast).value();
    const ObjectId right = destruction.spawn(weak, at(0, 0, 0)).value();
    std::vector<BreakEvent> events;
    REQUIRE(stepUntilBreak(bullet, destruction, 60, &events));
    CHECK(events[0].object == right);
    CHECK(destruction.isAlive(left));
}
