// SPDX-License-Identifier: MIT
// The smallest integration: a baked object on the ground, a ball dropped on it, what broke printed.
//   hello_break OBJECT.glb [SPEED_IN_METRES_PER_SECOND]
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "sherd/runtime/bullet/destruction_world.h"

namespace {

/// How far the colliders reach along each axis, object frame.
struct Extent {
    glm::vec3 low{INFINITY};
    glm::vec3 high{-INFINITY};
};

Extent extentOf(const sherd::Asset& asset) {
    Extent extent;
    for (const glm::vec3& point : asset.set().hullPoints) {
        extent.low = glm::min(extent.low, point);
        extent.high = glm::max(extent.high, point);
    }
    return extent;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: %s BAKED.glb [SPEED]\n", argv[0]);
        return 2;
    }
    const auto assets = sherd::loadAssets(std::filesystem::path(argv[1]));
    if (!assets) {
        std::fprintf(stderr, "%s: %s\n", assets.error().where.c_str(),
                     assets.error().message.c_str());
        return 1;
    }
    const auto& asset = assets->front();
    const Extent extent = extentOf(*asset);
    const float size = std::max(asset->diagonal(), 1e-3F);

    // The game's own world, ground and ball.
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    btStaticPlaneShape planeShape(btVector3(0, 1, 0), extent.low.y);
    btRigidBody plane(0, nullptr, &planeShape);
    world.addRigidBody(&plane);
    btSphereShape ballShape(0.1F * size);
    const float ballMass = asset->fragment(0).mass;
    btVector3 inertia;
    ballShape.calculateLocalInertia(ballMass, inertia);
    btRigidBody ball(ballMass, nullptr, &ballShape, inertia);
    const glm::vec3 center = asset->fragment(0).centerOfMass;
    ball.setWorldTransform(btTransform(btQuaternion::getIdentity(),
                                       btVector3(center.x, extent.high.y + 0.5F * size, center.z)));
    ball.setLinearVelocity(btVector3(0, argc > 2 ? -std::strtof(argv[2], nullptr) : -10.0F, 0));
    world.addRigidBody(&ball);
    {
        // Sherd: attach, spawn, and from then on draw poses() and listen to events().
        sherd::DestructionWorld destruction(world);
        if (const auto object = destruction.spawn(asset, sherd::RigidPose{}); !object) {
            std::fprintf(stderr, "%s\n", object.error().message.c_str());
            return 1;
        }
        for (int frame = 0; frame < 180; ++frame) {
            world.stepSimulation(1.0F / 60, 4, 1.0F / 240);  // a fast ball needs fine substeps
            for (const sherd::BreakEvent& event : destruction.events()) {
                std::printf(
                    "%.3f s: %s fragment %u: %u bodies came off, hit by %.3g J, %.3g of them "
                    "used\n",
                    event.time, asset->name().c_str(), event.fragment, event.bodies, event.energy,
                    event.consumed);
            }
        }
        std::printf("%zu pieces to draw\n", destruction.poses().size());
    }
    world.removeRigidBody(&ball);
    world.removeRigidBody(&plane);
    return 0;
}
