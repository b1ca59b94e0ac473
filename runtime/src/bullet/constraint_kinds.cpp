// SPDX-License-Identifier: MIT
// Bullet's constraints hold references to their bodies: to hold another one they are made anew.
// C++20 lets an object replace one of the same type in its place (basic.life, 8).
#include "bullet/constraint_kinds.h"

#include <BulletDynamics/ConstraintSolver/btConeTwistConstraint.h>
#include <BulletDynamics/ConstraintSolver/btFixedConstraint.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofConstraint.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>
#include <BulletDynamics/ConstraintSolver/btHingeConstraint.h>
#include <BulletDynamics/ConstraintSolver/btPoint2PointConstraint.h>
#include <BulletDynamics/ConstraintSolver/btSliderConstraint.h>

#include <array>
#include <new>
#include <typeinfo>
#include <utility>

namespace sherd {
namespace {

/// A number that counts only where its flag is set, and can be read only then.
struct Param {
    int flag, param;
    int axis = -1;
};
template <class Constraint, size_t N>
void copyParams(Constraint& c, const Constraint& old, const std::array<Param, N>& params) {
    for (const Param& p : params)
        if ((old.getFlags() & p.flag) != 0)
            c.setParam(p.param, old.getParam(p.param, p.axis), p.axis);
}

btTransform at(const btVector3& pivot) {
    return btTransform(btMatrix3x3::getIdentity(), pivot);
}

/// For every kind of constraint: its ends, how to set them, what it is made of with other bodies,
/// and what else the game may have set.
template <class Constraint>
Ends ends(Constraint& c) {
    return {c.getFrameOffsetA(), c.getFrameOffsetB()};
}

Ends ends(btPoint2PointConstraint& c) {
    return {at(c.getPivotInA()), at(c.getPivotInB())};
}
void setEndsOf(btPoint2PointConstraint& c, const Ends& e) {
    c.setPivotA(e.a.getOrigin());
    c.setPivotB(e.b.getOrigin());
}
void remake(btPoint2PointConstraint* c, btRigidBody& a, btRigidBody& b, const Ends& e,
            btPoint2PointConstraint& old) {
    new (c) btPoint2PointConstraint(a, b, e.a.getOrigin(), e.b.getOrigin());
    c->m_setting = old.m_setting;
    c->m_useSolveConstraintObsolete = old.m_useSolveConstraintObsolete;
    const std::array<Param, 2> params{
        {{BT_P2P_FLAGS_ERP, BT_CONSTRAINT_ERP}, {BT_P2P_FLAGS_CFM, BT_CONSTRAINT_CFM}}};
    copyParams(*c, old, params);
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
    const std::array<Param, 4> params{{{BT_HINGE_FLAGS_CFM_STOP, BT_CONSTRAINT_STOP_CFM},
                                       {BT_HINGE_FLAGS_ERP_STOP, BT_CONSTRAINT_STOP_ERP},
                                       {BT_HINGE_FLAGS_CFM_NORM, BT_CONSTRAINT_CFM},
                                       {BT_HINGE_FLAGS_ERP_NORM, BT_CONSTRAINT_ERP}}};
    copyParams(*c, old, params);
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

void remake(btGeneric6DofConstraint* c, btRigidBody& a, btRigidBody& b, const Ends& e,
            btGeneric6DofConstraint& old) {
    new (c) btGeneric6DofConstraint(a, b, e.a, e.b, old.getUseLinearReferenceFrameA());
    copyMotors(*c, old);
    c->setUseFrameOffset(old.getUseFrameOffset());
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

void remake(btSliderConstraint* c, btRigidBody& a, btRigidBody& b, const Ends& e,
            btSliderConstraint& old) {
    new (c) btSliderConstraint(a, b, e.a, e.b, old.getUseLinearReferenceFrameA());
    c->setLowerLinLimit(old.getLowerLinLimit());
    c->setUpperLinLimit(old.getUpperLinLimit());
    c->setLowerAngLimit(old.getLowerAngLimit());
    c->setUpperAngLimit(old.getUpperAngLimit());
    c->setUseFrameOffset(old.getUseFrameOffset());
    c->setPoweredLinMotor(old.getPoweredLinMotor());
    c->setTargetLinMotorVelocity(old.getTargetLinMotorVelocity());
    c->setMaxLinMotorForce(old.getMaxLinMotorForce());
    c->setPoweredAngMotor(old.getPoweredAngMotor());
    c->setTargetAngMotorVelocity(old.getTargetAngMotorVelocity());
    c->setMaxAngMotorForce(old.getMaxAngMotorForce());
    // Along and about the axis, at its limits, and across it: first what only some may read, as it
    // sets softness, too.
    const std::array<Param, 12> params{{{BT_SLIDER_FLAGS_CFM_DIRLIN, BT_CONSTRAINT_CFM, 0},
                                        {BT_SLIDER_FLAGS_ERP_DIRLIN, BT_CONSTRAINT_ERP, 0},
                                        {BT_SLIDER_FLAGS_CFM_DIRANG, BT_CONSTRAINT_CFM, 3},
                                        {BT_SLIDER_FLAGS_ERP_DIRANG, BT_CONSTRAINT_ERP, 3},
                                        {BT_SLIDER_FLAGS_CFM_ORTLIN, BT_CONSTRAINT_STOP_CFM, 1},
                                        {BT_SLIDER_FLAGS_ERP_ORTLIN, BT_CONSTRAINT_STOP_ERP, 1},
                                        {BT_SLIDER_FLAGS_CFM_ORTANG, BT_CONSTRAINT_STOP_CFM, 4},
                                        {BT_SLIDER_FLAGS_ERP_ORTANG, BT_CONSTRAINT_STOP_ERP, 4},
                                        {BT_SLIDER_FLAGS_CFM_LIMLIN, BT_CONSTRAINT_STOP_CFM, 0},
                                        {BT_SLIDER_FLAGS_ERP_LIMLIN, BT_CONSTRAINT_STOP_ERP, 0},
                                        {BT_SLIDER_FLAGS_CFM_LIMANG, BT_CONSTRAINT_STOP_CFM, 3},
                                        {BT_SLIDER_FLAGS_ERP_LIMANG, BT_CONSTRAINT_STOP_ERP, 3}}};
    copyParams(*c, old, params);
    c->setSoftnessDirLin(old.getSoftnessDirLin());
    c->setRestitutionDirLin(old.getRestitutionDirLin());
    c->setDampingDirLin(old.getDampingDirLin());
    c->setSoftnessDirAng(old.getSoftnessDirAng());
    c->setRestitutionDirAng(old.getRestitutionDirAng());
    c->setDampingDirAng(old.getDampingDirAng());
    c->setSoftnessLimLin(old.getSoftnessLimLin());
    c->setRestitutionLimLin(old.getRestitutionLimLin());
    c->setDampingLimLin(old.getDampingLimLin());
    c->setSoftnessLimAng(old.getSoftnessLimAng());
    c->setRestitutionLimAng(old.getRestitutionLimAng());
    c->setDampingLimAng(old.getDampingLimAng());
    c->setSoftnessOrthoLin(old.getSoftnessOrthoLin());
    c->setRestitutionOrthoLin(old.getRestitutionOrthoLin());
    c->setDampingOrthoLin(old.getDampingOrthoLin());
    c->setSoftnessOrthoAng(old.getSoftnessOrthoAng());
    c->setRestitutionOrthoAng(old.getRestitutionOrthoAng());
    c->setDampingOrthoAng(old.getDampingOrthoAng());
}

Ends ends(btConeTwistConstraint& c) {
    return {c.getAFrame(), c.getBFrame()};
}
void remake(btConeTwistConstraint* c, btRigidBody& a, btRigidBody& b, const Ends& e,
            btConeTwistConstraint& old) {
    new (c) btConeTwistConstraint(a, b, e.a, e.b);
    c->setAngularOnly(old.getAngularOnly());
    c->setLimit(old.getSwingSpan1(), old.getSwingSpan2(), old.getTwistSpan(),
                old.getLimitSoftness(), old.getBiasFactor(), old.getRelaxationFactor());
    c->setDamping(old.getDamping());
    c->setFixThresh(old.getFixThresh());
    c->enableMotor(old.isMotorEnabled());
    if (old.isMaxMotorImpulseNormalized())
        c->setMaxMotorImpulseNormalized(old.getMaxMotorImpulse());
    else
        c->setMaxMotorImpulse(old.getMaxMotorImpulse());
    const btScalar length2 = old.getMotorTarget().length2();
    if (length2 > 0.99F && length2 < 1.01F)
        c->setMotorTargetInConstraintSpace(old.getMotorTarget());
    const std::array<Param, 3> params{{{BT_CONETWIST_FLAGS_LIN_CFM, BT_CONSTRAINT_CFM, 0},
                                       {BT_CONETWIST_FLAGS_LIN_ERP, BT_CONSTRAINT_ERP, 0},
                                       {BT_CONETWIST_FLAGS_ANG_CFM, BT_CONSTRAINT_CFM, 3}}};
    copyParams(*c, old, params);
}

template <class Constraint>
void setEndsOf(Constraint& c, const Ends& e) {
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

/// Before it is copied.
template <class Constraint>
void define(Constraint& /*constraint*/) {}
/// Bullet leaves what a motor is open until it is set, and the target, too.
void define(btConeTwistConstraint& c) {
    if (!(c.getMaxMotorImpulse() >= 0)) c.setMaxMotorImpulse(c.getMaxMotorImpulse());
}

template <class Constraint>
bool rebindAs(btTypedConstraint& constraint, btRigidBody& a, btRigidBody& b, const Ends& e) {
    Constraint* c = exactly<Constraint>(constraint);
    if (!c) return false;
    define(*c);
    Constraint old(*c);
    c->~Constraint();
    remake(c, a, b, e, old);
    copyCommon(*c, old);
    return true;
}

}  // namespace

std::optional<Ends> endsOf(btTypedConstraint& constraint) {
    std::optional<Ends> result;
    visitEnds(constraint, [&](auto& c) { result = ends(c); });
    return result;
}

void setEnds(btTypedConstraint& constraint, const Ends& to) {
    visitEnds(constraint, [&](auto& c) { setEndsOf(c, to); });
}

bool rebind(btTypedConstraint& constraint, btRigidBody& a, btRigidBody& b, const Ends& to) {
    return rebindAs<btPoint2PointConstraint>(constraint, a, b, to) ||
           rebindAs<btHingeConstraint>(constraint, a, b, to) ||
           rebindAs<btGeneric6DofConstraint>(constraint, a, b, to) ||
           rebindAs<btGeneric6DofSpring2Constraint>(constraint, a, b, to) ||
           rebindAs<btFixedConstraint>(constraint, a, b, to) ||
           rebindAs<btSliderConstraint>(constraint, a, b, to) ||
           rebindAs<btConeTwistConstraint>(constraint, a, b, to);
}

}  // namespace sherd
