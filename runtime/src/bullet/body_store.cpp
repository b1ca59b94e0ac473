// SPDX-License-Identifier: MIT
#include "bullet/body_store.h"

#include <algorithm>
#include <cmath>

#include "bullet/convert.h"

namespace sherd {

BodyStore::~BodyStore() {
    for (uint32_t p = 0; p < pieces_.size(); ++p) {
        if (pieces_[p].body) removeBody(p);
    }
}

std::shared_ptr<FragmentShapes> BodyStore::shapesOf(const std::shared_ptr<const Asset>& asset) {
    for (const auto& shapes : shapes_) {
        if (shapes->asset() == asset) return shapes;
    }
    shapes_.push_back(std::make_shared<FragmentShapes>(asset));
    return shapes_.back();
}

ObjectId BodyStore::spawn(const std::shared_ptr<const Asset>& asset, const RigidPose& pose,
                          const SpawnOptions& options) {
    auto shapes = shapesOf(asset);
    uint32_t index = uint32_t(objects_.size());
    if (freeObjects_.empty()) {
        objects_.emplace_back();
    } else {
        index = freeObjects_.back();
        freeObjects_.pop_back();
    }
    Object& object = objects_[index];
    object.shapes = std::move(shapes);
    object.options = options;
    const uint32_t piece = addPiece(index, 0, options.dynamic, pose);
    if (options.dynamic) {
        pieces_[piece].body->setLinearVelocity(toBullet(options.linearVelocity));
        pieces_[piece].body->setAngularVelocity(toBullet(options.angularVelocity));
    }
    object.pieces.assign(1, piece);
    return idOf(index);
}

void BodyStore::remove(uint32_t index) {
    Object& object = objects_[index];
    for (const uint32_t piece : object.pieces) removeBody(piece);
    object.pieces.clear();
    object.shapes.reset();
    ++object.generation;
    freeObjects_.push_back(index);
    recycle();
}

uint32_t BodyStore::addPiece(uint32_t index, uint32_t fragment, bool dynamic,
                             const RigidPose& pose) {
    const Object& object = objects_[index];
    const Fragment& baked = object.asset().fragment(fragment);
    btRigidBody::btRigidBodyConstructionInfo info(
        dynamic ? baked.mass : 0, nullptr, object.shapes->shape(fragment),
        dynamic ? toBullet(baked.inertiaDiagonal) : btVector3(0, 0, 0));
    info.m_startWorldTransform = toBullet(pose) * object.shapes->bodyFrame(fragment);
    info.m_friction = baked.friction;
    info.m_restitution = baked.restitution;

    uint32_t slot = uint32_t(pieces_.size());
    if (freePieces_.empty()) {
        pieces_.emplace_back();
    } else {
        slot = freePieces_.back();
        freePieces_.pop_back();
    }
    Piece& piece = pieces_[slot];
    piece.body = std::make_unique<btRigidBody>(info);
    piece.object = index;
    piece.fragment = fragment;
    piece.pose = pose;
    piece.previous = pose;
    piece.body->setUserIndex3(int(slot));
    const SpawnOptions& options = object.options;
    if (options.collisionGroup == 0 && options.collisionMask == 0) {
        world_.addRigidBody(piece.body.get());
    } else {
        world_.addRigidBody(piece.body.get(), options.collisionGroup, options.collisionMask);
    }
    ++bodyCount_;
    breakableCount_ += breakable(piece) ? 1 : 0;
    posesListed_ = false;
    return slot;
}

void BodyStore::removeBody(uint32_t index) {
    Piece& piece = pieces_[index];
    breakableCount_ -= breakable(piece) ? 1 : 0;
    --bodyCount_;
    if (piece.body->isInWorld()) world_.removeRigidBody(piece.body.get());
    piece.body.reset();
    removedPieces_.push_back(index);
    posesListed_ = false;
}

std::span<const uint32_t> BodyStore::swap(uint32_t index, bool inStep) {
    const uint32_t objectIndex = pieces_[index].object;
    const uint32_t fragment = pieces_[index].fragment;
    const RigidPose pose = pieces_[index].pose;
    const RigidPose previous = pieces_[index].previous;
    const btVector3 center = pieces_[index].body->getCenterOfMassPosition();
    const btVector3 linear = pieces_[index].body->getLinearVelocity();
    const btVector3 angular = pieces_[index].body->getAngularVelocity();
    removeBody(index);

    const Range range = objects_[objectIndex].asset().fragment(fragment).children;
    children_.clear();
    for (uint32_t child = range.first; child < range.first + range.count; ++child) {
        const uint32_t slot = addPiece(objectIndex, child, true, pose);
        Piece& piece = pieces_[slot];
        piece.previous = previous;
        const btVector3 arm = piece.body->getCenterOfMassPosition() - center;
        piece.body->setLinearVelocity(linear + angular.cross(arm));
        piece.body->setAngularVelocity(angular);
        // Bullet applies gravity once before all substeps of a step and clears it after the last.
        if (inStep) piece.body->applyGravity();
        children_.push_back(slot);
    }
    std::vector<uint32_t>& pieces = objects_[objectIndex].pieces;
    pieces.erase(std::find(pieces.begin(), pieces.end(), index));
    const auto behind = std::find_if(pieces.begin(), pieces.end(),
                                     [&](uint32_t p) { return pieces_[p].fragment > range.first; });
    pieces.insert(behind, children_.begin(), children_.end());
    return children_;
}

void BodyStore::recycle() {
    // Backwards, so that the slots are handed out again in the order they were given up.
    freePieces_.insert(freePieces_.end(), removedPieces_.rbegin(), removedPieces_.rend());
    removedPieces_.clear();
}

void BodyStore::readPoses() {
    for (Piece& piece : pieces_) {
        if (!piece.body) continue;
        piece.previous = piece.pose;
        const btTransform bodyFrame = objects_[piece.object].shapes->bodyFrame(piece.fragment);
        piece.pose = toPose(piece.body->getWorldTransform() * bodyFrame.inverse());
    }
    posesListed_ = false;
}

std::span<const FragmentPose> BodyStore::poses() {
    if (posesListed_) return poses_;
    poses_.clear();
    for (uint32_t o = 0; o < objects_.size(); ++o) {
        for (const uint32_t p : objects_[o].pieces) {
            const Piece& piece = pieces_[p];
            poses_.push_back(
                {idOf(o), &objects_[o].asset(), piece.fragment, piece.pose, piece.previous});
        }
    }
    posesListed_ = true;
    return poses_;
}

bool BodyStore::isAlive(ObjectId id) const {
    return id.index < objects_.size() && objects_[id.index].generation == id.generation &&
           objects_[id.index].shapes != nullptr;
}

ObjectId BodyStore::idOf(uint32_t object) const {
    return {object, objects_[object].generation};
}

uint32_t BodyStore::findPiece(uint32_t object, uint32_t fragment) const {
    for (const uint32_t piece : objects_[object].pieces) {
        if (pieces_[piece].fragment == fragment) return piece;
    }
    return UINT32_MAX;
}

// The slot number on the body is only a hint: the game's own bodies may carry any number there.
uint32_t BodyStore::pieceOf(const btCollisionObject& body) const {
    const auto slot = uint32_t(body.getUserIndex3());
    return slot < pieces_.size() && pieces_[slot].body.get() == &body ? slot : UINT32_MAX;
}

bool BodyStore::breakable(const Piece& piece) const {
    const Object& object = objects_[piece.object];
    return std::isfinite(breakThreshold(object.asset(), piece.fragment, object.options.damage));
}

}  // namespace sherd
