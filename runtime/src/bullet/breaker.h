// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "bullet/body_store.h"
#include "bullet/overlaps.h"
#include "bullet/solved_contacts.h"

namespace sherd {

/// Turns the contacts of a substep into breaks: measures, decides through the core, swaps bodies.
class Breaker {
  public:
    Breaker(btDynamicsWorld& world, BodyStore& store, const WorldOptions& options)
        : world_(world), store_(store), options_(options) {}

    /// Call when a substep has been solved and integrated. `inStep`: from within stepSimulation.
    void step(double time, float dt, bool inStep);
    /// Without a hit, between steps.
    /// Returns the bonds broken.
    uint32_t dealArea(uint32_t object, const AreaDamage& damage, double time);
    float reportHit(uint32_t island, const ReportedHit& hit, int child, double time);
    void breakFragment(uint32_t island, uint32_t fragment, bool whole, double time);
    void breakAll(uint32_t object, double time);
    /// Brings the bodies of an object in line with pins set or lifted.
    void followPins(uint32_t object, double time);
    void removeObject(uint32_t object);
    void replaceObject(uint32_t object, ObjectSnapshot&& snapshot);

    std::span<const BreakEvent> takeEvents();
    [[nodiscard]] size_t ignoredPairCount() const { return ignored_.size(); }

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
    [[nodiscard]] Hit hitOn(uint32_t island, int child, const btVector3& point) const;
    std::span<const uint32_t> split(uint32_t island);
    void splitAndReport(uint32_t island, uint32_t fragment, BreakEvent event);
    void addEvent(BreakEvent event, uint32_t island, uint32_t fragment, uint32_t bodies);
    void joinGroup(uint32_t parent, std::span<const uint32_t> bodies);
    void settleOverlaps();
    void forgetOverlaps(uint32_t object);

    btDynamicsWorld& world_;
    BodyStore& store_;
    WorldOptions options_;
    IgnoredPairs ignored_;
    SolvedContacts contacts_;
    double time_ = 0;
    bool inStep_ = false;

    std::vector<Meeting> meetings_;
    HitSolver solver_;
    HitResult hit_;
    std::vector<BreakEvent> pending_;
    std::vector<BreakEvent> taken_;
    struct Newcomer {
        uint32_t group;  ///< all that came out of one body in this step
        uint32_t island;
    };
    std::vector<Newcomer> newcomers_;
    uint32_t groupCount_ = 0;
    std::vector<std::pair<uint32_t, uint32_t>>
        inherited_;  ///< islands that overlapped as parts of others
    std::vector<btCollisionObject*> partners_;
};

}  // namespace sherd
