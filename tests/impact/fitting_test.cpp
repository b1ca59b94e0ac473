// SPDX-License-Identifier: MIT
// What a game brings along: settings, threads, a job system, new bakes while it runs.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "impact/bullet_world.h"
#include "sherd/runtime/bullet/advice.h"
#include "sherd/runtime/bullet/prepared_asset.h"

using namespace sherd;
using namespace sherd::test;

namespace {

bool says(const DestructionWorld& destruction, Advice::Code code) {
    const std::vector<Advice> advice = destruction.advice();
    return std::any_of(advice.begin(), advice.end(), [&](const Advice& a) {
        CHECK(a.text.size() > 20);
        return a.code == code;
    });
}

/// Breaks a box with a ball, in a world of its own; where everything is in the end.
std::vector<btTransform> breakOne(const std::shared_ptr<const Asset>& asset,
                                  const PreparedAsset& prepared) {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(-2);
    DestructionWorld destruction(bullet.world);
    REQUIRE(destruction.use(prepared).has_value());
    SpawnOptions options;
    options.scale = 2;
    (void)destruction.spawn(asset, at(0, 0, 0), options).value();
    bullet.addBall(0.2F, 400, btVector3(-3, 0.1F, 0.1F), btVector3(15, 0, 0));
    for (int i = 0; i < 90; ++i) bullet.step();
    REQUIRE(destruction.bodyCount() > 8);
    std::vector<btTransform> places;
    places.reserve(size_t(bullet.world.getNumCollisionObjects()));
    for (int i = 0; i < bullet.world.getNumCollisionObjects(); ++i)
        places.push_back(bullet.world.getCollisionObjectArray()[i]->getWorldTransform());
    return places;
}

bool same(const std::vector<btTransform>& x, const std::vector<btTransform>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const btTransform& a, const btTransform& b) { return a == b; });
}

}  // namespace

TEST_CASE("advice names what of the game's settings is in the way, and changes none of them") {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    (void)destruction.spawn(makeBox({.size = glm::vec3(4)}), at(0, 0, 0)).value();
    bullet.step();
    CHECK_FALSE(says(destruction, Advice::Code::broadphaseMargin));
    CHECK_FALSE(says(destruction, Advice::Code::contactThreshold));
    CHECK_FALSE(says(destruction, Advice::Code::longSubstep));
    CHECK_FALSE(says(destruction, Advice::Code::fewIterations));
    CHECK_FALSE(says(destruction, Advice::Code::bodiesOutOfWorld));
    CHECK(says(destruction, Advice::Code::allAabbs));
    bullet.world.setForceUpdateAllAabbs(false);
    CHECK_FALSE(says(destruction, Advice::Code::allAabbs));

    const ObjectId small =
        destruction.spawn(makeBox({.size = glm::vec3(0.06F)}), at(9, 0, 0)).value();
    CHECK(says(destruction, Advice::Code::broadphaseMargin));
    CHECK(says(destruction, Advice::Code::contactThreshold));
    bullet.step(1.0F / 20);
    CHECK(says(destruction, Advice::Code::longSubstep));
    auto& solver = bullet.world.getSolverInfo();
    solver.m_numIterations = 4;
    CHECK(says(destruction, Advice::Code::fewIterations));
    solver.m_splitImpulse = 0;
    CHECK(says(destruction, Advice::Code::noSplitImpulse));
    solver.m_solverMode &= ~SOLVER_USE_WARMSTARTING;
    CHECK(says(destruction, Advice::Code::noWarmStarting));
    bullet.world.removeRigidBody(destruction.body(small));
    CHECK(says(destruction, Advice::Code::bodiesOutOfWorld));
    CHECK(solver.m_numIterations == 4);
    CHECK(gDbvtMargin == 0.05F);
    CHECK(gContactBreakingThreshold == 0.02F);
}

