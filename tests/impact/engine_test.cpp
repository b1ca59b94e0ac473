// SPDX-License-Identifier: MIT
// The same hits through Bullet's adapter and through an engine that is only a table.
#include <doctest/doctest.h>

#include <map>
#include <random>

#include "impact/bullet_world.h"
#include "sherd/runtime/island_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Bodies that stay where they were put.
class StillBodies final : public BodyTable {
  public:
    void create(const IslandBody& body) override {
        CHECK(bodies.count(body.island) == 0);
        bodies[body.island] = body.motion;
        masses[body.island] = body.mass;
    }
    void update(const IslandBody& body) override {
        CHECK(bodies.count(body.island) == 1);
        bodies[body.island] = body.motion;
        masses[body.island] = body.mass;
    }
    void remove(uint32_t island) override {
        CHECK(bodies.erase(island) == 1);
        masses.erase(island);
    }
    [[nodiscard]] BodyMotion motion(uint32_t island) const override { return bodies.at(island); }

    std::map<uint32_t, BodyMotion> bodies;
    std::map<uint32_t, float> masses;
};

}  // namespace

TEST_CASE("the same hits break the same bonds, whatever the engine") {
    const auto asset = makeBox({.level1 = {3, 2, 2}, .level2 = {2, 2, 1}, .toughness = 10});
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId ours = destruction.spawn(asset, at(1, 2, 3)).value();
    StillBodies bodies;
    IslandWorld islands(bodies);
    const ObjectId other = islands.spawn(asset, at(1, 2, 3), {}, true, {});
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    uint32_t broken = 0;
    for (int i = 0; i < 60; ++i) {
        // On some standing fragment.
        uint32_t fragment = UINT32_MAX;
        while (fragment == UINT32_MAX || !destruction.body(ours, fragment))
            fragment = uint32_t(unit(random) * 0.999F * float(asset->fragmentCount()));
        ReportedHit hit;
        hit.point = asset->fragment(fragment).centerOfMass + glm::vec3(1, 2, 3);
        hit.energy = 30 * unit(random);
        hit.speed = 5 * unit(random);
        hit.impulse = 1;
        const uint32_t island = islands.findIsland(other.index, fragment);
        REQUIRE(island != UINT32_MAX);
        btRigidBody& body = *destruction.body(ours, fragment);
        int child = -1;  // of a compound: one that belongs to the fragment
        if (body.getCollisionShape()->isCompound()) {
            child = 0;
            while (destruction.find(body, child)->fragment != fragment) ++child;
        }
        const float consumed = destruction.reportHit(body, hit, child).value();
        CHECK(islands.takeHit(island, fragment, hit) == consumed);
        for (uint32_t b = 0; b < asset->graph().bonds().size(); ++b)
            REQUIRE(destruction.structure(ours)->lost(b) ==
                    islands.object(other.index).structure->lost(b));
        REQUIRE(destruction.bodyCount() == islands.islandCount());
        REQUIRE(destruction.poses().size() == islands.poses().size());
        const auto events = islands.takeEvents();
        const auto oursToo = destruction.events();
        REQUIRE(events.size() == oursToo.size());
        if (!events.empty()) broken += events[0].bonds;
    }
    CHECK(broken > 20);
    double mass = 0;
    for (const auto& [island, m] : bodies.masses) mass += double(m);
    CHECK(mass == doctest::Approx(1000));
    islands.remove(other.index);
    CHECK(bodies.bodies.empty());
}
