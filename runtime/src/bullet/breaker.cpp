// SPDX-License-Identifier: MIT
#include "bullet/breaker.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "bullet/convert.h"

namespace sherd {
namespace {

constexpr uint32_t kNoPiece = UINT32_MAX;

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

/// Two bodies that hit each other; when a side breaks, its struck child takes its place.
struct Breaker::Strike {
    std::array<btCollisionObject*, 2> bodies{};
    btVector3 point{0, 0, 0};
    btVector3 normal{0, 0, 0};  ///< from bodies[1] to bodies[0]
};

void Breaker::step(double time, float dt, bool inStep) {
    time_ = time;
    inStep_ = inStep;
    ignored_.releaseSeparated();
    store_.readPoses();
    if (store_.breakableCount() == 0) return;
    contacts_.gather(world_, dt, inStep);
    findHits();
    for (const Hit& hit : hits_) applyHit(hit);
    if (!hits_.empty()) settleOverlaps();
}

void Breaker::findHits() {
    hits_.clear();
    for (size_t p = 0; p < contacts_.pairs().size(); ++p) {
        const SolvedPair& pair = contacts_.pairs()[p];
        Strike strike{{contacts_.body(pair.a), contacts_.body(pair.b)}, pair.point, pair.normal};
        const bool ours = store_.pieceOf(*strike.bodies[0]) != kNoPiece ||
                          store_.pieceOf(*strike.bodies[1]) != kNoPiece;
        if (!ours || !(pair.normalImpulse > 0)) continue;
        const auto velocity = [&](uint32_t index) {
            return velocityAt(*contacts_.body(index), contacts_.motionBefore(index), pair.point) -
                   contacts_.pushOfForces(index);
        };
        Contact contact;
        contact.approachSpeed = -(velocity(pair.a) - velocity(pair.b)).dot(pair.normal);
        contact.effectiveMass =
            effectiveMass(*strike.bodies[0], *strike.bodies[1], pair.point, pair.normal);
        contact.impulse = pair.normalImpulse;
        // Bullet brakes bodies that would meet within the substep only down to just meeting, and
        // stops them in the next. One hit must not count as two weaker ones.
        const Contact rest =
            contactNow(*strike.bodies[0], *strike.bodies[1], pair.point, pair.normal);
        if (pair.gap > 0 && rest.approachSpeed > 0) contact.impulse += rest.impulse;
        const float energy = contactEnergy(contact);
        if (weakerSide(strike, energy, contact.impulse) < 2) hits_.push_back({p, contact, energy});
    }
    std::stable_sort(hits_.begin(), hits_.end(),
                     [](const Hit& x, const Hit& y) { return x.energy > y.energy; });
}

/// The side that this energy breaks (0 or 1), the one that needs less first; 2: neither.
uint32_t Breaker::weakerSide(const Strike& strike, float energy, float impulse) const {
    uint32_t weaker = 2;
    float least = 0;
    for (uint32_t side = 0; side < 2; ++side) {
        const uint32_t index = store_.pieceOf(*strike.bodies[side]);
        if (index == kNoPiece) continue;
        const Piece& piece = store_.piece(index);
        const Object& object = store_.object(piece.object);
        const DamageOptions& damage = object.options.damage;
        if (!breaks(object.asset(), piece.fragment, energy, impulse, damage)) continue;
        const float threshold = breakThreshold(object.asset(), piece.fragment, damage);
        if (weaker == 2 || threshold < least) {
            weaker = side;
            least = threshold;
        }
    }
    return weaker;
}

/// Takes the contact back, lets breaking consume its energy, and leaves what remains of the
/// approach to the next substep, in which the hitter meets the fragments instead of the intact
/// body. As long as that remainder breaks the struck child too, it descends at once.
void Breaker::applyHit(const Hit& hit) {
    const SolvedPair pair = contacts_.pairs()[hit.pair];
    Strike strike{{contacts_.body(pair.a), contacts_.body(pair.b)}, pair.point, pair.normal};
    if (!strike.bodies[0] || !strike.bodies[1]) return;  // broken by a harder hit of this substep
    // Another hit may have taken this contact back, and used up its energy.
    const bool measured = !pair.undone;
    float surplus = contacts_.undoAround(hit.pair, kShockShare * pair.normalImpulse);
    Contact contact =
        measured ? hit.contact
                 : contactNow(*strike.bodies[0], *strike.bodies[1], strike.point, strike.normal);
    for (;;) {
        const float energy = contactEnergy(contact);
        const uint32_t side = weakerSide(strike, energy, contact.impulse);
        if (side == 2) return;
        if (strike.bodies[side] == contacts_.body(side == 0 ? pair.a : pair.b)) {
            contacts_.forget(side == 0 ? pair.a : pair.b);
        }
        breakSide(strike, side, contact, surplus);
        surplus = 0;
        contact = contactNow(*strike.bodies[0], *strike.bodies[1], strike.point, strike.normal);
    }
}

void Breaker::breakSide(Strike& strike, uint32_t side, const Contact& contact, float surplus) {
    const uint32_t index = store_.pieceOf(*strike.bodies[side]);
    const Piece& piece = store_.piece(index);
    const Object& object = store_.object(piece.object);
    const float consumed = breakThreshold(object.asset(), piece.fragment, object.options.damage);

    // Along the normal first; a graze that has too little there gives the rest sideways, as
    // friction.
    const float wanted = consumed + surplus;
    const float taken =
        takeEnergy(*strike.bodies[0], *strike.bodies[1], strike.point, -strike.normal, wanted);
    if (taken < wanted) {
        const btVector3 sliding =
            velocityAt(*strike.bodies[0], motionNow(*strike.bodies[0]), strike.point) -
            velocityAt(*strike.bodies[1], motionNow(*strike.bodies[1]), strike.point);
        if (sliding.length2() > 0) {
            takeEnergy(*strike.bodies[0], *strike.bodies[1], strike.point, sliding.normalized(),
                       wanted - taken);
        }
    }

    BreakEvent event;
    event.point = toGlm(strike.point);
    event.normal = toGlm(side == 0 ? strike.normal : -strike.normal);
    event.impulse = contact.impulse;
    event.energy = contactEnergy(contact);
    event.consumed = consumed;
    event.approachSpeed = contact.approachSpeed;
    float nearest = BT_LARGE_FLOAT;
    for (const uint32_t child : swap(index, event)) {
        btRigidBody& body = *store_.piece(child).body;
        const float distance = distanceTo(body, strike.point);
        if (distance < nearest) {
            nearest = distance;
            strike.bodies[side] = &body;
        }
    }
}

std::span<const uint32_t> Breaker::swap(uint32_t index, const BreakEvent& cause) {
    const Piece& piece = store_.piece(index);
    BreakEvent event = cause;
    event.object = store_.idOf(piece.object);
    event.asset = &store_.object(piece.object).asset();
    event.fragment = piece.fragment;
    event.children = event.asset->fragment(piece.fragment).children;
    event.time = time_;
    if (pending_.size() < options_.maxPendingEvents) pending_.push_back(event);

    partners_.clear();
    ignored_.remove(*piece.body, partners_);
    const std::span<const uint32_t> children = store_.swap(index, inStep_);
    joinGroup(index, children);
    return children;
}

/// Notes which pairs must be tested for overlap: the children with each other (and with what else
/// came out of the same piece in this step), and with whatever their parent still overlapped.
void Breaker::joinGroup(uint32_t parent, std::span<const uint32_t> children) {
    uint32_t group = groupCount_;
    const auto self = std::find_if(newcomers_.begin(), newcomers_.end(),
                                   [&](const Newcomer& n) { return n.piece == parent; });
    if (self == newcomers_.end()) {
        ++groupCount_;
    } else {
        group = self->group;
        newcomers_.erase(self);
    }
    for (const uint32_t child : children) newcomers_.push_back({group, child});

    for (btCollisionObject* partner : partners_) {
        inherited_.emplace_back(parent, store_.pieceOf(*partner));
    }
    const size_t count = inherited_.size();
    for (size_t i = 0; i < count; ++i) {
        const auto [a, b] = inherited_[i];
        if (a != parent && b != parent) continue;
        for (const uint32_t child : children) inherited_.emplace_back(child, a == parent ? b : a);
    }
    std::erase_if(inherited_,
                  [&](const auto& pair) { return pair.first == parent || pair.second == parent; });
}

/// Sweep and prune along x inside each group, then the exact test.
void Breaker::settleOverlaps() {
    struct Extent {
        uint32_t group;
        float low;
        float high;
        uint32_t piece;
    };
    std::vector<Extent> extents;
    extents.reserve(newcomers_.size());
    for (const Newcomer& newcomer : newcomers_) {
        const btRigidBody& body = *store_.piece(newcomer.piece).body;
        btVector3 low;
        btVector3 high;
        body.getAabb(low, high);
        extents.push_back({newcomer.group, float(low.x()), float(high.x()), newcomer.piece});
    }
    std::sort(extents.begin(), extents.end(), [](const Extent& x, const Extent& y) {
        return std::tuple(x.group, x.low, x.piece) < std::tuple(y.group, y.low, y.piece);
    });
    const auto test = [&](uint32_t a, uint32_t b) {
        const Piece& pieceA = store_.piece(a);
        const float diagonal = store_.object(pieceA.object).asset().diagonal();
        ignored_.addIfOverlapping(*pieceA.body, *store_.piece(b).body,
                                  options_.overlapTolerance * diagonal);
    };
    for (size_t i = 0; i < extents.size(); ++i) {
        for (size_t j = i + 1; j < extents.size(); ++j) {
            const bool reach =
                extents[j].group == extents[i].group && extents[j].low <= extents[i].high;
            if (!reach) break;
            test(extents[i].piece, extents[j].piece);
        }
    }
    for (const auto& [a, b] : inherited_) test(a, b);
    newcomers_.clear();
    inherited_.clear();
    groupCount_ = 0;
    store_.recycle();
}

void Breaker::breakPiece(uint32_t piece, double time) {
    time_ = time;
    inStep_ = false;
    swap(piece, BreakEvent{});
    settleOverlaps();
}

void Breaker::removeObject(uint32_t object) {
    for (const uint32_t piece : store_.object(object).pieces) {
        partners_.clear();
        ignored_.remove(*store_.piece(piece).body, partners_);
    }
    store_.remove(object);
}

std::span<const BreakEvent> Breaker::takeEvents() {
    taken_.swap(pending_);
    pending_.clear();
    return taken_;
}

}  // namespace sherd