TEST_CASE("advice tells when rules ask for sweeping that Bullet does not do") {
    BulletWorld bullet;
    WorldOptions options;
    options.rules.emplace_back().continuous = true;
    DestructionWorld destruction(bullet.world, options);
    CHECK_FALSE(says(destruction, Advice::Code::continuousOff));
    bullet.world.getDispatchInfo().m_useContinuous = false;
    CHECK(says(destruction, Advice::Code::continuousOff));
    const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
    CHECK_FALSE(says(destruction, Advice::Code::continuousCompound));
    AreaDamage corner;
    corner.a = glm::vec3(0.25F);
    corner.radius = 0.3F;
    corner.falloff = 0;
    corner.fluence = INFINITY;
    REQUIRE(destruction.damage(box, corner).value() == 3);
    CHECK(says(destruction, Advice::Code::continuousCompound));
}

TEST_CASE("the game's log hears of what it did to Sherd's bodies") {
    struct Heard {
        std::vector<std::string> lines;
    } heard;
    Hooks mine;
    mine.user = &heard;
    mine.log = [](void* user, LogLevel level, const char* message) {
        if (level == LogLevel::warning) static_cast<Heard*>(user)->lines.emplace_back(message);
    };
    setHooks(mine);
    {
        BulletWorld bullet;
        DestructionWorld destruction(bullet.world);
        const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
        btRigidBody* body = destruction.body(box);
        bullet.world.removeRigidBody(body);
        delete body;
    }
    setHooks({});
    REQUIRE(heard.lines.size() == 1);
    CHECK(heard.lines[0].find("deleted") != std::string::npos);
}

TEST_CASE("the game's assertion handler decides what a mistake of the program does") {
    int asked = 0;
    Hooks mine;
    mine.user = &asked;
    mine.assertFailed = [](void* user, const char* condition, const char* file, int line) {
        ++*static_cast<int*>(user);
        return condition != nullptr && file != nullptr && line > 0;
    };
    setHooks(mine);
    {
        BulletWorld bullet;
        DestructionWorld destruction(bullet.world);
        destruction.afterStep(kStep);  // Bullet drives it
        CHECK(asked == 1);
    }
    setHooks({});
}

TEST_CASE("shapes made by the game's job system are the same, and a spawn makes none") {
    const auto asset = makeBox({.level1 = {4, 4, 4}, .level2 = {2, 2, 2}});
    struct System {
        std::atomic<uint32_t> ran{0};
    } system;
    Jobs jobs;
    jobs.user = &system;
    jobs.run = [](void* user, uint32_t count, void (*job)(void*, uint32_t), void* data) {
        std::atomic<uint32_t> next{0};
        const auto work = [&] {
            for (uint32_t i = next++; i < count; i = next++) {
                job(data, i);
                ++static_cast<System*>(user)->ran;
            }
        };
        std::thread other(work);
        work();
        other.join();
    };
    const PreparedAsset prepared = prepareAsset(asset, 2, jobs).value();
    CHECK(system.ran == (asset->fragmentCount() + 63) / 64);
    CHECK(prepared.asset->scale() == 2);
    BulletWorld bullet;
    DestructionWorld one(bullet.world), two(bullet.world);
    REQUIRE(one.use(prepared).has_value());
    REQUIRE(two.use(prepared).has_value());
    SpawnOptions options;
    options.scale = 2;
    const ObjectId a = one.spawn(asset, at(0, 0, 0), options).value();
    const ObjectId b = two.spawn(asset, at(9, 0, 0), options).value();
    CHECK(one.body(a)->getCollisionShape() == two.body(b)->getCollisionShape());
    CHECK_FALSE(one.use(PreparedAsset{}).has_value());
    CHECK_FALSE(prepareAsset(nullptr).has_value());
    CHECK_FALSE(prepareAsset(asset, -1).has_value());
}

TEST_CASE("two worlds on two threads share an asset while a third thread makes others") {
    const auto asset = makeBox({.level1 = {3, 3, 3}, .level2 = {2, 1, 1}, .toughness = 20});
    const PreparedAsset prepared = prepareAsset(asset, 2).value();
    const std::vector<btTransform> alone = breakOne(asset, prepared);
    std::vector<btTransform> first, second;
    std::thread one([&] { first = breakOne(asset, prepared); });
    std::thread two([&] { second = breakOne(asset, prepared); });
    std::thread loader([&] {
        for (int i = 0; i < 20; ++i) {
            const auto other = makeBox({.level1 = {3, 3, 3}, .toughness = float(1 + i)});
            CHECK(prepareAsset(other, 1 + 0.1F * float(i)).has_value());
            CHECK(prepareAsset(asset, 1 + 0.1F * float(i)).has_value());
        }
    });
    one.join();
    two.join();
    loader.join();
    CHECK(same(first, alone));
    CHECK(same(second, alone));
}

