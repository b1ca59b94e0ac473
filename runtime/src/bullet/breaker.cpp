// SPDX-License-Identifier: MIT
#include "bullet/breaker.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

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
    size_t pair;
    std::array<btCollisionObject*, 2> bodies{};
    std::array<int, 2> children{};  ///< of their shapes
    btVector3 point{0, 0, 0};
    btVector3 normal{0, 0, 0};  ///< from bodies[1] to bodies[0]
};

void Breaker::step(double time, float dt, bool inStep) {
    time_ = time;
    inStep_ = inStep;
    ignored_.releaseSeparated();
    store_.readPoses();
    if (store_.bodyCount() == 0 || !options_.authority) return;
    contacts_.gather(world_, dt, inStep);
    findMeetings();
    for (const Meeting& meeting : meetings_) applyMeeting(meeting);
    if (!meetings_.empty()) settleOverlaps();
}

bool Breaker::canTakeDamage(uint32_t index, const Meeting& meeting) const {
    if (index == kNoIsland) return false;
    const IslandBody& island = store_.island(index);
    const Object& object = store_.object(island.object);
    const DamageOptions& damage = object.options.damage;
    if (meeting.energy < damage.minimumEnergy || meeting.contact.impulse < damage.minimumImpulse ||
        time_ - island.bornAt < double(damage.immunity) || damage.maxLevel == 0)
        return false;
    return island.fragments.size() > 1 || island.isAnchored ||
           isBreakable(object.asset(), island.fragments.front(), damage);
}

void Breaker::findMeetings() {
    meetings_.clear();
    for (size_t p = 0; p < contacts_.pairs().size(); ++p) {
        const SolvedPair& pair = contacts_.pairs()[p];
        const btCollisionObject& a = *contacts_.body(pair.a);
        const btCollisionObject& b = *contacts_.body(pair.b);
        const std::array<uint32_t, 2> islands{store_.islandOf(a), store_.islandOf(b)};
        const bool ours = islands[0] != kNoIsland || islands[1] != kNoIsland;
        if (!ours || !(pair.normalImpulse > 0)) continue;
        const auto velocity = [&](uint32_t index) {
            return velocityAt(*contacts_.body(index), contacts_.motionBefore(index), pair.point) -
                   contacts_.pushOfForces(index);
        };
        Meeting meeting{p, {}, 0};
        Contact& contact = meeting.contact;
        contact.approachSpeed = -(velocity(pair.a) - velocity(pair.b)).dot(pair.normal);
        contact.effectiveMass = effectiveMass(a, b, pair.point, pair.normal);
        contact.impulse = pair.normalImpulse;
        // Bullet brakes bodies that would meet within the substep only down to just meeting, and
        // stops them in the next. One hit must not count as two weaker ones.
        const Contact rest = contactNow(a, b, pair.point, pair.normal);
        if (pair.gap > 0 && rest.approachSpeed > 0) contact.impulse += rest.impulse;
        meeting.energy = contactEnergy(contact);
        if (canTakeDamage(islands[0], meeting) || canTakeDamage(islands[1], meeting))
            meetings_.push_back(meeting);
    }
    std::stable_sort(meetings_.begin(), meetings_.end(),
                     [](const Meeting& x, const Meeting& y) { return x.energy > y.energy; });
}

/// The weaker side takes damage first, the other from what is left. If something comes apart, the
/// contact is taken back, and breaking has consumed part of the approach: what remains of it meets
/// the islands instead of the whole in the next substep.
void Breaker::applyMeeting(const Meeting& meeting) {
    const SolvedPair& pair = contacts_.pairs()[meeting.pair];
    Strike strike{meeting.pair,
                  {contacts_.body(pair.a), contacts_.body(pair.b)},
                  {pair.childA, pair.childB},
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
        const uint32_t island = store_.islandOf(*strike.bodies[side]);
        if (island == kNoIsland) return HUGE_VALF;
        const Object& object = store_.object(store_.island(island).object);
        const uint32_t fragment = store_.fragmentOf(island, strike.children[side]);
        return object.asset().fragment(fragment).strength * object.options.damage.strengthScale;
    };
    const uint32_t weaker = strengthOf(1) < strengthOf(0) ? 1 : 0;
    float surplus = 0;
    for (const uint32_t side : {weaker, 1 - weaker}) {
        if (canTakeDamage(store_.islandOf(*strike.bodies[side]), now))
            now.energy -= strikeSide(strike, side, now.contact, now.energy, surplus);
    }
}

