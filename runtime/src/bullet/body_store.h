// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <memory>
#include <span>
#include <vector>

#include "bullet/fragment_shapes.h"
#include "sherd/runtime/bullet/destruction_world.h"

namespace sherd {

/// One body in the world: the intact object or a fragment.
struct Piece {
    std::unique_ptr<btRigidBody> body;  ///< null: this slot is free
    uint32_t object = 0;
    uint32_t fragment = 0;
    RigidPose pose;
    RigidPose previous;
};

struct Object {
    std::shared_ptr<FragmentShapes> shapes;  ///< null: this slot is free
    uint32_t generation = 0;
    SpawnOptions options;          ///< `damage` already combined with the world's
    std::vector<uint32_t> pieces;  ///< ascending by fragment

    [[nodiscard]] const Asset& asset() const { return *shapes->asset(); }
};

/// Objects and their bodies: makes, swaps and removes them, and lists their poses. It knows nothing
/// of hits. Slots are reused last in, first out, so equal calls give equal slots.
class BodyStore {
  public:
    explicit BodyStore(btDynamicsWorld& world) : world_(world) {}
    ~BodyStore();
    BodyStore(const BodyStore&) = delete;
    BodyStore& operator=(const BodyStore&) = delete;

    ObjectId spawn(const std::shared_ptr<const Asset>& asset, const RigidPose& pose,
                   const SpawnOptions& options);
    void remove(uint32_t object);

    /// Replaces a piece by its children: each has the velocity of its part. `inStep`: Bullet has
    /// given its gravity for this step already, and the new bodies must have theirs. The old body
    /// is gone afterwards; its slot is not reused before `recycle`. Valid until the next call.
    std::span<const uint32_t> swap(uint32_t piece, bool inStep);
    void recycle();

    /// The substep is over: reads all bodies.
    void readPoses();
    std::span<const FragmentPose> poses();

    [[nodiscard]] bool isAlive(ObjectId id) const;
    [[nodiscard]] ObjectId idOf(uint32_t object) const;
    [[nodiscard]] const Object& object(uint32_t index) const { return objects_[index]; }
    [[nodiscard]] const Piece& piece(uint32_t index) const { return pieces_[index]; }
    /// UINT32_MAX when there is none.
    [[nodiscard]] uint32_t findPiece(uint32_t object, uint32_t fragment) const;
    [[nodiscard]] uint32_t pieceOf(const btCollisionObject& body) const;
    [[nodiscard]] uint32_t bodyCount() const { return bodyCount_; }
    /// Pieces that a hit could break.
    [[nodiscard]] uint32_t breakableCount() const { return breakableCount_; }

  private:
    std::shared_ptr<FragmentShapes> shapesOf(const std::shared_ptr<const Asset>& asset);
    uint32_t addPiece(uint32_t object, uint32_t fragment, bool dynamic, const RigidPose& pose);
    void removeBody(uint32_t piece);
    [[nodiscard]] bool breakable(const Piece& piece) const;

    btDynamicsWorld& world_;
    std::vector<std::shared_ptr<FragmentShapes>> shapes_;
    std::vector<Object> objects_;
    std::vector<uint32_t> freeObjects_;
    std::vector<Piece> pieces_;
    std::vector<uint32_t> freePieces_;
    std::vector<uint32_t> removedPieces_;  ///< free after `recycle`
    std::vector<uint32_t> children_;
    std::vector<FragmentPose> poses_;
    bool posesListed_ = false;
    uint32_t bodyCount_ = 0;
    uint32_t breakableCount_ = 0;
};

}  // namespace sherd