TEST_CASE("a new bake takes the place of whole objects where they are, and leaves broken ones") {
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(-0.5F);
    btRigidBody& games = bullet.add(std::make_unique<btBoxShape>(btVector3(0.5F, 0.5F, 0.5F)), 1000,
                                    btVector3(20, 5, 0), btVector3(0, 0, 0));
    DestructionWorld destruction(bullet.world);
    const auto old = makeBox({.level1 = {2, 2, 2}});
    const auto fresh = makeBox({.level1 = {4, 1, 1}, .density = 2000});
    const auto unrelated = makeBox();
    SpawnOptions flying, large, standing, fixed;
    flying.linearVelocity = {1, 2, 3};
    flying.angularVelocity = {0, 1, 0};
    large.scale = 2;
    standing.anchorToStatic = true;
    fixed.dynamic = false;
    const ObjectId flies = destruction.spawn(old, at(0, 5, 0), flying).value();
    const ObjectId grown = destruction.spawn(old, at(5, 5, 0), large).value();
    const ObjectId stands = destruction.spawn(old, at(10, 0, 0), standing).value();
    const ObjectId hangs = destruction.spawn(old, at(15, 5, 0), fixed).value();
    const ObjectId broken = destruction.spawn(old, at(25, 5, 0)).value();
    const ObjectId pinned = destruction.spawn(old, at(30, 5, 0)).value();
    const ObjectId other = destruction.spawn(unrelated, at(35, 5, 0)).value();
    const ObjectId adopted = destruction.adopt(games, old).value();
    REQUIRE(destruction.anchor(pinned, 0));
    REQUIRE(destruction.breakFragment(broken));
    const btVector3 velocity = destruction.body(flies)->getLinearVelocity();

    const Reload reload = destruction.reload(old, fresh).value();
    CHECK(reload.exchanged == 4);
    REQUIRE(reload.kept.size() == 3);
    CHECK(std::count(reload.kept.begin(), reload.kept.end(), broken) == 1);
    CHECK(std::count(reload.kept.begin(), reload.kept.end(), pinned) == 1);
    CHECK(std::count(reload.kept.begin(), reload.kept.end(), adopted) == 1);
    CHECK(destruction.body(flies)->getMass() == doctest::Approx(2000));
    CHECK((destruction.body(flies)->getLinearVelocity() - velocity).length() < 1e-5F);
    CHECK(destruction.body(grown)->getMass() == doctest::Approx(16000));
    CHECK(destruction.body(stands)->isStaticObject());
    CHECK(destruction.body(hangs)->isStaticObject());
    CHECK(destruction.body(other)->getMass() == doctest::Approx(1000));
    for (const FragmentPose& pose : destruction.poses()) {
        const bool isFresh = pose.object == flies || pose.object == grown ||
                             pose.object == stands || pose.object == hangs;
        CHECK(pose.asset == (isFresh                ? fresh.get()
                             : pose.object == other ? unrelated.get()
                                                    : old.get()));
    }
    bullet.step();
    REQUIRE(destruction.breakFragment(flies));
    CHECK(destruction.bodyCount() == 4 + 8 + 6);
    for (int i = 0; i < 30; ++i) bullet.step();
    CHECK(destruction.poses()[0].pose.translation.y < 5.5F);
    CHECK_FALSE(destruction.reload(nullptr, fresh).has_value());
    CHECK(destruction.reload(old, fresh).value().exchanged == 0);
}

TEST_CASE("shapes of an asset that nothing is of any more are forgotten on demand") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    auto asset = makeBox();
    const std::weak_ptr<const Asset> watch = asset;
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
    asset.reset();
    destruction.trim();
    CHECK_FALSE(watch.expired());
    REQUIRE(destruction.breakFragment(box));
    REQUIRE(destruction.remove(box));
    destruction.trim();
    CHECK(watch.expired());
}
