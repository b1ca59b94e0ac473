// SPDX-License-Identifier: MIT
// Bodies that are the game's: adopted, taken away, deleted.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <vector>

#include "impact/bullet_world.h"
#include "sherd/runtime/bullet/game_listener.h"
#include "sherd/runtime/hooks.h"

using namespace sherd;
using namespace sherd::test;

namespace {

struct Listener final : GameListener {
    void onReplace(btRigidBody& body, std::span<btRigidBody* const> islands) override {
        ++replaced;
        old = &body;
        wasInWorld = body.isInWorld();
        parts.assign(islands.begin(), islands.end());
        if (deletes) {
            world->removeRigidBody(&body);
            delete &body;
        }
    }
    void onBodyGone(ObjectId object) override {
        ++gone;
        lost = object;
    }
    int replaced = 0, gone = 0;
    btRigidBody* old = nullptr;
    bool wasInWorld = false, deletes = false;
    btDynamicsWorld* world = nullptr;
    std::vector<btRigidBody*> parts;
    ObjectId lost;
};

/// A body of the game's own, on the heap by itself, of the box that `makeBox` makes.
class GamesBody {
  public:
    explicit GamesBody(btDynamicsWorld& world, float mass = 1000,
                       const btVector3& place = {0, 0, 0}, const btVector3& velocity = {0, 0, 0})
        : world_(world), shape_(btVector3(0.5F, 0.5F, 0.5F)) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) shape_.calculateLocalInertia(mass, inertia);
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape_, inertia);
        info.m_startWorldTransform.setOrigin(place);
        body = new btRigidBody(info);
        body->setLinearVelocity(velocity);
        body->setUserIndex3(77);
        world_.addRigidBody(body);
    }
    ~GamesBody() { drop(); }
    GamesBody(const GamesBody&) = delete;
    GamesBody& operator=(const GamesBody&) = delete;
    void drop() {
        if (!body) return;
        if (body->isInWorld()) world_.removeRigidBody(body);
        delete body;
        body = nullptr;
    }
    btRigidBody* body = nullptr;

  private:
    btDynamicsWorld& world_;
    btBoxShape shape_;
};

WorldOptions with(Listener& listener) {
    WorldOptions options;
    options.listener = &listener;
    return options;
}

}  // namespace

TEST_CASE("an adopted body moves to the bit as if nobody had adopted it, and its object with it") {
    const auto run = [](bool adopts) {
        BulletWorld bullet(btVector3(0, -10, 0));
        bullet.addGround(-3);
        GamesBody games(bullet.world, 1000, btVector3(0, 0, 0), btVector3(1, 0, 0));
        games.body->setAngularVelocity(btVector3(0, 0, 2));
        DestructionWorld destruction(bullet.world, unbreakable());
        // Its object frame is at its lower corner.
        AdoptOptions options;
        options.objectToBody.translation = {-0.5F, -0.5F, -0.5F};
        const auto asset = makeBox({.center = glm::vec3(0.5F)});
        if (adopts) REQUIRE(destruction.adopt(*games.body, asset, options).has_value());
        for (int i = 0; i < 90; ++i) bullet.step();
        if (adopts) {
            REQUIRE(destruction.poses().size() == 1);
            const RigidPose& pose = destruction.poses()[0].pose;
            const glm::vec3 middle = pose.translation + pose.rotation * glm::vec3(0.5F);
            const btVector3& place = games.body->getCenterOfMassPosition();
            CHECK(glm::length(middle - glm::vec3(place.x(), place.y(), place.z())) < 1e-5F);
        }
        return games.body->getWorldTransform();
    };
    CHECK(run(true) == run(false));
}

