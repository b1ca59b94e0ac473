// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstring>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Poses and events of 600 substeps as bytes, in the order they were listed.
std::vector<uint8_t> record() {
    std::vector<uint8_t> log;
    const auto put = [&log](const auto& value) {
        const auto* bytes = reinterpret_cast<const uint8_t*>(&value);
        log.insert(log.end(), bytes, bytes + sizeof(value));
    };
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level2 = {2, 2, 2}, .toughness = 5, .hullGrowth = 0.005F});
    for (int i = 0; i < 4; ++i) {
        (void)destruction.spawn(asset, at(float(i) * 1.3F, 0.5F + float(i) * 0.7F, 0));
    }
    bullet.addBall(0.2F, 100, btVector3(-3, 0.6F, 0.1F), btVector3(20, 0, 0));
    for (int i = 0; i < 600; ++i) {
        bullet.step();
        for (const BreakEvent& event : destruction.events()) {
            put(event.fragment);
            put(event.energy);
        }
        for (const FragmentPose& pose : destruction.poses()) {
            put(pose.fragment);
            put(pose.pose.translation);
            put(pose.pose.rotation);
        }
    }
    return log;
}

}  // namespace

TEST_CASE("two identical runs give identical bits over 600 frames") {
    const auto first = record();
    const auto second = record();
    REQUIRE(first.size() == second.size());
    CHECK(std::memcmp(first.data(), second.data(), first.size()) == 0);
}
