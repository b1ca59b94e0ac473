// SPDX-License-Identifier: MIT
// The game's constraints on bodies that come apart.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "impact/bullet_world.h"
#include "sherd/runtime/bullet/game_listener.h"

using namespace sherd;
using namespace sherd::test;

namespace {

struct ConstraintListener final : GameListener {
    void onConstraintMoved(btTypedConstraint& constraint, btRigidBody& body) override {
        ++moved;
        last = &constraint;
        to = &body;
    }
    void onConstraintLost(btTypedConstraint& constraint, const char* why) override {
        ++lost;
        last = &constraint;
        CHECK(why != nullptr);
    }
    int moved = 0, lost = 0;
    btTypedConstraint* last = nullptr;
    btRigidBody* to = nullptr;
};

WorldOptions with(ConstraintListener& listener) {
    WorldOptions options;
    options.listener = &listener;
    return options;
}

/// A beam of four pieces along x, 2 m long, each heavier than the one before.
std::shared_ptr<const Asset> beam() {
    FractureSet set = makeBoxFracture({.size = {2, 0.2F, 0.2F}, .level1 = {4, 1, 1}});
    for (uint32_t f = 1; f <= 4; ++f) {
        set.fragments[f].mass *= float(f);
        set.fragments[f].inertiaDiagonal *= float(f);
    }
    set.fragments[0].mass *= 2.5F;
    return Asset::fromFractureSet(std::move(set)).value();
}

btTransform shifted(const btVector3& place) {
    return btTransform(btMatrix3x3::getIdentity(), place);
}

using Make = std::function<std::unique_ptr<btTypedConstraint>(btRigidBody& body,
                                                              const btVector3& pivotInBody)>;

struct Hung {
    btVector3 end;  ///< where the held end of the beam is, 1.5 s after it broke
    float others;   ///< height of the others' highest
    ConstraintListener listener;
};

/// Hangs the beam up by its end at x = `side`, breaks it all, and lets it swing.
template <class Check>
Hung hang(const Make& make, float side, const Check& check) {
    BulletWorld bullet(btVector3(0, -10, 0));
    Hung hung;
    DestructionWorld destruction(bullet.world, with(hung.listener));
    const auto asset = beam();
    const ObjectId object = destruction.spawn(asset, at(0, 0, 0)).value();
    btRigidBody& body = *destruction.body(object);
    const btVector3 pivot(side, 0, 0);
    const auto constraint = make(body, body.getWorldTransform().inverse() * pivot);
    bullet.world.addConstraint(constraint.get(), true);
    for (int i = 0; i < 3; ++i) bullet.step();
    REQUIRE(destruction.breakAll(object));
    CHECK(bullet.world.getNumConstraints() == 1);
    check(*constraint);
    for (int i = 0; i < 90; ++i) bullet.step();
    const uint32_t holder = side < 0 ? 1 : 4;
    hung.others = -HUGE_VALF;
    for (const FragmentPose& pose : destruction.poses()) {
        const glm::vec3 end = pose.pose.translation + pose.pose.rotation * glm::vec3(side, 0, 0);
        if (pose.fragment == holder) {
            hung.end = btVector3(end.x, end.y, end.z);
        } else {
            hung.others = std::max(hung.others, pose.pose.translation.y);
        }
    }
    CHECK(destruction.body(object, holder)->getNumConstraintRefs() == 1);
    bullet.world.removeConstraint(constraint.get());
    return hung;
}

}  // namespace