TEST_CASE("what comes off an adopted body has its motion, and the body is the game's alone again") {
    BulletWorld bullet;
    Listener listener;
    GamesBody games(bullet.world, 1000, btVector3(1, 2, 3), btVector3(4, 0, 0));
    games.body->setAngularVelocity(btVector3(0, 3, 0));
    DestructionWorld destruction(bullet.world, with(listener));
    const auto asset = makeBox();
    const ObjectId box = destruction.adopt(*games.body, asset).value();
    CHECK(destruction.body(box) == games.body);
    CHECK(destruction.find(*games.body)->object == box);
    const Totals before = totals(bullet.world);
    REQUIRE(destruction.breakFragment(box));
    CHECK(listener.replaced == 1);
    CHECK(listener.old == games.body);
    CHECK(listener.wasInWorld);
    CHECK(listener.parts.size() == 8);
    CHECK_FALSE(games.body->isInWorld());
    CHECK(games.body->getUserIndex3() == 77);
    CHECK_FALSE(destruction.find(*games.body).has_value());
    const Totals after = totals(bullet.world);
    CHECK((after.momentum - before.momentum).length() <= 1e-5 * before.momentumScale);
    CHECK((after.angularMomentum - before.angularMomentum).length() <= 1e-5 * before.angularScale);
    CHECK(after.energy == doctest::Approx(before.energy).epsilon(1e-5));
    bullet.step();
    CHECK(destruction.poses().size() == 8);
}

TEST_CASE("what comes off an adopted body is as heavy as the game has the body") {
    BulletWorld bullet;
    GamesBody games(bullet.world, 250, btVector3(0, 0, 0), btVector3(4, 0, 0));
    games.body->setAngularVelocity(btVector3(0, 3, 0));
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();  // of 1000 kg
    const ObjectId box = destruction.adopt(*games.body, asset).value();
    const Totals before = totals(bullet.world);
    REQUIRE(destruction.breakFragment(box));
    CHECK(destruction.body(box, 1)->getMass() == doctest::Approx(250.0 / 8));
    const Totals after = totals(bullet.world);
    CHECK((after.momentum - before.momentum).length() <= 1e-5 * before.momentumScale);
    CHECK((after.angularMomentum - before.angularMomentum).length() <= 1e-5 * before.angularScale);
    CHECK(destruction.poses()[0].asset == asset.get());
}

TEST_CASE("an adopted body breaks under a hit, and its pieces collide as it did") {
    for (const bool deletes : {false, true}) {
        CAPTURE(deletes);
        BulletWorld bullet;
        Listener listener;
        listener.deletes = deletes;
        listener.world = &bullet.world;
        GamesBody games(bullet.world);
        bullet.world.removeRigidBody(games.body);
        bullet.world.addRigidBody(games.body, 128, -1);
        DestructionWorld destruction(bullet.world, with(listener));
        const ObjectId box = destruction.adopt(*games.body, makeBox()).value();
        if (deletes) games.body = nullptr;
        bullet.addBall(0.2F, 50, btVector3(-2, 0.1F, 0.1F), btVector3(10, 0, 0));
        const Totals before = totals(bullet.world);
        std::vector<BreakEvent> events;
        REQUIRE(stepUntilBreak(bullet, destruction, 60, &events));
        CHECK(events[0].energy > 1000);
        const Totals after = totals(bullet.world);
        CHECK((after.momentum - before.momentum).length() <= 1e-4 * before.momentumScale);
        CHECK(after.energy <= before.energy - double(events[0].consumed) + 1e-3 * before.energy);
        CHECK(listener.replaced == 1);
        CHECK(destruction.bodyCount() == 8);
        CHECK(destruction.body(box, 1)->getBroadphaseProxy()->m_collisionFilterGroup == 128);
        for (int i = 0; i < 30; ++i) bullet.step();
    }
}

TEST_CASE("a listener may look at the world that calls it, and is kept from changing it") {
    struct Meddler final : GameListener {
        void onReplace(btRigidBody&, std::span<btRigidBody* const>) override {
            CHECK(destruction->body(object, 1) != nullptr);
            CHECK_FALSE(destruction->remove(object));
            CHECK_FALSE(destruction->breakAll(object));
            CHECK_FALSE(destruction->spawn(asset, at(9, 9, 9)).has_value());
            ++called;
        }
        DestructionWorld* destruction = nullptr;
        ObjectId object;
        std::shared_ptr<const Asset> asset;
        int called = 0;
    } meddler;
    int asserted = 0;
    Hooks mine;
    mine.user = &asserted;
    mine.assertFailed = [](void* user, const char*, const char*, int) {
        ++*static_cast<int*>(user);
        return true;
    };
    setHooks(mine);
    BulletWorld bullet;
    GamesBody games(bullet.world);
    WorldOptions options;
    options.listener = &meddler;
    DestructionWorld destruction(bullet.world, options);
    meddler.destruction = &destruction;
    meddler.asset = makeBox();
    meddler.object = destruction.adopt(*games.body, meddler.asset).value();
    REQUIRE(destruction.breakFragment(meddler.object));
    setHooks({});
    CHECK(meddler.called == 1);
    CHECK(asserted == 3);
    CHECK(destruction.bodyCount() == 8);
}

