// SPDX-License-Identifier: MIT
#include "bullet/approach_watch.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

namespace sherd {
namespace {

/// More than that come at once only where reading all contacts costs no more; and a game that calls
/// no step of Sherd's must not fill the memory.
constexpr size_t kMost = 16384;

/// Rounding of what was seen beside what is measured later.
constexpr double kCareful = 2;

/// At most what turning can bring into a contact, J. What contacts do not slow brings anything.
double spinEnergy(const btRigidBody& body) {
    const btScalar square = body.getAngularVelocity().length2();
    if (!(square > 0)) return 0;
    if (!movable(&body)) return HUGE_VAL;
    const btVector3& inverse = body.getInvInertiaDiagLocal();
    return 0.5 * double(square) / double(inverse[inverse.minAxis()]);
}

/// A contact cannot bring more than two bodies have about their common centre of mass, J.
double mostEnergy(const btRigidBody& own, const btCollisionObject& other) {
    double yield = movable(&own) ? double(own.getInvMass()) : 0.0;
    double spin = 0;
    btVector3 relative(0, 0, 0);
    if (!own.isStaticObject()) {
        relative = own.getLinearVelocity();
        spin = spinEnergy(own);
    }
    const btRigidBody* body = other.isStaticObject() ? nullptr : btRigidBody::upcast(&other);
    if (body) {
        if (movable(body)) yield += double(body->getInvMass());
        relative -= body->getLinearVelocity();
        spin += spinEnergy(*body);
    }
    return yield > 0 ? 0.5 * double(relative.length2()) / yield + spin : 0;
}

}  // namespace

void ApproachWatch::note(const OwnBody& own, const btCollisionObject& other,
                         float leastEnergy) noexcept {
    if (!own.hasContactResponse() || !other.hasContactResponse()) return;
    // A pair may be asked about again before the step, by a game that looks for collisions itself:
    // then what was noted of it is old, also when it is slow by now.
    const bool matters = kCareful * mostEnergy(own, other) >= double(leastEnergy);
    if (!matters && own.notedIn().load(std::memory_order_relaxed) != round_) return;
    // Not all contacts of what moves continuously, or of a ghost, are kept with the pair.
    const btRigidBody* body = btRigidBody::upcast(&other);
    const bool isReadWhole = own.getCcdSquareMotionThreshold() > 0 ||
                             (body && body->getCcdSquareMotionThreshold() > 0) ||
                             (other.getInternalType() & btCollisionObject::CO_GHOST_OBJECT) != 0;
    const std::scoped_lock guard(lock_);
    if ((matters && isReadWhole) || approaches_.size() >= kMost) {
        sawAll_ = false;
        return;
    }
    own.notedIn().store(round_, std::memory_order_relaxed);
    approaches_.push_back({&own, &other, own.getWorldArrayIndex(), other.getWorldArrayIndex(),
                           uint32_t(approaches_.size()), matters, motionNow(own),
                           motionNow(other)});
}

std::span<const Approach> ApproachWatch::approaches() {
    // Both of two breakable bodies are asked, and a game that looks for collisions by itself makes
    // Bullet ask again.
    const auto bodies = [](const Approach& x) { return std::minmax(x.indexA, x.indexB); };
    std::sort(approaches_.begin(), approaches_.end(), [&](const Approach& x, const Approach& y) {
        return std::pair(bodies(x), x.sequence) < std::pair(bodies(y), y.sequence);
    });
    size_t count = 0;
    for (size_t i = 0; i < approaches_.size(); ++i)
        if ((i + 1 == approaches_.size() || bodies(approaches_[i]) != bodies(approaches_[i + 1])) &&
            approaches_[i].matters)
            approaches_[count++] = approaches_[i];
    approaches_.resize(count);
    return approaches_;
}

void ApproachWatch::clear() {
    approaches_.clear();
    sawAll_ = true;
    ++round_;
}

}  // namespace sherd
