// SPDX-License-Identifier: MIT
// What is no rigid body may strike, too.
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <doctest/doctest.h>

#include <cmath>

#include "impact/bullet_world.h"

using namespace sherd;
using namespace sherd::test;

namespace {

bool isSound(const btDynamicsWorld& world) {
    const btCollisionObjectArray& all = world.getCollisionObjectArray();
    for (int i = 0; i < all.size(); ++i)
        if (!std::isfinite(all[i]->getWorldTransform().getOrigin().length2())) return false;
    return true;
}

}  // namespace

TEST_CASE(
    "a multibody may strike an object, whole, broken or fixed, and no more happens than a hit") {
    for (const bool fixed : {false, true}) {
        for (const bool broken : {false, true}) {
            CAPTURE(fixed);
            CAPTURE(broken);
            btDefaultCollisionConfiguration configuration;
            btCollisionDispatcher dispatcher(&configuration);
            btDbvtBroadphase broadphase;
            btMultiBodyConstraintSolver solver;
            btMultiBodyDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
            world.setGravity(btVector3(0, 0, 0));
            btBoxShape base(btVector3(0.2F, 0.2F, 0.2F));
            btSphereShape link(0.15F);
            btMultiBody arm(1, 50, btVector3(1, 1, 1), false, false);
            arm.setupSpherical(0, 5, btVector3(0.1F, 0.1F, 0.1F), -1, btQuaternion::getIdentity(),
                               btVector3(0.3F, 0, 0), btVector3(0.2F, 0, 0), false);
            arm.finalizeMultiDof();
            arm.setBasePos(btVector3(-2, 0.1F, 0.1F));
            arm.setBaseVel(btVector3(20, 0, 0));
            btMultiBodyLinkCollider baseCollider(&arm, -1), linkCollider(&arm, 0);
            baseCollider.setCollisionShape(&base);
            linkCollider.setCollisionShape(&link);
            world.addCollisionObject(&baseCollider, btBroadphaseProxy::DefaultFilter,
                                     btBroadphaseProxy::AllFilter);
            world.addCollisionObject(&linkCollider, btBroadphaseProxy::DefaultFilter,
                                     btBroadphaseProxy::AllFilter);
            arm.setBaseCollider(&baseCollider);
            arm.getLink(0).m_collider = &linkCollider;
            world.addMultiBody(&arm);
            {
                DestructionWorld destruction(world);
                SpawnOptions options;
                options.dynamic = !fixed;
                const ObjectId box =
                    destruction.spawn(makeBox({.level2 = {2, 1, 1}}), at(0, 0, 0), options).value();
                if (broken) REQUIRE(destruction.breakFragment(box));
                float moved = 0;
                for (int i = 0; i < 60; ++i) {
                    world.stepSimulation(kStep, 0);
                    REQUIRE(isSound(world));
                    for (const BreakEvent& event : destruction.events())
                        CHECK(event.consumed <= event.energy);
                    for (const FragmentPose& pose : destruction.poses())
                        moved = std::max(moved, glm::length(pose.pose.translation));
                }
                CHECK(moved > (fixed && !broken ? -1.0F : 0.1F));  // the arm was there
            }
            world.removeMultiBody(&arm);
            world.removeCollisionObject(&linkCollider);
            world.removeCollisionObject(&baseCollider);
        }
    }
}

TEST_CASE("a soft body may fall on an object, whole or broken, and an object on a soft body") {
    for (const bool broken : {false, true}) {
        CAPTURE(broken);
        btSoftBodyRigidBodyCollisionConfiguration configuration;
        btCollisionDispatcher dispatcher(&configuration);
        btDbvtBroadphase broadphase;
        btSequentialImpulseConstraintSolver solver;
        btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
        world.setGravity(btVector3(0, -10, 0));
        world.getWorldInfo().m_dispatcher = &dispatcher;
        world.getWorldInfo().m_broadphase = &broadphase;
        btSoftBody* ball = btSoftBodyHelpers::CreateEllipsoid(
            world.getWorldInfo(), btVector3(0.1F, 1.2F, 0), btVector3(0.4F, 0.4F, 0.4F), 64);
        ball->m_cfg.kPR = 200;
        ball->setTotalMass(20);
        ball->setVelocity(btVector3(0, -8, 0));
        world.addSoftBody(ball);
        {
            DestructionWorld destruction(world);
            SpawnOptions options;
            options.dynamic = false;
            const ObjectId table =
                destruction.spawn(makeBox({.level1 = {2, 2, 2}}), at(0, 0, 0), options).value();
            if (broken) REQUIRE(destruction.breakFragment(table));
            (void)destruction.spawn(makeBox({.size = glm::vec3(0.3F)}), at(0.1F, 2.5F, 0)).value();
            for (int i = 0; i < 90; ++i) {
                world.stepSimulation(kStep, 0);
                REQUIRE(isSound(world));
            }
            CHECK(destruction.isAlive(table));
        }
        world.removeSoftBody(ball);
        delete ball;
    }
}