TEST_CASE("a static body of the game may be adopted, and stands until something comes off") {
    BulletWorld bullet(btVector3(0, -10, 0));
    Listener listener;
    GamesBody games(bullet.world, 0);
    DestructionWorld destruction(bullet.world, with(listener));
    const ObjectId box = destruction.adopt(*games.body, makeBox()).value();
    for (int i = 0; i < 10; ++i) bullet.step();
    CHECK(destruction.poses()[0].pose.translation.y == 0);
    REQUIRE(destruction.breakFragment(box));
    for (int i = 0; i < 30; ++i) bullet.step();
    CHECK(destruction.poses()[0].pose.translation.y < -0.5F);
    // As Bullet has it for moving bodies, not for fixed ones.
    CHECK(destruction.body(box, 1)->getBroadphaseProxy()->m_collisionFilterGroup ==
          btBroadphaseProxy::DefaultFilter);
}

TEST_CASE("an adopted body that the game deletes is noticed, and never looked at again") {
    BulletWorld bullet;
    Listener listener;
    GamesBody games(bullet.world), other(bullet.world, 1000, btVector3(5, 0, 0));
    DestructionWorld destruction(bullet.world, with(listener));
    const auto asset = makeBox();
    const ObjectId box = destruction.adopt(*games.body, asset).value();
    const ObjectId kept = destruction.adopt(*other.body, asset).value();
    const auto notices = [&](const auto& call) {
        GamesBody brief(bullet.world, 1000, btVector3(-5, 0, 0));
        const ObjectId object = destruction.adopt(*brief.body, asset).value();
        brief.drop();
        call(object);
        CHECK_FALSE(destruction.isAlive(object));
        CHECK(listener.lost == object);
    };
    notices([&](ObjectId) { bullet.step(); });
    notices([&](ObjectId object) { CHECK(destruction.body(object) == nullptr); });
    notices([&](ObjectId object) { CHECK_FALSE(destruction.breakAll(object)); });
    notices([&](ObjectId object) { CHECK_FALSE(destruction.remove(object)); });
    notices([&](ObjectId object) { CHECK(destruction.save(object).empty()); });
    notices([&](ObjectId) {
        AreaDamage damage;
        damage.a = {-5, 0, 0};
        damage.radius = 2;
        damage.fluence = 1e9F;
        CHECK(destruction.explode(damage, 10).value() == 0);
    });
    CHECK(listener.gone == 6);
    games.drop();
    bullet.step();
    CHECK_FALSE(destruction.isAlive(box));
    CHECK(destruction.isAlive(kept));
    CHECK(destruction.bodyCount() == 1);
    CHECK(destruction.poses().size() == 1);
}

TEST_CASE("a new body in the memory of an adopted one is not taken for it") {
    BulletWorld bullet;
    btBoxShape shape(btVector3(0.5F, 0.5F, 0.5F));
    const btRigidBody::btRigidBodyConstructionInfo info(1000, nullptr, &shape, btVector3(1, 1, 1));
    alignas(64) static std::byte memory[sizeof(btRigidBody)];
    auto* body = new (static_cast<void*>(memory)) btRigidBody(info);
    bullet.world.addRigidBody(body);
    DestructionWorld destruction(bullet.world);
    const ObjectId box = destruction.adopt(*body, makeBox()).value();
    bullet.world.removeRigidBody(body);
    body->~btRigidBody();
    body = new (static_cast<void*>(memory)) btRigidBody(info);
    bullet.world.addRigidBody(body);
    bullet.step();
    CHECK_FALSE(destruction.isAlive(box));
    CHECK_FALSE(destruction.find(*body).has_value());
    bullet.world.removeRigidBody(body);
    body->~btRigidBody();
}