TEST_CASE(
    "a constraint holds the piece its pivot is on, the largest or another, and stays itself") {
    struct Kind {
        const char* name;
        Make make;
    };
    const std::vector<Kind> kinds{
        {"point to point",
         [](btRigidBody& body, const btVector3& pivot) {
             auto c = std::make_unique<btPoint2PointConstraint>(body, pivot);
             c->m_setting.m_impulseClamp = 1e6F;
             return c;
         }},
        {"hinge",
         [](btRigidBody& body, const btVector3& pivot) {
             auto c = std::make_unique<btHingeConstraint>(body, pivot, btVector3(0, 0, 1));
             c->setLimit(-2, 2);
             return c;
         }},
        {"six degrees",
         [](btRigidBody& body, const btVector3& pivot) {
             auto c = std::make_unique<btGeneric6DofConstraint>(body, shifted(pivot), false);
             c->setAngularLowerLimit(btVector3(-1, -1, -2));
             c->setAngularUpperLimit(btVector3(1, 1, 2));
             return c;
         }},
        {"six degrees with springs",
         [](btRigidBody& body, const btVector3& pivot) {
             auto c = std::make_unique<btGeneric6DofSpring2Constraint>(body, shifted(pivot));
             c->setAngularLowerLimit(btVector3(-1, -1, -2));
             c->setAngularUpperLimit(btVector3(1, 1, 2));
             c->setParam(BT_CONSTRAINT_STOP_ERP, 0.5F, 0);
             return c;
         }},
        {"slider that does not slide",
         [](btRigidBody& body, const btVector3& pivot) {
             auto c = std::make_unique<btSliderConstraint>(body, shifted(pivot), true);
             c->setLowerLinLimit(0);
             c->setUpperLinLimit(0);
             c->setLowerAngLimit(-1);
             c->setUpperAngLimit(1);
             c->setDampingOrthoAng(0.75F);
             c->setTargetAngMotorVelocity(0.5F);
             c->setParam(BT_CONSTRAINT_STOP_CFM, 1e-6F, 3);
             return c;
         }},
        {"cone twist",
         [](btRigidBody& body, const btVector3& pivot) {
             // Alone, Bullet would hang it from the middle of the world.
             auto c = std::make_unique<btConeTwistConstraint>(
                 body, btTypedConstraint::getFixedBody(), shifted(pivot),
                 shifted(body.getWorldTransform() * pivot));
             c->setLimit(1.5F, 1.25F, 0.5F, 0.875F, 0.25F, 0.75F);
             c->setMaxMotorImpulseNormalized(0.125F);
             c->setParam(BT_CONSTRAINT_CFM, 1e-6F, 0);
             return c;
         }},
        {"cone twist without a motor",
         [](btRigidBody& body, const btVector3& pivot) {
             return std::make_unique<btConeTwistConstraint>(
                 body, btTypedConstraint::getFixedBody(), shifted(pivot),
                 shifted(body.getWorldTransform() * pivot));
         }},
        {"fixed",
         [](btRigidBody& body, const btVector3& pivot) {
             return std::make_unique<btFixedConstraint>(body, btTypedConstraint::getFixedBody(),
                                                        shifted(pivot),
                                                        shifted(body.getWorldTransform() * pivot));
         }},
    };
    for (const Kind& kind : kinds) {
        for (const float side : {-1.0F, 1.0F}) {
            CAPTURE(kind.name);
            CAPTURE(side);
            static int user = 0;
            const Make made = [&kind](btRigidBody& body, const btVector3& pivot) {
                auto c = kind.make(body, pivot);
                c->setBreakingImpulseThreshold(12345);
                c->setUserConstraintPtr(&user);
                c->setOverrideNumSolverIterations(33);
                return c;
            };
            const Hung hung = hang(made, side, [&](btTypedConstraint& c) {
                CHECK(c.getBreakingImpulseThreshold() == 12345);
                CHECK(c.getUserConstraintPtr() == &user);
                CHECK(c.getOverrideNumSolverIterations() == 33);
                CHECK(c.isEnabled());
                if (c.getConstraintType() == HINGE_CONSTRAINT_TYPE) {
                    CHECK(static_cast<btHingeConstraint&>(c).getLowerLimit() == -2);
                    CHECK(static_cast<btHingeConstraint&>(c).getUpperLimit() == 2);
                }
                if (c.getConstraintType() == SLIDER_CONSTRAINT_TYPE) {
                    auto& slider = static_cast<btSliderConstraint&>(c);
                    CHECK(slider.getLowerAngLimit() == -1);
                    CHECK(slider.getUpperLinLimit() == 0);
                    CHECK(slider.getDampingOrthoAng() == 0.75F);
                    CHECK(slider.getTargetAngMotorVelocity() == 0.5F);
                    CHECK(slider.getFlags() == BT_SLIDER_FLAGS_CFM_LIMANG);
                    CHECK(slider.getParam(BT_CONSTRAINT_STOP_CFM, 3) == 1e-6F);
                }
                if (std::string(kind.name) == "cone twist") {
                    auto& cone = static_cast<btConeTwistConstraint&>(c);
                    CHECK(cone.getSwingSpan1() == 1.5F);
                    CHECK(cone.getSwingSpan2() == 1.25F);
                    CHECK(cone.getTwistSpan() == 0.5F);
                    CHECK(cone.getRelaxationFactor() == 0.75F);
                    CHECK(cone.isMaxMotorImpulseNormalized());
                    CHECK(cone.getMaxMotorImpulse() == 0.125F);
                    CHECK(cone.getFlags() == BT_CONETWIST_FLAGS_LIN_CFM);
                }
                if (c.getConstraintType() == POINT2POINT_CONSTRAINT_TYPE)
                    CHECK(static_cast<btPoint2PointConstraint&>(c).m_setting.m_impulseClamp ==
                          1e6F);
            });
            // The heaviest keeps the body, and so the constraint as it was.
            CHECK(hung.listener.moved == (side < 0 ? 1 : 0));
            CHECK(hung.listener.lost == 0);
            CHECK((hung.end - btVector3(side, 0, 0)).length() < 0.05F);
            CHECK(hung.others < -5);
        }
    }
}

