// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "bullet/bullet_bodies.h"
#include "bullet/solved_contacts.h"
#include "sherd/runtime/memory.h"

namespace sherd {

/// Turns the contacts of a substep into hits on islands: measures them, and when something comes
/// apart takes the contact back.
class Breaker {
  public:
    /// `leastImpact`: energy from which impacts are listed, J.
    Breaker(btDynamicsWorld& world, BulletBodies& bodies, IslandWorld& islands, float leastImpact)
        : world_(world), bodies_(bodies), islands_(islands), leastImpact_(leastImpact) {}

    /// Call when a substep has been solved and integrated. `inStep`: from within stepSimulation.
    /// Lists impacts.
    void measure(float dt, bool inStep);
    /// Lets the hits just measured do what they do.
    void breakWhatIsHit();

  private:
    struct Meeting {
        size_t pair;
        std::array<const btCollisionObject*, 2> bodies;  ///< until the first of all is changed
        Contact contact;
        float energy;
        std::array<uint32_t, 2> fragments;  ///< struck; shapes may change before their turn
    };
    struct Strike;

    void findMeetings();
    void seeRest();
    void listImpact(const Meeting& meeting);
    void applyMeeting(const Meeting& meeting);
    [[nodiscard]] bool canTakeDamage(uint32_t island, const Meeting& meeting) const;
    float strikeSide(Strike& strike, uint32_t side, const Contact& contact, float energy,
                     float& surplus);

    btDynamicsWorld& world_;
    BulletBodies& bodies_;
    IslandWorld& islands_;
    float leastImpact_;
    SolvedContacts contacts_;
    std::span<const Approach> approaches_;  ///< of this substep
    Vector<Meeting> meetings_;
    Vector<uint8_t> breakable_;  ///< by place in Bullet's world
};

}  // namespace sherd