/// Returns what was consumed. `surplus`: energy that taking the contact back has made, still to be
/// taken from the two.
float Breaker::strikeSide(Strike& strike, uint32_t side, const Contact& contact, float energy,
                          float& surplus) {
    btCollisionObject& body = *strike.bodies[side];
    const uint32_t index = store_.islandOf(body);
    const IslandBody& island = store_.island(index);
    const Object& object = store_.object(island.object);
    Hit hit = hitOn(index, strike.children[side], strike.point);
    hit.energy = energy;
    hit.stress = contactStress(object.asset(), hit.fragment, contact.approachSpeed);
    solver_.apply(store_.structureOf(index), hit, object.options.damage, hit_);
    if (!hit_.brokeSomething()) return hit_.consumed;

    BreakEvent event;
    event.point = toGlm(strike.point);
    event.normal = toGlm(side == 0 ? strike.normal : -strike.normal);
    event.impulse = contact.impulse;
    event.energy = energy;
    event.consumed = hit_.consumed;
    event.approachSpeed = contact.approachSpeed;
    if (store_.regroup(index) == BodyStore::Change::apart) {
        const SolvedPair& pair = contacts_.pairs()[strike.pair];
        surplus += contacts_.undoAround(strike.pair, kShockShare * pair.normalImpulse);
        // Along the normal first; a graze that has too little there gives the rest sideways, as
        // friction.
        const float wanted = hit_.consumed + surplus;
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
    }
    const auto bodies = split(index);
    addEvent(event, index, hit.fragment, uint32_t(bodies.size()) - 1);
    for (const uint32_t part : bodies) {
        const std::vector<uint32_t>& fragments = store_.island(part).fragments;
        if (std::binary_search(fragments.begin(), fragments.end(), hit_.struck))
            strike.bodies[side] = store_.island(part).body.get();
    }
    return hit_.consumed;
}

Hit Breaker::hitOn(uint32_t index, int child, const btVector3& point) const {
    const IslandBody& island = store_.island(index);
    Hit hit;
    hit.fragment = store_.fragmentOf(index, child);
    hit.point = toGlm(island.frame * (island.body->getWorldTransform().inverse() * point));
    return hit;
}

void Breaker::addEvent(BreakEvent event, uint32_t index, uint32_t fragment, uint32_t bodies) {
    const uint32_t object = store_.island(index).object;
    event.object = store_.idOf(object);
    event.asset = &store_.object(object).asset();
    event.fragment = fragment;
    event.level = hit_.level;
    event.bonds = uint32_t(hit_.bonds.size());
    event.area = hit_.area;
    event.bodies = bodies;
    event.time = time_;
    if (pending_.size() < options_.maxPendingEvents) pending_.push_back(event);
}

/// What the last `regroup` of the store found.
std::span<const uint32_t> Breaker::split(uint32_t index) {
    partners_.clear();
    ignored_.remove(*store_.island(index).body, partners_);
    const std::span<const uint32_t> bodies = store_.split(index, time_, inStep_);
    joinGroup(index, bodies);
    return bodies;
}

/// Notes which pairs must be tested for overlap: the bodies with each other (and with what else
/// came out of the same one in this step), and with whatever they still overlapped as one.
void Breaker::joinGroup(uint32_t parent, std::span<const uint32_t> bodies) {
    uint32_t group = groupCount_;
    const auto self = std::find_if(newcomers_.begin(), newcomers_.end(),
                                   [&](const Newcomer& n) { return n.island == parent; });
    if (self == newcomers_.end()) {
        ++groupCount_;
    } else {
        group = self->group;
        newcomers_.erase(self);
    }
    for (const uint32_t island : bodies) newcomers_.push_back({group, island});

    for (btCollisionObject* partner : partners_) {
        inherited_.emplace_back(parent, store_.islandOf(*partner));
    }
    const size_t count = inherited_.size();
    for (size_t i = 0; i < count; ++i) {
        const auto [a, b] = inherited_[i];
        if (a != parent && b != parent) continue;
        for (const uint32_t island : bodies)
            if (island != parent) inherited_.emplace_back(island, a == parent ? b : a);
    }
}

