// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

#include <optional>

namespace sherd {

/// Both ends of a constraint, by the body's frames.
struct Ends {
    btTransform a, b;
};

/// None of a kind whose ends are not known.
std::optional<Ends> endsOf(btTypedConstraint& constraint);
/// Of a kind whose ends are known.
void setEnds(btTypedConstraint& constraint, const Ends& ends);

/// Makes it anew in its own place between other bodies, out of the world: the game's pointer stays
/// good, and what it set is copied over. False, and nothing done, for kinds that cannot be read in
/// full.
bool rebind(btTypedConstraint& constraint, btRigidBody& a, btRigidBody& b, const Ends& ends);

}  // namespace sherd
