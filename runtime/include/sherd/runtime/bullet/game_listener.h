// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sherd/runtime/events.h"

class btRigidBody;
class btTypedConstraint;

namespace sherd {

/// What the game may want to know when Sherd touches what belongs to it. Called from within the
/// calls and substeps of a DestructionWorld, which must not be called back but for its const
/// functions.
class GameListener {
  public:
    virtual ~GameListener() = default;

    /// An adopted body has come apart: `islands` stand for it, the largest first, with its motion.
    /// It is still in Bullet's world and taken out right after; then it is the game's alone. The
    /// game may take it out itself here, and delete it.
    virtual void onReplace(btRigidBody& /*old*/, std::span<btRigidBody* const> /*islands*/) {}

    /// A constraint of the game's is the same object with the same settings, but holds `to`: the
    /// island that its pivot was on.
    virtual void onConstraintMoved(btTypedConstraint& /*constraint*/, btRigidBody& /*to*/) {}

    /// A constraint that cannot be moved was taken out of Bullet's world. `why`: a sentence.
    virtual void onConstraintLost(btTypedConstraint& /*constraint*/, const char* /*why*/) {}

    /// The game has taken an adopted body out of Bullet's world, or deleted a body of Sherd's: what
    /// it stood for is gone. The object, too, when nothing of it is left.
    virtual void onBodyGone(ObjectId /*object*/) {}
};

}  // namespace sherd
