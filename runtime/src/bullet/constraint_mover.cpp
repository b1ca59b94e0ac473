// SPDX-License-Identifier: MIT
#include "bullet/constraint_mover.h"

#include <cmath>
#include <optional>

#include "bullet/constraint_kinds.h"
#include "bullet/point_distance.h"
#include "core/report.h"

namespace sherd {
namespace {

bool isLinked(btRigidBody& body, const btTypedConstraint* constraint) {
    for (int i = 0; i < body.getNumConstraintRefs(); ++i)
        if (body.getConstraintRef(i) == constraint) return true;
    return false;
}

}  // namespace

void ConstraintMover::beforeSplit(const btRigidBody& body) {
    held_.clear();
    for (int i = 0; i < world_.getNumConstraints(); ++i) {
        btTypedConstraint& constraint = *world_.getConstraint(i);
        const bool isA = &constraint.getRigidBodyA() == &body;
        if (!isA && &constraint.getRigidBodyB() != &body) continue;
        Held held{&constraint, btTransform::getIdentity(), false};
        if (const std::optional<Ends> ends = endsOf(constraint)) {
            held.frame = body.getWorldTransform() * (isA ? ends->a : ends->b);
            held.isMovable = true;
        }
        held_.push_back(held);
    }
}

void ConstraintMover::afterSplit(btRigidBody& old, std::span<btRigidBody* const> bodies,
                                 GameListener* listener) {
    for (const Held& held : held_) {
        btTypedConstraint& constraint = *held.constraint;
        const auto lose = [&](const char* why) {
            world_.removeConstraint(&constraint);
            log(LogLevel::warning, why);
            if (listener) listener->onConstraintLost(constraint, why);
        };
        if (!held.isMovable) {
            lose("a constraint of a kind whose pivot is not known was taken out of the world");
            continue;
        }
        btRigidBody* to = bodies.front();
        float least = HUGE_VALF;
        for (btRigidBody* body : bodies) {
            const float distance = pointDistance(*body->getCollisionShape(),
                                                 body->getWorldTransform(), held.frame.getOrigin());
            if (!(distance < least)) continue;
            least = distance;
            to = body;
        }
        const bool isA = &constraint.getRigidBodyA() == &old;
        Ends moved = *endsOf(constraint);
        (isA ? moved.a : moved.b) = to->getWorldTransform().inverse() * held.frame;
        if (to == &old) {
            setEnds(constraint, moved);
            continue;
        }
        btRigidBody& a = isA ? *to : constraint.getRigidBodyA();
        btRigidBody& b = isA ? constraint.getRigidBodyB() : *to;
        const bool isLinkedPair = isLinked(old, &constraint);
        world_.removeConstraint(&constraint);
        const bool isMoved = rebind(constraint, a, b, moved);
        world_.addConstraint(&constraint, isLinkedPair);
        if (!isMoved) {
            lose("a constraint of a kind that cannot hold another body was taken out of the world");
            continue;
        }
        a.activate();
        b.activate();
        if (listener) listener->onConstraintMoved(constraint, *to);
    }
    held_.clear();
}

}  // namespace sherd
