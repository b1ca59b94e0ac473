// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "bullet/fragment_shapes.h"
#include "bullet/object_snapshot.h"
#include "sherd/runtime/bullet/destruction_world.h"
#include "sherd/runtime/structure.h"

namespace sherd {

/// One body in the world: an island, whose fragments hold together.
struct IslandBody {
    std::unique_ptr<btRigidBody> body;   ///< null: this slot is free
    std::unique_ptr<IslandShape> shape;  ///< null: its only fragment's own
    uint32_t object = 0;
    std::vector<uint32_t> fragments;  ///< that stand, ascending
    bool isAnchored = false;          ///< by a bond to the world that is not broken
    btTransform frame;                ///< body to object
    double bornAt = 0;                ///< s
    RigidPose pose;                   ///< of the object frame
    RigidPose previous;
    btTransform seen;      ///< of the body, when `pose` was read from it
    bool isStill = false;  ///< `previous` is `pose`
};

struct Object {
    std::shared_ptr<FragmentShapes> shapes;  ///< null: this slot is free
    std::unique_ptr<Structure> structure;
    uint32_t generation = 0;
    SpawnOptions options;          ///< `damage` already combined with the world's
    std::vector<uint32_t> bodies;  ///< ascending by their first fragment

    [[nodiscard]] const Asset& asset() const { return *shapes->asset(); }
};

/// Objects and their bodies: makes, splits and removes them, and lists their poses. It knows
/// nothing of hits. Slots are reused last in, first out, so equal calls give equal slots.
class BodyStore {
  public:
    explicit BodyStore(btDynamicsWorld& world) : world_(world) {}
    ~BodyStore();
    BodyStore(const BodyStore&) = delete;
    BodyStore& operator=(const BodyStore&) = delete;

    ObjectId spawn(const std::shared_ptr<const Asset>& asset, const RigidPose& pose,
                   const SpawnOptions& options);
    void remove(uint32_t object);

    /// What an object's structure has made of a body.
    enum class Change {
        none,
        finer,  ///< fragments that were opened gave way to their children
        apart,  ///< it comes apart, off its anchors or to new ones
    };
    Change regroup(uint32_t body);
    /// Carries out what the last `regroup` of this body found: every island but the largest gets a
    /// body of its own, with the velocity its part had. `inStep`: Bullet has given its gravity for
    /// this step already, and new bodies must have theirs. Returns the bodies there are now, the
    /// old one first. Valid until the next call.
    std::span<const uint32_t> split(uint32_t body, double time, bool inStep);

    /// Pins the leaves of a standing fragment, or lets them go. False when it does not stand.
    bool pin(uint32_t object, uint32_t fragment, bool pinned);

    /// Pins the leaves whose shape, at its place in the world, `wanted` says. Returns how many.
    uint32_t pinLeaves(uint32_t object,
                       const std::function<bool(btCollisionShape&, const btTransform&)>& wanted);
    /// Pushes moving bodies within `radius` away from a point: N s per m^2 of the circle that their
    /// bounding spheres show it, falling evenly to the rim.
    void throwFrom(const glm::vec3& point, float radius, float impulsePerArea);

    /// The substep is over: reads all bodies.
    void readPoses();
    std::span<const FragmentPose> poses();

    /// Bodies in place of an object's own, as `readSnapshot` found them. Fires nothing.
    void replaceBodies(uint32_t object, ObjectSnapshot&& snapshot);

    [[nodiscard]] bool isAlive(ObjectId id) const;
    [[nodiscard]] ObjectId idOf(uint32_t object) const;
    [[nodiscard]] uint32_t objectCount() const { return uint32_t(objects_.size()); }
    [[nodiscard]] const Object& object(uint32_t index) const { return objects_[index]; }
    [[nodiscard]] const IslandBody& island(uint32_t index) const { return islands_[index]; }
    [[nodiscard]] Structure& structureOf(uint32_t island) {
        return *objects_[islands_[island].object].structure;
    }
    /// Of the body in which a fragment stands; UINT32_MAX when there is none.
    [[nodiscard]] uint32_t findIsland(uint32_t object, uint32_t fragment) const;
    [[nodiscard]] uint32_t islandOf(const btCollisionObject& body) const;
    /// The fragment that a child of the body's shape belongs to; the first for -1.
    [[nodiscard]] uint32_t fragmentOf(uint32_t island, int child) const;
    [[nodiscard]] uint32_t bodyCount() const { return bodyCount_; }

  private:
    std::shared_ptr<FragmentShapes> shapesOf(const std::shared_ptr<const Asset>& asset);
    uint32_t takeSlot();
    void makeBody(uint32_t island, bool isFixed);
    void reshape(uint32_t island, bool isFixed);
    void addToWorld(IslandBody& island);
    btRigidBody::btRigidBodyConstructionInfo describe(IslandBody& island, bool isFixed);
    void removeBody(uint32_t island);

    btDynamicsWorld& world_;
    std::vector<std::shared_ptr<FragmentShapes>> shapes_;
    std::vector<Object> objects_;
    std::vector<uint32_t> freeObjects_;
    std::vector<IslandBody> islands_;
    std::vector<uint32_t> freeIslands_;
    std::vector<uint32_t> updated_;
    IslandFinder groups_;           ///< of the last body regrouped
    Change change_ = Change::none;  ///< and what became of it
    std::vector<FragmentPose> poses_;
    bool posesListed_ = false;
    uint32_t bodyCount_ = 0;
};

}  // namespace sherd
