// SPDX-License-Identifier: MIT
// What stands on the ground without a bond left.
#include <doctest/doctest.h>

#include <algorithm>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

const BoxFracture kWall{.size = {4, 2, 0.4F}, .level1 = {8, 8, 1}, .density = 2000};
const BoxFracture kColumn{.size = {0.6F, 3, 0.6F}, .level1 = {2, 8, 2}, .density = 2000};

float largest(const BoxFracture& recipe) {
    return std::max({recipe.size.x, recipe.size.y, recipe.size.z});
}

/// An object on the ground whose bonds are all broken.
class LooseStack {
  public:
    LooseStack(const BoxFracture& recipe, float side, bool asleep)
        : asset_(makeBox(recipe)), side_(side), scale_(side / largest(recipe)) {
        bullet.addGround(0);
        destruction = std::make_unique<DestructionWorld>(bullet.world);
        SpawnOptions spawn;
        spawn.releaseAsleep = asleep;
        spawn.scale = scale_;
        place_ = {0, scale_ * recipe.size.y / 2, 0};
        object = destruction->spawn(asset_, at(place_.x, place_.y, place_.z), spawn).value();
        REQUIRE(destruction->breakAll(object));
        REQUIRE(destruction->bodyCount() == asset_->fragmentCount() - 1);
    }

    /// How far any piece is from where it stood, of the object's largest side.
    float sway() const {
        float most = 0;
        for (const FragmentPose& pose : destruction->poses()) {
            const glm::vec3 center = scale_ * asset_->fragment(pose.fragment).centerOfMass;
            const glm::vec3 now = pose.pose.translation + pose.pose.rotation * center;
            most = std::max(most, glm::length(now - place_ - center) / side_);
        }
        return most;
    }
    float swayIn(float seconds, float rate) {
        float most = 0;
        for (int i = 0; i < int(seconds * rate); ++i) {
            bullet.step(1 / rate);
            most = std::max(most, sway());
        }
        return most;
    }

    BulletWorld bullet{btVector3(0, -10, 0)};
    std::unique_ptr<DestructionWorld> destruction;
    ObjectId object;

  private:
    std::shared_ptr<const Asset> asset_;
    float side_, scale_;
    glm::vec3 place_{0.0F};
};

}  // namespace

// Smaller stacks Bullet does not hold up at these rates, whoever makes them: with 10 iterations
// bricks of 25 cm need 120 steps a second.
TEST_CASE("a wall and a column whose bonds are all broken stand for 5 s within 1 % of their size") {
    for (const BoxFracture& recipe : {kWall, kColumn}) {
        CAPTURE(recipe.size.x);
        CHECK(LooseStack(recipe, 4, false).swayIn(5, 120) < 0.01F);
        CHECK(LooseStack(recipe, 16, false).swayIn(5, 60) < 0.01F);
        CHECK(LooseStack(recipe, 50, false).swayIn(5, 60) < 0.01F);
    }
}

TEST_CASE("from 5 cm to 50 m, what is released asleep stands as it was, and wakes when touched") {
    for (const BoxFracture& recipe : {kWall, kColumn}) {
        for (const float side : {0.05F, 0.2F, 1.0F, 8.0F, 50.0F}) {
            CAPTURE(recipe.size.x);
            CAPTURE(side);
            LooseStack stack(recipe, side, true);
            CHECK(stack.swayIn(5, 60) < 1e-6F);
            const float speed = 4 * std::sqrt(10 * side);
            stack.bullet.addBall(0.1F * side, 2000 * side * side * side,
                                 btVector3(0, 0.3F * side, 0.5F * side), btVector3(0, 0, -speed));
            CHECK(stack.swayIn(2, 120) > 0.02F);
        }
    }
}

TEST_CASE("a frozen piece stops where it is, and goes on when something touches it") {
    BulletWorld bullet(btVector3(0, -10, 0));
    DestructionWorld destruction(bullet.world);
    const auto asset = makeBox();
    SpawnOptions thrown;
    thrown.linearVelocity = {3, 5, 0};
    const ObjectId box = destruction.spawn(asset, at(0, 0, 0), thrown).value();
    for (int i = 0; i < 10; ++i) bullet.step();
    REQUIRE(destruction.breakFragment(box));
    REQUIRE(destruction.freeze(box, 1));
    CHECK_FALSE(destruction.freeze(box, 0));
    for (uint32_t f = 2; f <= 8; ++f) destruction.body(box, f)->translate(btVector3(50, 0, 0));
    const btTransform place = destruction.body(box, 1)->getWorldTransform();
    for (int i = 0; i < 30; ++i) bullet.step();
    CHECK(destruction.body(box, 1)->getWorldTransform() == place);
    bullet.addBall(0.2F, 5, place.getOrigin() + btVector3(0, 2, 0), btVector3(0, -5, 0));
    for (int i = 0; i < 60; ++i) bullet.step();
    CHECK(destruction.body(box, 1)->getCenterOfMassPosition().y() < place.getOrigin().y() - 1);
}
