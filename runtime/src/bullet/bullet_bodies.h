// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bullet/fragment_shapes.h"
#include "bullet/quiet_debris.h"
#include "bullet/released_pairs.h"
#include "sherd/runtime/island_world.h"

namespace sherd {

/// Bullet's bodies of an IslandWorld, by the islands' numbers.
class BulletBodies final : public BodyTable {
  public:
    BulletBodies(btDynamicsWorld& world, float overlapTolerance, float freezeAfter)
        : released_(*this, overlapTolerance), quiet_(world, freezeAfter), world_(world) {}
    ~BulletBodies() override;
    BulletBodies(const BulletBodies&) = delete;
    BulletBodies& operator=(const BulletBodies&) = delete;

    /// Before an asset's first body is made: its shapes, kept as long as this lives.
    void prepare(const std::shared_ptr<const Asset>& asset);
    /// Bullet's filter bits for bodies of the object that comes next; both 0: Bullet's defaults.
    void setNextFilter(int group, int mask) { nextFilter_ = Filter{group, mask}; }
    /// Whether Bullet has given its gravity for this step already; new bodies must have theirs.
    void setInStep(bool inStep) {
        inStep_ = inStep;
        quiet_.setInStep(inStep);
    }

    void create(const IslandBody& body) override;
    void update(const IslandBody& body) override;
    void remove(uint32_t island) override;
    [[nodiscard]] BodyMotion motion(uint32_t island) const override;
    void beforeSplit(uint32_t island) override { released_.beforeSplit(island); }
    void afterSplit(uint32_t island, std::span<const uint32_t> islands) override {
        released_.afterSplit(island, islands);
    }

    /// After a substep: tells the world where its islands are. Returns whether contacts can have
    /// broken any of them: Bullet wakes what is touched, and the last pieces do not break.
    bool readPoses(IslandWorld& islands);

    /// Marks those that may break, by their places in Bullet's world; as of `readPoses`.
    void markBreakable(std::vector<uint8_t>& marks) const;

    /// Pieces that were awake and moving at the last `readPoses`.
    [[nodiscard]] uint32_t awakeDebris() const { return awakeDebris_; }

    /// The body was moved by hand; its island knows where.
    void noteTransform(uint32_t island) {
        bodies_[island].seen = bodies_[island].body->getWorldTransform();
    }

    /// The body may have been taken out of Bullet's world by the game.
    [[nodiscard]] btRigidBody& body(uint32_t island) const { return *bodies_[island].body; }
    [[nodiscard]] float diagonalOf(uint32_t island) const { return bodies_[island].diagonal; }
    /// UINT32_MAX when it is none of these.
    [[nodiscard]] uint32_t islandOf(const btCollisionObject& body) const;
    /// The fragment that a child of the body's shape belongs to; the first for -1.
    [[nodiscard]] uint32_t fragmentOf(uint32_t island, int child) const;
    [[nodiscard]] FragmentShapes& shapesOf(const Asset& asset) const;
    [[nodiscard]] QuietDebris& quiet() { return quiet_; }
    [[nodiscard]] ReleasedPairs& released() { return released_; }
    [[nodiscard]] const ReleasedPairs& released() const { return released_; }

  private:
    struct Body {
        std::unique_ptr<btRigidBody> body;   ///< null: there is none
        DebrisBody* freezable = nullptr;     ///< the same, made here
        std::unique_ptr<IslandShape> shape;  ///< null: its only fragment's own
        uint32_t object = 0;
        uint32_t firstFragment = 0;
        float diagonal = 0;  ///< of the object, metres
        btTransform frame;   ///< body to object
        btTransform seen;    ///< where it was when its pose was read last
        bool isStill = false;
        bool isKnown = false;      ///< whether it is breakable:
        bool isBreakable = false;  ///< that changes only with the body
    };
    struct Filter {
        int group = 0, mask = 0;
    };
    btRigidBody::btRigidBodyConstructionInfo describe(Body& slot, const IslandBody& island);
    void addToWorld(Body& slot);
    static void move(btRigidBody& body, const BodyMotion& motion);

    void watchQuiet(const IslandBody& island);
    void wakeAround(const btRigidBody& body);

    ReleasedPairs released_;
    QuietDebris quiet_;
    btDynamicsWorld& world_;
    std::vector<std::unique_ptr<FragmentShapes>> shapes_;
    std::vector<Filter> filters_;  ///< per object
    std::optional<Filter> nextFilter_;
    std::vector<Body> bodies_;  ///< per island
    uint32_t awakeDebris_ = 0;
    bool inStep_ = false;
};

}  // namespace sherd
