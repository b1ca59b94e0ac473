// SPDX-License-Identifier: MIT
#include "bullet/adviser.h"

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>
#include <utility>

namespace sherd {
namespace {

/// Thinnest side of the box around the middle one of an asset's leaves, of the asset where it is
/// least, metres; HUGE_VALF: there is none.
float pieceSize(const AssetStore& assets) {
    float least = HUGE_VALF;
    std::vector<float> sizes;
    assets.forEach([&](const Asset& asset) {
        sizes.clear();
        for (uint32_t leaf = 0; leaf < asset.graph().leafCount(); ++leaf) {
            const auto& [low, high] = asset.box(asset.graph().fragmentOfLeaf(leaf));
            const glm::vec3 sides = high - low;
            sizes.push_back(std::min({sides.x, sides.y, sides.z}));
        }
        const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
        std::nth_element(sizes.begin(), middle, sizes.end());
        least = std::min(least, *middle);
    });
    return least;
}

std::string millimetres(float metres) {
    return std::to_string(std::lround(1000 * metres)) + " mm";
}

}  // namespace

std::vector<Advice> adviseOn(btDynamicsWorld& world, const AssetStore& assets,
                             const BulletBodies& bodies, const WorldOptions& options,
                             float lastStep) {
    std::vector<Advice> advice;
    const auto say = [&](Advice::Code code, std::string text) {
        advice.push_back({code, std::move(text)});
    };
    const float size = pieceSize(assets);
    // A pair costs where boxes with their margins meet; a margin of a third of a piece makes half
    // as many again.
    if (dynamic_cast<btDbvtBroadphase*>(world.getBroadphase()) && gDbvtMargin > size / 3)
        say(Advice::Code::broadphaseMargin,
            "gDbvtMargin is " + millimetres(gDbvtMargin) + ", and pieces are " + millimetres(size) +
                " thick: Bullet looks at pairs far apart. Set it to a tenth "
                "of that before bodies are made");
    if (dynamic_cast<btAxisSweep3*>(world.getBroadphase()))
        say(Advice::Code::broadphaseLimit,
            "btAxisSweep3 holds a fixed number of bodies; use btDbvtBroadphase");
    if (world.getForceUpdateAllAabbs())
        say(Advice::Code::allAabbs,
            "Bullet updates the boxes of sleeping and static bodies in every substep: call "
            "setForceUpdateAllAabbs(false), and updateSingleAabb for static bodies you move");
    if (gContactBreakingThreshold > size / 2)
        say(Advice::Code::contactThreshold,
            "gContactBreakingThreshold is " + millimetres(gContactBreakingThreshold) +
                ", and pieces are " + millimetres(size) +
                " thick: contacts are kept across them. Set it to a fifth of that");
    constexpr float kLongest = 1.01F / 60;
    if (lastStep > kLongest)
        say(Advice::Code::longSubstep,
            "a substep is " + std::to_string(std::lround(1000 * lastStep)) +
                " ms long: piles of pieces are not held up, and fast ones pass through. Step at 60 "
                "Hz or more");
    const btContactSolverInfo& solver = world.getSolverInfo();
    if (solver.m_numIterations < 10)
        say(Advice::Code::fewIterations,
            "the solver does " + std::to_string(solver.m_numIterations) +
                " iterations: piles of pieces sag. Let it do 10 or more");
    if (solver.m_splitImpulse == 0)
        say(Advice::Code::noSplitImpulse,
            "split impulse is off: pieces pushed out of each other keep the speed. Turn it on");
    if ((solver.m_solverMode & SOLVER_USE_WARMSTARTING) == 0)
        say(Advice::Code::noWarmStarting,
            "warm starting is off: piles of pieces never come to rest. Turn it on");
    if (gDisableDeactivation)
        say(Advice::Code::noDeactivation,
            "gDisableDeactivation is on: pieces that lie about cost as much as those that fly");
    const bool isSwept = std::any_of(options.rules.begin(), options.rules.end(),
                                     [](const BodyRule& rule) { return rule.continuous; });
    if (isSwept && !world.getDispatchInfo().m_useContinuous)
        say(Advice::Code::continuousOff,
            "rules ask for continuous motion, but the world's dispatch info has m_useContinuous "
            "off");
    uint32_t outside = 0, compounds = 0;
    bodies.forEach([&](const btRigidBody& body) {
        if (!body.isInWorld()) ++outside;
        if (body.getCcdMotionThreshold() > 0 && !body.getCollisionShape()->isConvex()) ++compounds;
    });
    if (compounds > 0)
        say(Advice::Code::continuousCompound,
            std::to_string(compounds) +
                " bodies are to move continuously, but consist of several convex parts, which "
                "Bullet does not sweep. Bake with fewer convex parts, or step more often");
    if (outside > 0)
        say(Advice::Code::bodiesOutOfWorld,
            std::to_string(outside) +
                " bodies of Sherd's are not in the world: put them in again, or remove their "
                "objects");
    return advice;
}

}  // namespace sherd
