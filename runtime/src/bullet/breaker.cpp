// SPDX-License-Identifier: MIT
#include "bullet/breaker.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bullet/convert.h"

namespace sherd {
namespace {

constexpr uint32_t kNoIsland = UINT32_MAX;

/// Contacts that carried at least this share of a hit's impulse were part of its shock (the ground
/// under a struck vase) and are taken back with it; weaker ones only carried weight.
constexpr float kShockShare = 0.05F;

/// What a plastic impact between the two would be now.
Contact contactNow(const btCollisionObject& a, const btCollisionObject& b, const btVector3& point,
                   const btVector3& normal) {
    Contact contact;
    const btVector3 relative =
        velocityAt(a, motionNow(a), point) - velocityAt(b, motionNow(b), point);
    contact.approachSpeed = -relative.dot(normal);
    contact.effectiveMass = effectiveMass(a, b, point, normal);
    contact.impulse = contact.effectiveMass * std::max(contact.approachSpeed, 0.0F);
    return contact;
}

/// Slows a's motion against b along `direction` until `energy` is gone, or the motion is. The
/// impulse j with j v - j^2 / (2 m) = energy takes exactly that. Returns what was taken, J.
float takeEnergy(btCollisionObject& a, btCollisionObject& b, const btVector3& point,
                 const btVector3& direction, float energy) {
    const Contact now = contactNow(a, b, point, -direction);
    if (!(now.approachSpeed > 0) || !(now.effectiveMass > 0)) return 0;
    const float available = 0.5F * now.effectiveMass * now.approachSpeed * now.approachSpeed;
    const float taken = std::min(energy, available);
    const float left = now.approachSpeed * std::sqrt(std::max(1 - taken / available, 0.0F));
    applyPair(a, b, point, direction * (-now.effectiveMass * (now.approachSpeed - left)));
    return taken;
}

}  // namespace

/// Two bodies that hit each other.
struct Breaker::Strike {
    const Meeting& meeting;
    std::array<btCollisionObject*, 2> bodies{};
    std::array<uint32_t, 2> fragments{};
    btVector3 point{0, 0, 0};
    btVector3 normal{0, 0, 0};  ///< from bodies[1] to bodies[0]
};

void Breaker::measure(float dt, bool inStep) {
    approaches_ = bodies_.approaches().approaches();
    if (!bodies_.approaches().sawAll() || !contacts_.gather(world_, dt, inStep, approaches_)) {
        bodies_.markBreakable(breakable_);
        contacts_.gather(world_, dt, inStep, std::min(islands_.leastEnergy(), leastImpact_),
                         breakable_, approaches_);
    }
    findMeetings();
}

void Breaker::breakWhatIsHit() {
    for (const Meeting& meeting : meetings_) applyMeeting(meeting);
}

bool Breaker::canTakeDamage(uint32_t island, const Meeting& meeting) const {
    return island != kNoIsland &&
           islands_.canTakeDamage(island, meeting.energy, meeting.contact.impulse);
}

void Breaker::findMeetings() {
    meetings_.clear();
    for (size_t p = 0; p < contacts_.pairs().size(); ++p) {
        const SolvedPair& pair = contacts_.pairs()[p];
        const btCollisionObject& a = *contacts_.body(pair.a);
        const btCollisionObject& b = *contacts_.body(pair.b);
        const std::array<uint32_t, 2> islands{bodies_.islandOf(a), bodies_.islandOf(b)};
        const bool ours = islands[0] != kNoIsland || islands[1] != kNoIsland;
        if (!ours || !(pair.normalImpulse > 0)) continue;
        const auto velocity = [&](uint32_t index) {
            return velocityAt(*contacts_.body(index), contacts_.motionBefore(index), pair.point) -
                   contacts_.pushOfForces(index);
        };
        Meeting meeting{p, {&a, &b}, {}, 0, {}};
        if (islands[0] != kNoIsland)
            meeting.fragments[0] = bodies_.fragmentAt(islands[0], pair.childA, pair.point);
        if (islands[1] != kNoIsland)
            meeting.fragments[1] = bodies_.fragmentAt(islands[1], pair.childB, pair.point);
        Contact& contact = meeting.contact;
        contact.approachSpeed = -(velocity(pair.a) - velocity(pair.b)).dot(pair.normal);
        contact.effectiveMass = effectiveMass(a, b, pair.point, pair.normal);
        contact.impulse = pair.normalImpulse;
        // Bullet brakes bodies that would meet within the substep only down to just meeting, and
        // stops them in the next. One hit must not count as two weaker ones.
        const Contact rest = contactNow(a, b, pair.point, pair.normal);
        if (pair.gap > 0 && rest.approachSpeed > 0) contact.impulse += rest.impulse;
        meeting.energy = contactEnergy(contact);
        if (meeting.energy >= leastImpact_) listImpact(meeting);
        if (canTakeDamage(islands[0], meeting) || canTakeDamage(islands[1], meeting))
            meetings_.push_back(meeting);
    }
    std::sort(meetings_.begin(), meetings_.end(), [](const Meeting& x, const Meeting& y) {
        return std::pair(-x.energy, x.pair) < std::pair(-y.energy, y.pair);
    });
}

/// What comes apart gives others back what it took from them: now all contacts count.
void Breaker::seeRest() {
    if (contacts_.isWhole()) return;
    contacts_.gatherRest(world_, approaches_);
    for (Meeting& meeting : meetings_)
        meeting.pair = contacts_.find(*meeting.bodies[0], *meeting.bodies[1]);
}

void Breaker::listImpact(const Meeting& meeting) {
    const SolvedPair& pair = contacts_.pairs()[meeting.pair];
    ReportedHit hit;
    hit.point = toGlm(pair.point);
    hit.energy = meeting.energy;
    hit.speed = meeting.contact.approachSpeed;
    hit.impulse = meeting.contact.impulse;
    for (const uint32_t side : {0U, 1U}) {
        const uint32_t island = bodies_.islandOf(*contacts_.body(side == 0 ? pair.a : pair.b));
        hit.normal = toGlm(side == 0 ? pair.normal : -pair.normal);
        if (island != kNoIsland) islands_.addImpact(island, meeting.fragments[side], hit);
    }
}

/// The weaker side takes damage first, the other from what is left. If something comes apart, the
/// contact is taken back, and breaking has consumed part of the approach: what remains of it meets
/// the islands instead of the whole in the next substep.
void Breaker::applyMeeting(const Meeting& meeting) {
    const SolvedPair& pair = contacts_.pairs()[meeting.pair];
    Strike strike{meeting,
                  {contacts_.body(pair.a), contacts_.body(pair.b)},
                  meeting.fragments,
                  pair.point,
                  pair.normal};
    if (!strike.bodies[0] || !strike.bodies[1]) return;  // came apart by a harder hit just now
    // Another hit may have taken this contact back, and used up its energy.
    Meeting now = meeting;
    if (pair.undone) {
        now.contact = contactNow(*strike.bodies[0], *strike.bodies[1], strike.point, strike.normal);
        now.energy = contactEnergy(now.contact);
    }
    const auto strengthOf = [&](uint32_t side) {
        const uint32_t island = bodies_.islandOf(*strike.bodies[side]);
        if (island == kNoIsland) return HUGE_VALF;
        const IslandWorld::Object& object = islands_.objectOf(island);
        return object.asset->fragment(strike.fragments[side]).strength *
               object.damage.strengthScale;
    };
    const uint32_t weaker = strengthOf(1) < strengthOf(0) ? 1 : 0;
    float surplus = 0;
    for (const uint32_t side : {weaker, 1 - weaker}) {
        if (canTakeDamage(bodies_.islandOf(*strike.bodies[side]), now))
            now.energy -= strikeSide(strike, side, now.contact, now.energy, surplus);
    }
}

/// Returns what was consumed. `surplus`: energy that taking the contact back has made, still to be
/// taken from the two.
float Breaker::strikeSide(Strike& strike, uint32_t side, const Contact& contact, float energy,
                          float& surplus) {
    const uint32_t island = bodies_.islandOf(*strike.bodies[side]);
    const uint32_t fragment = strike.fragments[side];
    const uint32_t object = islands_.island(island).object;
    const HitResult& hit =
        islands_.strike(island, fragment, toGlm(strike.point), energy, contact.approachSpeed);
    const float consumed = hit.consumed;
    const uint32_t struck = hit.struck;
    if (!hit.brokeSomething()) return consumed;
    seeRest();

    BreakEvent event;
    event.point = toGlm(strike.point);
    event.normal = toGlm(side == 0 ? strike.normal : -strike.normal);
    event.impulse = contact.impulse;
    event.energy = energy;
    event.fragment = fragment;
    event.approachSpeed = contact.approachSpeed;
    if (islands_.regroup(island) == IslandWorld::Change::apart) {
        const SolvedPair& pair = contacts_.pairs()[strike.meeting.pair];
        surplus += contacts_.undoAround(strike.meeting.pair, kShockShare * pair.normalImpulse);
        // Along the normal first; a graze that has too little there gives the rest sideways, as
        // friction.
        const float wanted = consumed + surplus;
        const float taken =
            takeEnergy(*strike.bodies[0], *strike.bodies[1], strike.point, -strike.normal, wanted);
        if (taken < wanted) {
            const btVector3 sliding =
                velocityAt(*strike.bodies[0], motionNow(*strike.bodies[0]), strike.point) -
                velocityAt(*strike.bodies[1], motionNow(*strike.bodies[1]), strike.point);
            if (sliding.length2() > 0)
                takeEnergy(*strike.bodies[0], *strike.bodies[1], strike.point, sliding.normalized(),
                           wanted - taken);
        }
        surplus = 0;
        contacts_.forget(side == 0 ? pair.a : pair.b);
    } else if (bodies_.isAdopted(island)) {
        const SolvedPair& pair = contacts_.pairs()[strike.meeting.pair];
        contacts_.forget(side == 0 ? pair.a : pair.b);  // it gives way, and may be deleted
    }
    (void)islands_.split(island, event);
    const uint32_t now = islands_.findIsland(object, struck);
    if (now != kNoIsland) strike.bodies[side] = &bodies_.body(now);
    return consumed;
}

}  // namespace sherd
