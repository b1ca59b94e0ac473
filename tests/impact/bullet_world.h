// SPDX-License-Identifier: MIT
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "sherd/runtime/bullet/destruction_world.h"
#include "support/box_fracture.h"

namespace sherd::test {

constexpr float kStep = 1.0F / 60;

/// A game's Bullet world, as a game would make it, with its own bodies.
class BulletWorld {
  public:
    explicit BulletWorld(const btVector3& gravity = btVector3(0, 0, 0)) {
        world.setGravity(gravity);
    }
    ~BulletWorld() {
        for (auto& body : bodies_) world.removeRigidBody(body.get());
    }
    BulletWorld(const BulletWorld&) = delete;
    BulletWorld& operator=(const BulletWorld&) = delete;

    btRigidBody& addBall(float radius, float mass, const btVector3& place,
                         const btVector3& velocity) {
        return add(std::make_unique<btSphereShape>(radius), mass, place, velocity);
    }

    btRigidBody& addGround(float top) {
        return add(std::make_unique<btBoxShape>(btVector3(50, 1, 50)), 0, btVector3(0, top - 1, 0),
                   btVector3(0, 0, 0));
    }

    btRigidBody& add(std::unique_ptr<btCollisionShape> shape, float mass, const btVector3& place,
                     const btVector3& velocity) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) shape->calculateLocalInertia(mass, inertia);
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
        info.m_startWorldTransform.setOrigin(place);
        shapes_.push_back(std::move(shape));
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        bodies_.back()->setLinearVelocity(velocity);
        world.addRigidBody(bodies_.back().get());
        return *bodies_.back();
    }

    /// Deletes one of its bodies.
    void take(btRigidBody& body) {
        world.removeRigidBody(&body);
        std::erase_if(bodies_, [&](const auto& own) { return own.get() == &body; });
    }

    /// One substep.
    void step(float dt = kStep) { world.stepSimulation(dt, 0); }

  private:
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;

  public:
    btDiscreteDynamicsWorld world{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

inline std::shared_ptr<const Asset> makeBox(const BoxFracture& recipe = {}) {
    return Asset::fromFractureSet(makeBoxFracture(recipe)).value();
}

inline RigidPose at(float x, float y, float z) {
    RigidPose pose;
    pose.translation = {x, y, z};
    return pose;
}

inline WorldOptions drivenByHand() {
    WorldOptions options;
    options.drive = Drive::manual;
    return options;
}

inline WorldOptions unbreakable() {
    WorldOptions options;
    options.damage.maxLevel = 0;
    return options;
}

/// Momentum, angular momentum about the origin and kinetic energy of everything that moves.
struct Totals {
    btVector3 momentum{0, 0, 0};
    btVector3 angularMomentum{0, 0, 0};
    double momentumScale = 0;  ///< sum of |m v|
    double angularScale = 0;
    double energy = 0;
};

/// `push`: added to every velocity first, such as what gravity will add in the next substep.
inline Totals totals(const btDiscreteDynamicsWorld& world,
                     const btVector3& push = btVector3(0, 0, 0)) {
    Totals sum;
    for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
        const btRigidBody* body = btRigidBody::upcast(world.getCollisionObjectArray()[i]);
        if (!body || body->getInvMass() == 0) continue;
        const btVector3 velocity = body->getLinearVelocity() + push;
        const btVector3 p = velocity / body->getInvMass();
        const btVector3 spin =
            body->getInvInertiaTensorWorld().inverse() * body->getAngularVelocity();
        const btVector3 orbit = body->getCenterOfMassPosition().cross(p);
        sum.momentum += p;
        sum.angularMomentum += spin + orbit;
        sum.momentumScale += p.length();
        sum.angularScale += spin.length() + orbit.length();
        sum.energy += 0.5 * (p.dot(velocity) + spin.dot(body->getAngularVelocity()));
    }
    return sum;
}

/// Steps until something breaks; false when nothing did.
inline bool stepUntilBreak(BulletWorld& bullet, DestructionWorld& destruction, int steps,
                           std::vector<BreakEvent>* events = nullptr) {
    for (int i = 0; i < steps; ++i) {
        bullet.step();
        const auto broken = destruction.events();
        if (broken.empty()) continue;
        if (events) events->assign(broken.begin(), broken.end());
        return true;
    }
    return false;
}

}  // namespace sherd::test