TEST_CASE("a constraint of a kind that cannot move is taken out and reported, unless it need not") {
    for (const float side : {-1.0F, 1.0F}) {
        CAPTURE(side);
        BulletWorld bullet;
        ConstraintListener listener;
        DestructionWorld destruction(bullet.world, with(listener));
        const ObjectId object = destruction.spawn(beam(), at(0, 0, 0)).value();
        btRigidBody& body = *destruction.body(object);
        const btVector3 pivot = body.getWorldTransform().inverse() * btVector3(side, 0, 0);
        // One whose springs nobody can read.
        btGeneric6DofSpringConstraint spring(body, shifted(pivot), true);
        bullet.world.addConstraint(&spring);
        REQUIRE(destruction.breakAll(object));
        CHECK(listener.lost == (side < 0 ? 1 : 0));
        CHECK(bullet.world.getNumConstraints() == (side < 0 ? 0 : 1));
        for (int i = 0; i < 30; ++i) bullet.step();
        if (side > 0) bullet.world.removeConstraint(&spring);
    }
}

TEST_CASE(
    "a constraint between two objects follows when either breaks, and when an adopted one does") {
    BulletWorld bullet(btVector3(0, -10, 0));
    ConstraintListener listener;
    DestructionWorld destruction(bullet.world, with(listener));
    btRigidBody& games = bullet.add(std::make_unique<btBoxShape>(btVector3(1, 0.1F, 0.1F)), 200,
                                    btVector3(0, 0, 0), btVector3(0, 0, 0));
    const auto asset = beam();
    AdoptOptions options;
    // The beam's middle of mass is off its middle; the game's body is not as exact.
    const ObjectId left = destruction.adopt(games, asset, options).value();
    SpawnOptions fixed;
    fixed.dynamic = false;
    const ObjectId right = destruction.spawn(asset, at(2.02F, 0, 0), fixed).value();
    REQUIRE(destruction.anchor(right, 0));
    btRigidBody& other = *destruction.body(right);
    const btVector3 pivot(1.01F, 0, 0);
    btPoint2PointConstraint joint(games, other, games.getWorldTransform().inverse() * pivot,
                                  other.getWorldTransform().inverse() * pivot);
    bullet.world.addConstraint(&joint, true);
    REQUIRE(destruction.breakAll(left));
    CHECK(listener.moved == 1);
    CHECK(&joint.getRigidBodyA() == destruction.body(left, 4));
    CHECK(games.getNumConstraintRefs() == 0);
    REQUIRE(destruction.breakAll(right));
    CHECK(listener.lost == 0);
    CHECK(&joint.getRigidBodyB() == destruction.body(right, 1));
    for (int i = 0; i < 60; ++i) bullet.step();
    const btVector3 a = joint.getRigidBodyA().getWorldTransform() * joint.getPivotInA();
    const btVector3 b = joint.getRigidBodyB().getWorldTransform() * joint.getPivotInB();
    CHECK((a - b).length() < 0.02F);
    CHECK((a - pivot).length() < 0.02F);
    bullet.world.removeConstraint(&joint);
}
