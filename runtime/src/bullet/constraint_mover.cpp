// SPDX-License-Identifier: MIT
// Bullet's constraints hold references to their bodies, so one that is to hold another body is made
// anew in its own place: the game's pointer stays good, and what it set is copied over. C++20 lets
// an object replace one of the same type there (basic.life, 8).
#include "bullet/constraint_mover.h"

#include <BulletDynamics/ConstraintSolver/btConeTwistConstraint.h>
#include <BulletDynamics/ConstraintSolver/btFixedConstraint.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofConstraint.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>
#include <BulletDynamics/ConstraintSolver/btHingeConstraint.h>
#include <BulletDynamics/ConstraintSolver/btPoint2PointConstraint.h>
#include <BulletDynamics/ConstraintSolver/btSliderConstraint.h>

#include <array>
#include <cmath>
#include <new>
#include <typeinfo>
#include <utility>

#include "bullet/point_distance.h"
#include "core/report.h"

namespace sherd {
namespace {

/// Both ends of a constraint, by the body's frames.
struct Ends {
    btTransform a, b;
};

btTransform at(const btVector3& pivot) {
    return btTransform(btMatrix3x3::getIdentity(), pivot);
}

/// For every kind of constraint: its ends, how to set them, what it is made of with other bodies,
/// and what else the game may have set.
Ends ends(btPoint2PointConstraint& c) {
    return {at(c.getPivotInA()), at(c.getPivotInB())};
}
void setEnds(btPoint2PointConstraint& c, const Ends& e) {
    c.setPivotA(e.a.getOrigin());
    c.setPivotB(e.b.getOrigin());
}
void remake(btPoint2PointConstraint* c, btRigidBody& a, btRigidBody& b, const Ends& e,
            btPoint2PointConstraint& old) {
    new (c) btPoint2PointConstraint(a, b, e.a.getOrigin(), e.b.getOrigin());
    c->m_setting = old.m_setting;
    c->m_useSolveConstraintObsolete = old.m_useSolveConstraintObsolete;
    if ((old.getFlags() & BT_P2P_FLAGS_ERP) != 0)
        c->setParam(BT_CONSTRAINT_ERP, old.getParam(BT_CONSTRAINT_ERP));
    if ((old.getFlags() & BT_P2P_FLAGS_CFM) != 0)
        c->setParam(BT_CONSTRAINT_CFM, old.getParam(BT_CONSTRAINT_CFM));
}

Ends ends(btHingeConstraint& c) {
    return {c.getAFrame(), c.getBFrame()};
}
void remake(btHingeConstraint* c, btRigidBody& a, btRigidBody& b, const Ends& e,
            btHingeConstraint& old) {
    new (c) btHingeConstraint(a, b, e.a, e.b, old.getUseReferenceFrameA());
    c->setLimit(old.getLowerLimit(), old.getUpperLimit(), old.getLimitSoftness(),
                old.getLimitBiasFactor(), old.getLimitRelaxationFactor());
    c->setAngularOnly(old.getAngularOnly());
    c->setUseFrameOffset(old.getUseFrameOffset());
    c->enableAngularMotor(old.getEnableAngularMotor(), old.getMotorTargetVelocity(),
                          old.getMaxMotorImpulse());
    const std::array<std::pair<int, int>, 4> params{
        {{BT_HINGE_FLAGS_CFM_STOP, BT_CONSTRAINT_STOP_CFM},
         {BT_HINGE_FLAGS_ERP_STOP, BT_CONSTRAINT_STOP_ERP},
         {BT_HINGE_FLAGS_CFM_NORM, BT_CONSTRAINT_CFM},
         {BT_HINGE_FLAGS_ERP_NORM, BT_CONSTRAINT_ERP}}};
    for (const auto& [flag, param] : params)
        if ((old.getFlags() & flag) != 0) c->setParam(param, old.getParam(param));
}

/// Which of the motors' numbers count, which Bullet lets nobody read, as a member of the base
/// class.
template <class SixDof>
struct FlagsOf : SixDof {
    static constexpr int SixDof::*kMember = &FlagsOf::m_flags;
};

/// A motor's numbers hold what it is tuned to, with the errors of its last step.
template <class SixDof>
void copyMotors(SixDof& c, SixDof& old) {
    *c.getTranslationalLimitMotor() = *old.getTranslationalLimitMotor();
    for (int i = 0; i < 3; ++i) *c.getRotationalLimitMotor(i) = *old.getRotationalLimitMotor(i);
    c.*FlagsOf<SixDof>::kMember = old.*FlagsOf<SixDof>::kMember;
}

Ends ends(btGeneric6DofConstraint& c) {
    return {c.getFrameOffsetA(), c.getFrameOffsetB()};
}
void remake(btGeneric6DofConstraint* c, btRigidBody& a, btRigidBody& b, const Ends& e,
            btGeneric6DofConstraint& old) {
    new (c) btGeneric6DofConstraint(a, b, e.a, e.b, old.getUseLinearReferenceFrameA());
    copyMotors(*c, old);
    c->setUseFrameOffset(old.getUseFrameOffset());
}

Ends ends(btGeneric6DofSpring2Constraint& c) {
    return {c.getFrameOffsetA(), c.getFrameOffsetB()};
}
void remake(btGeneric6DofSpring2Constraint* c, btRigidBody& a, btRigidBody& b, const Ends& e,
            btGeneric6DofSpring2Constraint& old) {
    new (c) btGeneric6DofSpring2Constraint(a, b, e.a, e.b, old.getRotationOrder());
    copyMotors(*c, old);
}
void remake(btFixedConstraint* c, btRigidBody& a, btRigidBody& b, const Ends& e,
            btFixedConstraint& old) {
    new (c) btFixedConstraint(a, b, e.a, e.b);
    copyMotors<btGeneric6DofSpring2Constraint>(*c, old);
}

Ends ends(btSliderConstraint& c) {
    return {c.getFrameOffsetA(), c.getFrameOffsetB()};
}
Ends ends(btConeTwistConstraint& c) {
    return {c.getAFrame(), c.getBFrame()};
}
template <class Constraint>
void setEnds(Constraint& c, const Ends& e) {
    c.setFrames(e.a, e.b);
}

template <class Constraint>
Constraint* exactly(btTypedConstraint& c) {
    return typeid(c) == typeid(Constraint) ? static_cast<Constraint*>(&c) : nullptr;
}

/// Calls `visit` with the constraint as what it is; false for a kind that is not known.
template <class Visit>
bool visitEnds(btTypedConstraint& c, const Visit& visit) {
    switch (c.getConstraintType()) {
        case POINT2POINT_CONSTRAINT_TYPE:
            visit(static_cast<btPoint2PointConstraint&>(c));
            return true;
        case HINGE_CONSTRAINT_TYPE:
            visit(static_cast<btHingeConstraint&>(c));
            return true;
        case D6_CONSTRAINT_TYPE:
        case D6_SPRING_CONSTRAINT_TYPE:
            visit(static_cast<btGeneric6DofConstraint&>(c));
            return true;
        case D6_SPRING_2_CONSTRAINT_TYPE:
        case FIXED_CONSTRAINT_TYPE:
            visit(static_cast<btGeneric6DofSpring2Constraint&>(c));
            return true;
        case SLIDER_CONSTRAINT_TYPE:
            visit(static_cast<btSliderConstraint&>(c));
            return true;
        case CONETWIST_CONSTRAINT_TYPE:
            visit(static_cast<btConeTwistConstraint&>(c));
            return true;
        default:
            return false;
    }
}

/// What every constraint has.
void copyCommon(btTypedConstraint& c, const btTypedConstraint& old) {
    c.setBreakingImpulseThreshold(old.getBreakingImpulseThreshold());
    c.setEnabled(old.isEnabled());
    c.setOverrideNumSolverIterations(old.getOverrideNumSolverIterations());
    c.setDbgDrawSize(const_cast<btTypedConstraint&>(old).getDbgDrawSize());
    c.setUserConstraintType(old.getUserConstraintType());
    c.setUserConstraintPtr(const_cast<btTypedConstraint&>(old).getUserConstraintPtr());
    if (old.needsFeedback()) {
        c.setJointFeedback(const_cast<btJointFeedback*>(old.getJointFeedback()));
        c.enableFeedback(true);
    }
}

template <class Constraint>
bool rebind(btTypedConstraint& constraint, btRigidBody& a, btRigidBody& b, const Ends& e) {
    Constraint* c = exactly<Constraint>(constraint);
    if (!c) return false;
    Constraint old(*c);
    c->~Constraint();
    remake(c, a, b, e, old);
    copyCommon(*c, old);
    return true;
}

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
        held.isMovable = visitEnds(constraint, [&](auto& c) {
            const Ends e = ends(c);
            held.frame = body.getWorldTransform() * (isA ? e.a : e.b);
        });
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
        Ends moved;
        visitEnds(constraint, [&](auto& c) { moved = ends(c); });
        (isA ? moved.a : moved.b) = to->getWorldTransform().inverse() * held.frame;
        if (to == &old) {
            visitEnds(constraint, [&](auto& c) { setEnds(c, moved); });
            continue;
        }
        btRigidBody& a = isA ? *to : constraint.getRigidBodyA();
        btRigidBody& b = isA ? constraint.getRigidBodyB() : *to;
        const bool isLinkedPair = isLinked(old, &constraint);
        world_.removeConstraint(&constraint);
        const bool isMoved = rebind<btPoint2PointConstraint>(constraint, a, b, moved) ||
                             rebind<btHingeConstraint>(constraint, a, b, moved) ||
                             rebind<btGeneric6DofConstraint>(constraint, a, b, moved) ||
                             rebind<btGeneric6DofSpring2Constraint>(constraint, a, b, moved) ||
                             rebind<btFixedConstraint>(constraint, a, b, moved);
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
