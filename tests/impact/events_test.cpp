// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <utility>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

bool isSame(const FragmentPose& a, const FragmentPose& b) {
    return a.object == b.object && a.asset == b.asset && a.fragment == b.fragment &&
           a.pose.translation == b.pose.translation && a.pose.rotation == b.pose.rotation &&
           a.previous.translation == b.previous.translation &&
           a.previous.rotation == b.previous.rotation;
}

/// A copy of the poses that takes over only what it is told has changed, as a GPU buffer would.
class Mirror {
  public:
    /// Returns how many were copied.
    size_t follow(DestructionWorld& destruction) {
        const auto poses = destruction.poses();
        copy_.resize(poses.size());
        size_t copied = 0, end = 0;
        for (const Range& range : destruction.changedPoses()) {
            CHECK(range.count > 0);
            CHECK((copied == 0 || range.first > end));  // ascending, apart
            end = range.first + range.count;
            REQUIRE(end <= poses.size());
            for (size_t i = range.first; i < end; ++i) copy_[i] = poses[i];
            copied += range.count;
        }
        bool same = true;
        for (size_t i = 0; i < poses.size(); ++i) same = same && isSame(copy_[i], poses[i]);
        CHECK(same);
        return copied;
    }

  private:
    std::vector<FragmentPose> copy_;
};

}  // namespace

TEST_CASE("whoever copies only the poses that have changed has them all, through everything") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level2 = {2, 2, 2}, .toughness = 5});
    Mirror mirror;
    CHECK(mirror.follow(destruction) == 0);
    std::vector<ObjectId> objects;
    for (const float x : {0.0F, 1.5F, 3.0F, 4.5F})
        objects.push_back(destruction.spawn(asset, at(x, 2, 0)).value());
    CHECK(mirror.follow(destruction) == 4);
    CHECK(mirror.follow(destruction) == 0);
    bullet.addBall(0.2F, 100, btVector3(-3, 0.6F, 0.1F), btVector3(20, 0, 0));
    for (int i = 0; i < 240; ++i) {
        bullet.step();
        if (i == 20) REQUIRE(destruction.remove(objects[2]));
        if (i == 40) REQUIRE(destruction.breakAll(objects[3]));
        if (i == 50) (void)destruction.spawn(asset, at(8, 3, 0)).value();
        if (i == 60) REQUIRE(destruction.remove(objects[0]));
        if (i % 3 == 0) mirror.follow(destruction);  // not every substep is drawn
    }
    CHECK(destruction.poses().size() > 8);
}

namespace {

/// What is drawn and saved of a scene in which objects fall, are hit, come to rest, fade and go,
/// after each of its substeps that is `asked` for.
std::vector<std::pair<std::vector<FragmentPose>, std::vector<uint8_t>>> play(
    const std::vector<bool>& asked) {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    WorldOptions options;
    options.debris.lifetime = 1;
    options.debris.fade = 0.5F;
    DestructionWorld destruction(bullet.world, options);
    static const auto asset =
        makeBox({.level2 = {2, 2, 2}, .toughness = 5, .center = {0, 0.1F, 0}});
    std::vector<ObjectId> objects;
    const auto spawn = [&](const RigidPose& pose) {
        objects.push_back(destruction.spawn(asset, pose).value());
    };
    RigidPose turned = at(1.5F, 0.9F, 0);
    turned.rotation = glm::normalize(glm::quat(0.9F, 0.1F, 0.3F, 0.2F));
    spawn(at(0, 0.4F, 0));
    spawn(turned);
    std::vector<std::pair<std::vector<FragmentPose>, std::vector<uint8_t>>> seen;
    for (size_t i = 0; i < asked.size(); ++i) {
        if (i == 60) bullet.addBall(0.2F, 100, btVector3(-3, 0.6F, 0.1F), btVector3(20, 0, 0));
        if (i == 75) spawn(at(-3, 0.4F, 2));
        if (i == 90) (void)destruction.breakFragment(objects[1]);
        bullet.step();
        if (!asked[i]) continue;
        const auto poses = destruction.poses();
        seen.emplace_back(std::vector(poses.begin(), poses.end()),
                          destruction.save(objects.back()));
    }
    return seen;
}

}  // namespace

TEST_CASE("who asks for poses now and then is told what who asks after every substep is told") {
    constexpr size_t kSteps = 240;
    const auto always = play(std::vector<bool>(kSteps, true));
    REQUIRE(always.size() == kSteps);
    for (uint32_t seed = 1; seed <= 6; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        std::vector<bool> asked(kSteps);
        for (size_t i = 0; i < kSteps; ++i) asked[i] = random() % (seed + 1) == 0;
        const auto seldom = play(asked);
        size_t next = 0, different = 0;
        for (size_t i = 0; i < kSteps; ++i) {
            if (!asked[i]) continue;
            const auto& [poses, saved] = seldom[next++];
            different += std::equal(poses.begin(), poses.end(), always[i].first.begin(),
                                    always[i].first.end(), isSame) &&
                                 saved == always[i].second
                             ? 0
                             : 1;
        }
        CHECK(next > 10);
        CHECK(different == 0);
    }
}

