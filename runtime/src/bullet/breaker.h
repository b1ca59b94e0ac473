// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bullet/bullet_bodies.h"
#include "bullet/solved_contacts.h"

namespace sherd {

/// Turns the contacts of a substep into hits on islands: measures them, and when something comes
/// apart takes the contact back.
class Breaker {
  public:
    Breaker(btDynamicsWorld& world, BulletBodies& bodies, IslandWorld& islands)
        : world_(world), bodies_(bodies), islands_(islands) {}

    /// Call when a substep has been solved and integrated. `inStep`: from within stepSimulation.
    void step(float dt, bool inStep);

  private:
    struct Meeting {
        size_t pair;
        Contact contact;
        float energy;
    };
    struct Strike;

    void findMeetings();
    void applyMeeting(const Meeting& meeting);
    [[nodiscard]] bool canTakeDamage(uint32_t island, const Meeting& meeting) const;
    float strikeSide(Strike& strike, uint32_t side, const Contact& contact, float energy,
                     float& surplus);

    btDynamicsWorld& world_;
    BulletBodies& bodies_;
    IslandWorld& islands_;
    SolvedContacts contacts_;
    std::vector<Meeting> meetings_;
    std::vector<uint8_t> breakable_;  ///< by place in Bullet's world
};

}  // namespace sherd