/// Sweep and prune along x inside each group, then the exact test.
void Breaker::settleOverlaps() {
    struct Extent {
        uint32_t group;
        float low;
        float high;
        uint32_t island;
    };
    std::vector<Extent> extents;
    extents.reserve(newcomers_.size());
    for (const Newcomer& newcomer : newcomers_) {
        const btRigidBody& body = *store_.island(newcomer.island).body;
        btVector3 low;
        btVector3 high;
        body.getAabb(low, high);
        extents.push_back({newcomer.group, float(low.x()), float(high.x()), newcomer.island});
    }
    std::sort(extents.begin(), extents.end(), [](const Extent& x, const Extent& y) {
        return std::tuple(x.group, x.low, x.island) < std::tuple(y.group, y.low, y.island);
    });
    const auto test = [&](uint32_t a, uint32_t b) {
        const IslandBody& islandA = store_.island(a);
        const float diagonal = store_.object(islandA.object).asset().diagonal();
        ignored_.addIfOverlapping(*islandA.body, *store_.island(b).body,
                                  options_.overlapTolerance * diagonal);
    };
    for (size_t i = 0; i < extents.size(); ++i) {
        for (size_t j = i + 1; j < extents.size(); ++j) {
            const bool reach =
                extents[j].group == extents[i].group && extents[j].low <= extents[i].high;
            if (!reach) break;
            test(extents[i].island, extents[j].island);
        }
    }
    for (const auto& [a, b] : inherited_) test(a, b);
    newcomers_.clear();
    inherited_.clear();
    groupCount_ = 0;
}

/// Between steps: what `hit_` has broken comes apart.
void Breaker::splitAndReport(uint32_t island, uint32_t fragment, BreakEvent event) {
    uint32_t bodies = 0;
    if (store_.regroup(island) != BodyStore::Change::none)
        bodies = uint32_t(split(island).size()) - 1;
    event.consumed = hit_.consumed;
    if (hit_.brokeSomething()) addEvent(event, island, fragment, bodies);
    settleOverlaps();
}

uint32_t Breaker::dealArea(uint32_t objectIndex, const AreaDamage& damage, double time) {
    time_ = time;
    inStep_ = false;
    uint32_t broken = 0;
    const std::vector<uint32_t> islands = store_.object(objectIndex).bodies;
    for (const uint32_t index : islands) {
        const IslandBody& island = store_.island(index);
        const AreaDamage seen =
            seenFrom(toPose(island.body->getWorldTransform() * island.frame.inverse()), damage);
        applyArea(store_.structureOf(index), island.fragments, seen,
                  store_.object(objectIndex).options.damage, hit_);
        broken += uint32_t(hit_.bonds.size());
        BreakEvent event;
        event.point = damage.a;
        event.energy = hit_.consumed;
        splitAndReport(index, island.fragments.front(), event);
    }
    return broken;
}

float Breaker::reportHit(uint32_t index, const ReportedHit& reported, int child, double time) {
    time_ = time;
    inStep_ = false;
    const Object& object = store_.object(store_.island(index).object);
    const Meeting meeting{0, {reported.impulse, reported.speed, 0}, reported.energy};
    if (!canTakeDamage(index, meeting)) return 0;
    Hit hit = hitOn(index, child, toBullet(reported.point));
    hit.energy = reported.energy;
    hit.stress = contactStress(object.asset(), hit.fragment, reported.speed);
    solver_.apply(store_.structureOf(index), hit, object.options.damage, hit_);
    BreakEvent event;
    event.point = reported.point;
    event.normal = reported.normal;
    event.impulse = reported.impulse;
    event.energy = reported.energy;
    event.approachSpeed = reported.speed;
    splitAndReport(index, hit.fragment, event);
    return hit_.consumed;
}

void Breaker::breakFragment(uint32_t island, uint32_t fragment, bool whole, double time) {
    time_ = time;
    inStep_ = false;
    shatter(store_.structureOf(island), fragment, whole, hit_);
    splitAndReport(island, fragment, {});
}

void Breaker::breakAll(uint32_t object, double time) {
    AreaDamage everything;
    everything.fluence = HUGE_VALF;
    everything.radius = std::numeric_limits<float>::max();
    everything.falloff = 0;
    dealArea(object, everything, time);
}

void Breaker::followPins(uint32_t objectIndex, double time) {
    time_ = time;
    inStep_ = false;
    hit_.clear();
    const std::vector<uint32_t> islands = store_.object(objectIndex).bodies;
    for (const uint32_t island : islands) splitAndReport(island, 0, {});
}

void Breaker::forgetOverlaps(uint32_t object) {
    for (const uint32_t island : store_.object(object).bodies) {
        partners_.clear();
        ignored_.remove(*store_.island(island).body, partners_);
    }
}

void Breaker::removeObject(uint32_t object) {
    forgetOverlaps(object);
    store_.remove(object);
}

void Breaker::replaceObject(uint32_t object, ObjectSnapshot&& snapshot) {
    forgetOverlaps(object);
    store_.replaceBodies(object, std::move(snapshot));
    for (const uint32_t island : store_.object(object).bodies) newcomers_.push_back({0, island});
    settleOverlaps();
}

std::span<const BreakEvent> Breaker::takeEvents() {
    taken_.swap(pending_);
    pending_.clear();
    return taken_;
}

}  // namespace sherd
