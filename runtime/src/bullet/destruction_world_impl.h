// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btActionInterface.h>
#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include <optional>
#include <vector>

#include "bullet/breaker.h"
#include "bullet/bullet_bodies.h"
#include "bullet/world_memory.h"
#include "core/debris.h"
#include "core/report.h"
#include "sherd/runtime/bullet/destruction_world.h"

namespace sherd {

/// What a DestructionWorld is made of, and how it steps. What the game may ask of it is told in
/// files of their own: spawning, damage, saving, and the rest in destruction_world.cpp.
class DestructionWorld::Impl final : public btActionInterface {
  public:
    /// Who has pinned an object.
    enum class Hold : uint8_t { none, toStatic, byGame };

    Impl(btDynamicsWorld& bullet, const WorldOptions& options);
    ~Impl() override;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    // Bullet runs actions at the end of every substep, when the contact points hold its impulses.
    void updateAction(btCollisionWorld* /*world*/, btScalar dt) override { step(dt, true); }
    void debugDraw(btIDebugDraw* /*drawer*/) override {}

    // Out of memory within a step ends the program rather than leave half a swap behind.
    void step(float dt, bool inStep) noexcept;

    /// Breaks something of an object by `breakIt`. What was at rest may rest on.
    template <class Break>
    void release(uint32_t object, const Break& breakIt) {
        const bool wasAtRest = restsWhenReleased(object);
        breakIt();
        afterRelease(object, wasAtRest);
    }

    bool breakOut(ObjectId object, uint32_t fragment, bool whole);
    uint32_t dealArea(uint32_t object, const AreaDamage& damage);
    void anchorToStatic(uint32_t object);

    Hold& holds(uint32_t object) {
        if (holds_.size() <= object) holds_.resize(object + 1, Hold::none);
        return holds_[object];
    }

    /// Whether it is alive, and the game has not just taken it away. Before something changes.
    bool isThere(ObjectId object) {
        if (!SHERD_ASSERT(!bodies.isTelling())) return false;
        bodies.noticeGone();
        return islands.isAlive(object);
    }

    /// Island of a standing fragment of a living object; UINT32_MAX when there is none.
    [[nodiscard]] uint32_t find(ObjectId object, uint32_t fragment) {
        bodies.noticeGone();
        return islands.isAlive(object) ? islands.findIsland(object.index, fragment) : UINT32_MAX;
    }

    WorldMemory memory;
    std::optional<MemoryScope> making;  ///< what follows

    btDynamicsWorld& world;
    WorldOptions settings;
    BulletBodies bodies;
    IslandWorld islands;
    Breaker breaker;
    Debris debris;
    std::vector<uint8_t> releasesAsleep;  ///< per object
    float lastStep = 0;                   ///< s; 0: none yet

  private:
    [[nodiscard]] bool restsWhenReleased(uint32_t object);
    void afterRelease(uint32_t object, bool wasAtRest);

    std::vector<Hold> holds_;  ///< per object
};

}  // namespace sherd