TEST_CASE("what does not move is not copied, and what stops is copied once more") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    const ObjectId still = destruction.spawn(asset, at(0, 0, 0)).value();
    const ObjectId moving = destruction.spawn(asset, at(3, 0, 0)).value();
    destruction.body(moving)->setLinearVelocity(btVector3(1, 0, 0));
    Mirror mirror;
    mirror.follow(destruction);
    bullet.step();
    CHECK(mirror.follow(destruction) == 1);
    destruction.body(moving)->setLinearVelocity(btVector3(0, 0, 0));
    bullet.step();
    CHECK(mirror.follow(destruction) == 1);  // what was its pose is its previous one now
    bullet.step();
    CHECK(mirror.follow(destruction) == 0);
    REQUIRE(destruction.breakFragment(still));
    CHECK(mirror.follow(destruction) >= 8);
    CHECK(destruction.changedPoses().empty());
}

TEST_CASE("a hit that breaks nothing is an impact, weight at rest is none") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    WorldOptions options = unbreakable();
    options.leastImpact = 0.01F;
    DestructionWorld destruction(bullet.world, options);
    const auto asset = makeBox();
    const ObjectId box = destruction.spawn(asset, at(0, 0.5F, 0)).value();
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(destruction.impacts().empty());
    bullet.world.setGravity(btVector3(0, 0, 0));
    bullet.addBall(0.2F, 2, btVector3(-1.2F, 0.5F, 0), btVector3(5, 0, 0));
    std::vector<ImpactEvent> impacts;
    for (int i = 0; i < 30 && impacts.empty(); ++i) {
        bullet.step();
        const auto now = destruction.impacts();
        impacts.assign(now.begin(), now.end());
    }
    REQUIRE(impacts.size() == 1);
    const ImpactEvent& impact = impacts[0];
    CHECK(impact.object == box);
    CHECK(impact.asset == asset.get());
    CHECK(impact.fragment == 0);
    CHECK(impact.size == doctest::Approx(std::sqrt(3.0)).epsilon(0.01));
    CHECK(glm::distance(impact.point, glm::vec3(-0.5F, 0.5F, 0)) < 0.05F);
    CHECK(impact.normal.x == doctest::Approx(1).epsilon(0.01));
    CHECK(impact.approachSpeed == doctest::Approx(5).epsilon(0.01));
    // 1/2 m_eff v^2 of 2 kg against a tonne.
    CHECK(impact.energy == doctest::Approx(0.5 * (2.0 * 1000 / 1002) * 25).epsilon(0.02));
    CHECK(destruction.events().empty());
    for (int i = 0; i < 5; ++i) bullet.step();
    CHECK(destruction.impacts().empty());  // one hit is one impact
}

TEST_CASE("hits reported by the game are impacts too, and weak ones are left out") {
    BulletWorld bullet;
    WorldOptions options = unbreakable();
    options.leastImpact = 5;
    DestructionWorld destruction(bullet.world, options);
    const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
    ReportedHit hit;
    hit.point = {0, 0.5F, 0};
    hit.normal = {0, -1, 0};
    hit.energy = 4;
    (void)destruction.reportHit(*destruction.body(box), hit).value();
    CHECK(destruction.impacts().empty());
    hit.energy = 6;
    (void)destruction.reportHit(*destruction.body(box), hit).value();
    const auto impacts = destruction.impacts();
    REQUIRE(impacts.size() == 1);
    CHECK(impacts[0].energy == 6);
    CHECK(impacts[0].normal == hit.normal);
}

TEST_CASE("every body that comes off is told once, with its mass and where it is") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.size = {4, 1, 1}, .level1 = {4, 1, 1}, .center = {2, 0, 0}});
    const ObjectId bar = destruction.spawn(asset, at(1, 0, 0)).value();
    CHECK(destruction.islandEvents().empty());
    AreaDamage saw;
    saw.a = {4, 0, 0};
    saw.radius = 0.1F;
    saw.fluence = 1e9F;
    REQUIRE(destruction.damage(bar, saw).value() == 1);
    const auto born = destruction.islandEvents();
    REQUIRE(born.size() == 1);
    CHECK(born[0].object == bar);
    CHECK(born[0].fragment == 4);
    CHECK(born[0].fragments == 1);
    CHECK(born[0].from == 1);
    CHECK_FALSE(born[0].isFixed);
    CHECK(born[0].mass == doctest::Approx(asset->fragment(4).mass));
    CHECK(born[0].size == doctest::Approx(glm::distance(asset->box(4).low, asset->box(4).high)));
    CHECK(glm::distance(born[0].center, asset->fragment(4).centerOfMass + glm::vec3(1, 0, 0)) <
          1e-5F);
    CHECK(destruction.islandEvents().empty());
}

TEST_CASE("what loses its last anchor is told to be free") {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox({.level1 = {2, 1, 1}});
    const ObjectId box = destruction.spawn(asset, at(0, 5, 0)).value();
    REQUIRE(destruction.anchor(box, 0));
    (void)destruction.islandEvents();
    REQUIRE(destruction.anchor(box, 0, false));
    const auto born = destruction.islandEvents();
    REQUIRE(born.size() == 1);
    CHECK(born[0].from == born[0].fragment);
    CHECK_FALSE(born[0].isFixed);
    CHECK(born[0].mass == doctest::Approx(1000));
}