TEST_CASE("removing an adopted object gives the body back, and so does the end of it all") {
    BulletWorld bullet;
    GamesBody games(bullet.world);
    {
        DestructionWorld destruction(bullet.world);
        const ObjectId box = destruction.adopt(*games.body, makeBox()).value();
        CHECK(destruction.remove(box));
        CHECK(games.body->isInWorld());
        CHECK(games.body->getUserIndex3() == 77);
        CHECK(destruction.adopt(*games.body, makeBox()).has_value());
    }
    CHECK(games.body->isInWorld());
    CHECK(games.body->getUserIndex3() == 77);
    bullet.step();
}

TEST_CASE("what cannot be adopted is refused") {
    BulletWorld bullet;
    GamesBody games(bullet.world);
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    const ObjectId own = destruction.spawn(asset, at(3, 0, 0)).value();
    CHECK_FALSE(destruction.adopt(*destruction.body(own), asset).has_value());
    CHECK_FALSE(destruction.adopt(*games.body, nullptr).has_value());
    AdoptOptions options;
    options.scale = -1;
    CHECK_FALSE(destruction.adopt(*games.body, asset, options).has_value());
    options = {};
    options.objectToBody.rotation = glm::quat(0, 0, 0, 0);
    CHECK_FALSE(destruction.adopt(*games.body, asset, options).has_value());
    bullet.world.removeRigidBody(games.body);
    CHECK_FALSE(destruction.adopt(*games.body, asset).has_value());
    bullet.world.addRigidBody(games.body);
    CHECK(destruction.adopt(*games.body, asset).has_value());
    CHECK_FALSE(destruction.adopt(*games.body, asset).has_value());
    CHECK(destruction.bodyCount() == 2);
}

TEST_CASE("an adopted object is saved and restored as any other") {
    BulletWorld bullet;
    Listener listener;
    GamesBody games(bullet.world, 1000, btVector3(1, 2, 3), btVector3(4, 0, 0));
    GamesBody twin(bullet.world, 1000, btVector3(9, 2, 3));
    DestructionWorld destruction(bullet.world, with(listener));
    AdoptOptions options;
    options.objectToBody.translation = {-0.5F, -0.5F, -0.5F};
    const auto asset = makeBox({.center = glm::vec3(0.5F)});
    const ObjectId box = destruction.adopt(*games.body, asset, options).value();
    const ObjectId other = destruction.adopt(*twin.body, asset, options).value();
    REQUIRE(destruction.restore(other, destruction.save(box)).has_value());
    CHECK(listener.replaced == 1);
    CHECK_FALSE(twin.body->isInWorld());
    const btRigidBody& body = *destruction.body(other);
    CHECK((body.getCenterOfMassPosition() - btVector3(1, 2, 3)).length() < 1e-5F);
    CHECK(body.getLinearVelocity().x() == 4);
    CHECK(body.getMass() == doctest::Approx(1000));
}

TEST_CASE("a body of Sherd's that the game deletes is noticed, and what it stood for is gone") {
    BulletWorld bullet;
    Listener listener;
    {
        DestructionWorld destruction(bullet.world, with(listener));
        const auto asset = makeBox({.hullGrowth = 0.02F});
        const ObjectId box = destruction.spawn(asset, at(0, 0, 0)).value();
        REQUIRE(destruction.breakFragment(box));
        CHECK(destruction.ignoredPairCount() > 0);
        for (uint32_t f = 1; f <= 8; ++f) {
            btRigidBody* body = destruction.body(box, f);
            bullet.world.removeRigidBody(body);
            delete body;
            CHECK(destruction.body(box, f) == nullptr);
            CHECK(destruction.bodyCount() == 8 - f);
            CHECK(destruction.poses().size() == 8 - f);
            CHECK(destruction.isAlive(box) == (f < 8));
            bullet.step();
        }
        CHECK(listener.gone == 8);
        CHECK(destruction.ignoredPairCount() == 0);
        // As games end: all that is in the world.
        (void)destruction.spawn(asset, at(0, 0, 0)).value();
        while (bullet.world.getNumCollisionObjects() > 0) {
            btCollisionObject* object = bullet.world.getCollisionObjectArray()[0];
            bullet.world.removeCollisionObject(object);
            delete object;
        }
        CHECK(destruction.bodyCount() == 0);
    }
    CHECK(bullet.world.getNumCollisionObjects() == 0);
}

