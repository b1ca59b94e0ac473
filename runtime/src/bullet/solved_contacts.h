// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cstdint>
#include <span>

#include "bullet/approach_watch.h"
#include "bullet/body_motion.h"
#include "sherd/runtime/memory.h"

class btCollisionWorld;

namespace sherd {

/// All contact points of two bodies in the substep just solved, as one.
struct SolvedPair {
    uint32_t a = 0;  ///< into SolvedContacts::bodies
    uint32_t b = 0;
    uint32_t order = 0;         ///< of its first manifold among all
    btVector3 normal{0, 0, 0};  ///< unit, from b to a
    btVector3 point{0, 0, 0};   ///< world; where the impulses' mean acts
    float normalImpulse = 0;    ///< N s
    int childA = -1;            ///< of a's compound, where the largest impulse acted; -1: none
    int childB = -1;
    float largestImpulse = 0;    ///< of one point, N s
    float gap = BT_LARGE_FLOAT;  ///< least distance of its points, metres; negative: penetrating
    btVector3 impulse{0, 0, 0};  ///< on a, with friction; b got the opposite, N s
    btVector3 twistA{0, 0, 0};   ///< moment of the impulses about `point`, on a, N m s
    btVector3 twistB{0, 0, 0};   ///< b got the opposite of this one
    bool undone = false;
};

/// What the solver did in the substep just done, read from Bullet's contact points, which hold the
/// impulses applied until the next substep. Subtracting them gives the velocity from before the
/// contact of every body that was not asked, and noted, by an ApproachWatch.
class SolvedContacts {
  public:
    /// Reads the world's contacts after a substep of `dt` seconds. Sleeping pairs are skipped:
    /// their impulses are old. `inStep`: Bullet has not yet cleared the forces of the step.
    /// Where no contact of what may break (`breakable`: by place in Bullet's world) can have
    /// brought `leastEnergy`, J, there are no pairs.
    void gather(btCollisionWorld& world, float dt, bool inStep, float leastEnergy,
                std::span<const uint8_t> breakable, std::span<const Approach> approaches);
    /// Reads only those pairs. False when Bullet no longer knows all of them: then all must be.
    bool gather(btCollisionWorld& world, float dt, bool inStep,
                std::span<const Approach> approaches);
    /// Reads the rest, before the first of the bodies changes. Places in `pairs` are others then.
    void gatherRest(btCollisionWorld& world, std::span<const Approach> approaches);
    [[nodiscard]] bool isWhole() const { return isWhole_; }
    /// Place of the pair of two bodies, before either changes; pairs().size(): they do not touch.
    [[nodiscard]] size_t find(const btCollisionObject& a, const btCollisionObject& b) const;

    [[nodiscard]] const Vector<SolvedPair>& pairs() const { return pairs_; }
    /// Null once `forget` was called.
    [[nodiscard]] btCollisionObject* body(uint32_t index) const { return bodies_[index]; }

    /// Velocity from before the solve, m/s and rad/s, with what forces added in this substep.
    [[nodiscard]] Motion motionBefore(uint32_t index) const;

    /// What gravity and other forces added to the velocity in this substep, m/s. A contact that
    /// only takes this away again carries weight; it is no hit.
    [[nodiscard]] btVector3 pushOfForces(uint32_t index) const;

    /// Gives the bodies of the pair, and those that passed at least `leastImpulse` on to each
    /// other, their velocities from before the solve. Every pair is undone whole on both sides, so
    /// neither linear nor angular momentum is made. Weaker contacts (supported weight) keep their
    /// impulse. Returns the kinetic energy that the bodies have too much, J: they have moved since,
    /// and keeping angular momentum right at their new places costs a little exactness in their
    /// spins.
    float undoAround(size_t pair, float leastImpulse);

    /// The body is about to be deleted.
    void forget(uint32_t index) { bodies_[index] = nullptr; }

  private:
    void begin(const btCollisionWorld& world);
    void gatherAll(btCollisionWorld& world);
    void takeNoted(const btCollisionWorld& world, std::span<const Approach> approaches);
    void addManifold(const btPersistentManifold& manifold);
    uint32_t localIndex(btCollisionObject& body, const btVector3& contactPoint,
                        const btVector3& inBody);
    [[nodiscard]] btVector3 pushOn(const btRigidBody& body) const;
    bool mayMatter(btCollisionWorld& world, float leastEnergy, std::span<const uint8_t> breakable);
    bool findNear(btCollisionWorld& world, std::span<const uint8_t> breakable);
    void mergePairs();
    void linkBodies();
    void undo(SolvedPair& pair);
    [[nodiscard]] btVector3 moved(uint32_t index) const;
    float surplusEnergy();

    Vector<SolvedPair> pairs_;
    Vector<btCollisionObject*> bodies_;
    struct Rough {
        const btRigidBody* body;
        btVector3 linear, angular;  ///< impulse received, and its moment
    };
    Vector<Rough> rough_;
    Vector<uint8_t> near_;     ///< by Bullet's world array index: may break, or touches what may
    Vector<Motion> received_;  ///< per body: impulse, and moment about its centre of mass
    Vector<Motion> before_;    ///< per body
    Vector<uint32_t> noted_;   ///< per body: sequence of the note its motion is from, and 1
    Vector<btTransform> posesBefore_;  ///< per body; the impulses acted there
    Vector<uint32_t> touched_;         ///< bodies whose velocity the last undo changed
    float dt_ = 0;
    bool inStep_ = false;
    bool isWhole_ = true;
    btManifoldArray manifolds_;   ///< of a pair
    Vector<uint32_t> localOf_;    ///< by Bullet's world array index
    Vector<uint32_t> firstLink_;  ///< per body, into links_
    Vector<uint32_t> links_;      ///< pairs
    Vector<size_t> queue_;        ///< pairs whose bodies are still to be spread from
};

}  // namespace sherd
