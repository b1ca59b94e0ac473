// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <span>

#include "sherd/runtime/bullet/game_listener.h"
#include "sherd/runtime/memory.h"

namespace sherd {

/// Keeps the game's constraints on bodies that come apart where they were: on the island that holds
/// their pivot.
class ConstraintMover {
  public:
    explicit ConstraintMover(btDynamicsWorld& world) : world_(world) {}

    /// Notes the constraints of a body, and where they hold it.
    void beforeSplit(const btRigidBody& body);
    /// `bodies` stand for it now, which may be one of them. `listener` may be null.
    void afterSplit(btRigidBody& old, std::span<btRigidBody* const> bodies, GameListener* listener);

  private:
    struct Held {
        btTypedConstraint* constraint;
        btTransform frame;  ///< of the pivot, world
        bool isMovable;     ///< of a kind whose pivot is known
    };
    btDynamicsWorld& world_;
    Vector<Held> held_;
};

}  // namespace sherd