TEST_CASE("what takes the number of a body that the game has deleted takes nothing else of it") {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    const auto isAt = [&](ObjectId object, float x) {
        const auto poses = destruction.poses();
        const auto found = std::find_if(poses.begin(), poses.end(),
                                        [&](const auto& pose) { return pose.object == object; });
        REQUIRE(found != poses.end());
        CHECK(found->pose.translation.x == x);
        CHECK(found->previous.translation.x == x);
        return true;
    };
    // Nobody asks for poses meanwhile.
    ObjectId object = destruction.spawn(asset, at(0, 5, 0)).value();
    for (int i = 0; i < 3; ++i) bullet.step();
    btRigidBody* body = destruction.body(object);
    bullet.world.removeRigidBody(body);
    delete body;
    object = destruction.spawn(asset, at(100, 0, 0)).value();
    CHECK(destruction.body(object)->getWorldTransform().getOrigin().x() == 100);
    CHECK(isAt(object, 100));
    REQUIRE(destruction.remove(object));

    GamesBody first(bullet.world, 1000, btVector3(50, 0, 0));
    (void)destruction.adopt(*first.body, asset).value();
    for (int i = 0; i < 3; ++i) bullet.step();
    first.drop();
    GamesBody next(bullet.world, 1000, btVector3(70, 0, 0));
    object = destruction.adopt(*next.body, asset).value();
    CHECK(isAt(object, 70));
    REQUIRE(destruction.remove(object));

    // Two pieces that hang together have a shape of their own.
    const auto row = makeBox({.level1 = {3, 1, 1}});
    for (int i = 0; i < 2; ++i) {
        object = destruction.spawn(row, at(0, 0, 10.0F * float(i))).value();
        CHECK(destruction.find(*destruction.body(object), 0)->fragment == 0);
        AreaDamage cut;
        cut.a = {i == 0 ? -0.17F : 0.17F, 0, 10.0F * float(i)};
        cut.radius = 0.1F;
        cut.fluence = 1e9F;
        REQUIRE(destruction.damage(object, cut).value() == 1);
        body = destruction.body(object, 2);
        REQUIRE(body == destruction.body(object, i == 0 ? 3 : 1));
        CHECK(destruction.find(*body, 0)->fragment == (i == 0 ? 2 : 1));
        btVector3 low, high;
        body->getAabb(low, high);
        CHECK((high.x() + low.x()) * (i == 0 ? 1.0F : -1.0F) > 0.2F);
        for (uint32_t f = 1; i == 0 && f <= 3; ++f) {
            body = destruction.body(object, f);
            if (!body) continue;
            bullet.world.removeRigidBody(body);
            delete body;
        }
    }
}

TEST_CASE("a world ends quietly after the game has deleted an adopted body") {
    BulletWorld bullet;
    Listener listener;
    GamesBody games(bullet.world), kept(bullet.world, 1000, btVector3(5, 0, 0));
    {
        DestructionWorld destruction(bullet.world, with(listener));
        const auto asset = makeBox();
        (void)destruction.adopt(*games.body, asset).value();
        (void)destruction.adopt(*kept.body, asset).value();
        bullet.step();
        games.drop();
    }
    CHECK(listener.gone == 0);  // there is no world any more that could be asked
    CHECK(kept.body->getUserIndex3() == 77);
    CHECK(kept.body->isInWorld());
}

TEST_CASE("a body of Sherd's that the game takes out may break meanwhile, and come in again") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId box = destruction.spawn(makeBox(), at(0, 0, 0)).value();
    btRigidBody* body = destruction.body(box);
    bullet.world.removeRigidBody(body);
    for (int i = 0; i < 3; ++i) bullet.step();
    CHECK(destruction.isAlive(box));
    bullet.world.addRigidBody(body);
    bullet.step();
    bullet.world.removeRigidBody(body);
    REQUIRE(destruction.breakFragment(box));
    bullet.step();
    CHECK(destruction.bodyCount() == 8);
    CHECK(destruction.remove(box));
    CHECK(bullet.world.getNumCollisionObjects() == 0);
}
