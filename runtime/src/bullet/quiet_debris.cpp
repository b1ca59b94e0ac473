// SPDX-License-Identifier: MIT
#include "bullet/quiet_debris.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include <algorithm>
#include <cmath>

namespace sherd {
namespace {

constexpr float kPlace =
    0.05F;  // of its radius: how far a piece may shift and still lie where it lay
constexpr float kWake = 0.25F;      // of the speed that falling by its own size gives
constexpr uint32_t kLooks = 4;      // substeps in which every piece is looked at once
constexpr uint32_t kRound = 8;      // substeps from one freezing to the next
constexpr size_t kMostWoken = 256;  // at once; the others wake when these move

/// How far a body of this radius has moved from one pose to another, with turning, squared.
btScalar movedSquared(const btTransform& from, const btTransform& to, float radius) {
    const btMatrix3x3 &a = from.getBasis(), &b = to.getBasis();
    const btScalar turned = std::max((a.getColumn(0) - b.getColumn(0)).length2(),
                                     (a.getColumn(1) - b.getColumn(1)).length2());
    return (from.getOrigin() - to.getOrigin()).length2() + turned * radius * radius;
}

bool hasMoved(const btTransform& from, const btTransform& to, float radius, float distance) {
    return movedSquared(from, to, radius) > btScalar(distance) * distance;
}

}  // namespace

uint32_t QuietDebris::islandOf(const btCollisionObject& object) const {
    const auto island = uint32_t(object.getUserIndex3());
    return island < nodes_.size() && nodes_[island].body == &object ? island : kNobody;
}

Vector<QuietDebris::Link>& QuietDebris::linksOf(uint32_t id) {
    return (id & kForeign) != 0 ? others_[id & ~kForeign].links : nodes_[id].links;
}

btTransform QuietDebris::poseOf(uint32_t id) const {
    return (id & kForeign) != 0 ? others_[id & ~kForeign].object->getWorldTransform()
                                : nodes_[id].body->getWorldTransform();
}

uint32_t QuietDebris::otherFor(const btCollisionObject& object) {
    size_t free = others_.size();
    for (size_t i = 0; i < others_.size(); ++i) {
        if (others_[i].object == &object) return uint32_t(i) | kForeign;
        if (!others_[i].object && free == others_.size()) free = i;
    }
    if (free == others_.size()) others_.emplace_back();
    Other& other = others_[free];
    other.object = &object;
    other.index = object.getWorldArrayIndex();
    other.seen = object.getWorldTransform();
    const btBroadphaseProxy* proxy = object.getBroadphaseHandle();
    other.uniqueId = proxy ? proxy->m_uniqueId : -1;
    return uint32_t(free) | kForeign;
}

void QuietDebris::add(uint32_t island, btRigidBody& body, OwnBody* freezable, float mass,
                      const btVector3& inertia) {
    if (nodes_.size() <= island) nodes_.resize(island + 1);
    Node& node = nodes_[island];
    node.body = &body;
    freezableCount_ -= node.freezable ? 1 : 0;
    node.freezable = std::isfinite(after_) && mass > 0 ? freezable : nullptr;
    freezableCount_ += node.freezable ? 1 : 0;
    node.mass = mass;
    node.inertia = inertia;
    node.isInWorld = body.isInWorld();
    node.pose = body.getWorldTransform();
    node.since = time_;
    btVector3 center;
    btScalar radius = 0;
    body.getCollisionShape()->getBoundingSphere(center, radius);
    node.size = float(radius);
}

void QuietDebris::forget(uint32_t island) {
    if (island >= nodes_.size() || !nodes_[island].body) return;
    if (nodes_[island].isFrozen) thaw(island);
    while (!nodes_[island].links.empty()) {
        const uint32_t to = nodes_[island].links.back().to;
        unlink(to, island);
        nodes_[island].links.pop_back();
        if ((to & kForeign) == 0) thawBorne(to);
    }
    nodes_[island].body = nullptr;
    freezableCount_ -= nodes_[island].freezable ? 1 : 0;
    nodes_[island].freezable = nullptr;
}

void QuietDebris::link(uint32_t a, uint32_t b, bool aBearsB, bool bBearsA) {
    const auto enter = [this](uint32_t from, uint32_t to, bool bearsMe, bool isBorne) {
        Vector<Link>& links = linksOf(from);
        const auto found =
            std::find_if(links.begin(), links.end(), [to](const Link& l) { return l.to == to; });
        if (found == links.end()) {
            links.push_back({to, bearsMe, isBorne, poseOf(from)});
        } else {
            found->bearsMe = found->bearsMe || bearsMe;
            found->isBorne = found->isBorne || isBorne;
        }
    };
    enter(a, b, bBearsA, aBearsB);
    enter(b, a, aBearsB, bBearsA);
}

void QuietDebris::unlink(uint32_t from, uint32_t to) {
    Vector<Link>& links = linksOf(from);
    const auto found =
        std::find_if(links.begin(), links.end(), [to](const Link& l) { return l.to == to; });
    if (found == links.end()) return;
    *found = links.back();
    links.pop_back();
    if ((from & kForeign) != 0 && links.empty()) others_[from & ~kForeign].object = nullptr;
}

/// The piece is heavier than anything for this substep: what lies on it does not sink into it.
void QuietDebris::hold(uint32_t island) {
    Node& node = nodes_[island];
    if (node.isHeld || !node.isFrozen) return;
    node.isHeld = true;
    node.body->setMassProps(0, btVector3(0, 0, 0));
    held_.push_back(island);
}

void QuietDebris::letGo(Node& node) {
    if (!node.isHeld) return;
    node.isHeld = false;
    node.body->setMassProps(node.mass, node.inertia);
    if (node.isFrozen)
        node.body->setCollisionFlags(node.body->getCollisionFlags() |
                                     btCollisionObject::CF_STATIC_OBJECT);
}

float QuietDebris::wakeSpeedOf(const Node& node) {
    const auto gravity = float(node.body->getGravity().length());
    return kWake * std::max(std::sqrt(gravity * node.size), node.size);
}

bool QuietDebris::isSlow(uint32_t island) const {
    const Node& node = nodes_[island];
    if (node.body->isStaticObject() || !node.body->isActive()) return true;
    const btScalar speed = node.body->getLinearVelocity().length() +
                           node.body->getAngularVelocity().length() * node.size;
    return float(speed) <= wakeSpeedOf(node);
}

bool QuietDebris::mayFreeze(const Node& node) const {
    if (!node.freezable || node.isFrozen || !node.body->isInWorld()) return false;
    const int state = node.body->getActivationState();
    return state != DISABLE_DEACTIVATION && state != DISABLE_SIMULATION &&
           node.body->getNumConstraintRefs() == 0;
}

bool QuietDebris::rest(uint32_t island) {
    if (!mayFreeze(nodes_[island]) || !isSlow(island)) return false;
    freeze(island);
    return true;
}

void QuietDebris::touchBearer(uint32_t island, const btCollisionObject& bearer) {
    const uint32_t us = islandOf(bearer);
    link(us != kNobody ? us : otherFor(bearer), island, true, false);
}

void QuietDebris::freeze(uint32_t island) {
    Node& node = nodes_[island];
    OwnBody& body = *node.freezable;
    const btVector3 zero(0, 0, 0);
    body.setLinearVelocity(zero);
    body.setAngularVelocity(zero);
    body.setInterpolationLinearVelocity(zero);
    body.setInterpolationAngularVelocity(zero);
    body.setInterpolationWorldTransform(body.getWorldTransform());
    body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_STATIC_OBJECT);
    body.forceActivationState(ISLAND_SLEEPING);
    body.watch(OwnBody::Watch::frozen, true);
    node.isFrozen = true;
    node.pose = body.getWorldTransform();
    node.wakeSpeed = wakeSpeedOf(node);
    ++frozenCount_;
}

void QuietDebris::thaw(uint32_t island) {
    Node& node = nodes_[island];
    OwnBody& body = *node.freezable;
    node.isFrozen = false;
    --frozenCount_;
    letGo(node);
    body.setCollisionFlags(body.getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT);
    body.watch(OwnBody::Watch::frozen, false);
    body.forceActivationState(ACTIVE_TAG);
    body.setDeactivationTime(0);
    if (giveGravity_) body.applyGravity();
    node.since = time_;
    // What stays frozen beside it watches it from where it lay: the game may have moved it since.
    for (size_t l = node.links.size(); l-- > 0;) {
        const uint32_t to = node.links[l].to;
        if ((to & kForeign) == 0 && nodes_[to].isFrozen) {
            node.links[l].pose = node.pose;
            continue;
        }
        unlink(to, island);
        node.links[l] = node.links.back();
        node.links.pop_back();
    }
    node.pose = body.getWorldTransform();
}

/// As far as a momentum reaches that gives `mass`, kg, the speed at which pieces wake; infinite:
/// something that nothing stops.
void QuietDebris::thawReached(uint32_t from, float mass) {
    queue_.assign(1, from);
    thaw(from);
    mass -= nodes_[from].mass;
    for (size_t next = 0; next < queue_.size() && mass > 0; ++next) {
        // Thawing one takes links to what is awake out of the list.
        const Vector<Link>& links = nodes_[queue_[next]].links;
        for (size_t l = links.size(); l-- > 0;) {
            const uint32_t to = links[l].to;
            if ((to & kForeign) != 0 || !nodes_[to].isFrozen) continue;
            if (!(mass > 0) || queue_.size() >= kMostWoken) break;
            queue_.push_back(to);
            mass -= nodes_[to].mass;
            thaw(to);
            l = std::min(l, links.size());
        }
    }
}

/// And all that it bears.
void QuietDebris::thawBorne(uint32_t from) {
    if (!nodes_[from].isFrozen) return;
    queue_.assign(1, from);
    for (size_t next = 0; next < queue_.size(); ++next) {
        for (const Link& link : nodes_[queue_[next]].links) {
            if (!link.isBorne || (link.to & kForeign) != 0 || !nodes_[link.to].isFrozen) continue;
            if (queue_.size() >= kMostWoken) break;
            if (std::find(queue_.begin(), queue_.end(), link.to) == queue_.end())
                queue_.push_back(link.to);
        }
    }
    for (const uint32_t island : queue_) thaw(island);
}

void QuietDebris::wake(uint32_t island) {
    if (isFrozen(island)) thawReached(island, HUGE_VALF);
}

void QuietDebris::onNear(uint32_t island, const btCollisionObject& other) {
    const Node& node = nodes_[island];
    if (!node.isFrozen || !other.hasContactResponse() || !other.isActive()) return;
    const btRigidBody* body = btRigidBody::upcast(&other);
    float speed = HUGE_VALF;
    if (body) {
        const btBroadphaseProxy& proxy = *other.getBroadphaseHandle();
        const btScalar radius = (proxy.m_aabbMax - proxy.m_aabbMin).length() / 2;
        speed = float(body->getLinearVelocity().length() +
                      body->getAngularVelocity().length() * radius);
    }
    if (!(speed > node.wakeSpeed)) {
        hold(island);
        const uint32_t us = islandOf(other);
        link(us != kNobody ? us : otherFor(other), island, false, false);
        return;
    }
    const bool isMovable = body && body->getInvMass() > 0 && !body->isStaticOrKinematicObject();
    giveGravity_ = true;
    thawReached(island, isMovable ? speed / node.wakeSpeed / float(body->getInvMass()) : HUGE_VALF);
    giveGravity_ = false;
    // Bullet may have passed over the pairs of what was just thawed with what stays frozen.
    for (const uint32_t woken : queue_)
        for (const Link& link : nodes_[woken].links)
            if ((link.to & kForeign) == 0) hold(link.to);
}

bool QuietDebris::isThere(Other& other) const {
    const btCollisionObjectArray& objects = world_.getCollisionObjectArray();
    if (other.index < 0 || other.index >= objects.size() || objects[other.index] != other.object) {
        // Bullet fills gaps with the last one.
        other.index = objects.findLinearSearch(const_cast<btCollisionObject*>(other.object));
        if (other.index >= objects.size()) return false;
    }
    const btBroadphaseProxy* proxy = objects[other.index]->getBroadphaseHandle();
    return (proxy ? proxy->m_uniqueId : -1) == other.uniqueId;
}

/// The game's own that pieces touch: moved, or gone without a word.
void QuietDebris::checkOthers() {
    for (Other& other : others_) {
        if (!other.object) continue;
        if (!isThere(other)) {
            for (const Link& link : other.links) gone_.push_back(link.to);
            continue;
        }
        const btTransform& now = other.object->getWorldTransform();
        if (now == other.seen) continue;
        other.seen = now;
        for (const Link& link : other.links) look(link, now, nodes_[link.to].size);
    }
}

/// At a frozen piece from what is linked to it and now there. What bears it may not move at all,
/// what does not may slide past, or off it, but not into it.
void QuietDebris::look(const Link& link, const btTransform& now, float radius) {
    const Node& frozen = nodes_[link.to];
    const float least = kPlace * frozen.size;
    if (!hasMoved(link.pose, now, radius, least)) return;
    const btVector3 way = now.getOrigin() - link.pose.getOrigin();
    if (link.isBorne) {
        const bool isGone = way.length2() > btScalar(frozen.size) * frozen.size;
        (isGone ? gone_ : touched_).push_back(link.to);
        return;
    }
    const btVector3 towards = frozen.pose.getOrigin() - link.pose.getOrigin();
    if (way.dot(towards) > least * towards.length()) touched_.push_back(link.to);
}

void QuietDebris::watchFrozen(uint32_t island) {
    Node& node = nodes_[island];
    const OwnBody& body = *node.freezable;
    node.freezable->keepWatch();
    const bool isTouched = body.isActive() || body.getLinearVelocity().length2() > 0 ||
                           body.getAngularVelocity().length2() > 0 ||
                           !(body.getWorldTransform() == node.pose);
    if (isTouched) touched_.push_back(island);
}

/// One that is awake, or fixed.
void QuietDebris::watch(uint32_t island, double time) {
    Node& node = nodes_[island];
    const btTransform& now = node.body->getWorldTransform();
    if (!node.freezable) {
        if (now == node.pose) return;
        node.pose = now;
    }
    for (const Link& link : node.links)
        if ((link.to & kForeign) == 0 && nodes_[link.to].isFrozen) look(link, now, node.size);
    if (!node.freezable || island % kLooks != tick_ % kLooks) return;
    if (!hasMoved(node.pose, now, node.size, kPlace * node.size)) return;
    node.pose = now;
    node.since = time;
}

void QuietDebris::step(double time) {
    time_ = time;
    ++tick_;
    for (const uint32_t island : held_) letGo(nodes_[island]);
    held_.clear();
    gone_.clear();
    touched_.clear();
    if (freezableCount_ == 0) return;  // and nothing is linked to any
    for (uint32_t island = 0; island < nodes_.size(); ++island) {
        Node& node = nodes_[island];
        if (!node.body || (!node.freezable && node.links.empty())) continue;
        if (node.isInWorld != node.body->isInWorld()) {
            node.isInWorld = !node.isInWorld;
            for (const Link& link : node.links)
                if ((link.to & kForeign) == 0) gone_.push_back(link.to);
            if (node.isFrozen) touched_.push_back(island);
        }
        if (node.isFrozen) {
            watchFrozen(island);
        } else {
            watch(island, time);
        }
    }
    checkOthers();
    for (const uint32_t island : gone_) thawBorne(island);
    for (const uint32_t island : touched_)
        if (nodes_[island].isFrozen) thaw(island);
    if (tick_ % kRound == 0 && std::isfinite(after_)) freezeQuiet(time);
}

void QuietDebris::findTouches() {
    touches_.clear();
    const btVector3 up = -world_.getGravity();
    btDispatcher& dispatcher = *world_.getDispatcher();
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
        const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
        if (manifold.getNumContacts() == 0) continue;
        const btCollisionObject *a = manifold.getBody0(), *b = manifold.getBody1();
        uint32_t idA = islandOf(*a), idB = islandOf(*b);
        const auto isCandidate = [&](uint32_t id) {
            return id != kNobody && standing_[id] == Standing::candidate;
        };
        if (!isCandidate(idA) && !isCandidate(idB)) continue;
        if (!a->hasContactResponse() || !b->hasContactResponse()) continue;
        btScalar push = 0, upwards = 0;
        btScalar nearest = BT_LARGE_FLOAT;
        for (int i = 0; i < manifold.getNumContacts(); ++i) {
            const btManifoldPoint& point = manifold.getContactPoint(i);
            push += point.m_appliedImpulse;
            upwards += point.m_appliedImpulse * point.m_normalWorldOnB.dot(up);
            nearest = std::min(nearest, point.getDistance());
        }
        const float size = nodes_[isCandidate(idA) ? idA : idB].size;
        if (!(push > 0) && nearest > kPlace * size) continue;
        if (idA == kNobody) idA = otherFor(*a);
        if (idB == kNobody) idB = otherFor(*b);
        touches_.push_back({idA, idB, upwards<0, upwards> 0});
    }
}

/// Whether something can rest on it.
bool QuietDebris::isFirm(uint32_t id) const {
    if ((id & kForeign) != 0) {
        const btCollisionObject& object = *others_[id & ~kForeign].object;
        return object.isStaticOrKinematicObject() || object.getActivationState() == ISLAND_SLEEPING;
    }
    const Node& node = nodes_[id];
    return node.isFrozen || node.body->isStaticObject() || standing_[id] == Standing::grounded ||
           (standing_[id] == Standing::none && node.body->getActivationState() == ISLAND_SLEEPING);
}

/// Candidates that rest, over others, on something firm, and on nothing that is not.
void QuietDebris::findGrounded() {
    const auto visit = [this](const auto& decide) {
        for (bool changed = true; changed;) {
            changed = false;
            for (const Touch& touch : touches_) {
                if (touch.bBearsA) changed = decide(touch.a, touch.b) || changed;
                if (touch.aBearsB) changed = decide(touch.b, touch.a) || changed;
            }
        }
    };
    const auto is = [this](uint32_t id, Standing standing) {
        return (id & kForeign) == 0 && standing_[id] == standing;
    };
    visit([&](uint32_t upper, uint32_t lower) {
        if (!is(upper, Standing::candidate) || !isFirm(lower)) return false;
        standing_[upper] = Standing::grounded;
        return true;
    });
    visit([&](uint32_t upper, uint32_t lower) {
        if (!is(upper, Standing::grounded) || isFirm(lower)) return false;
        standing_[upper] = Standing::candidate;
        return true;
    });
}

void QuietDebris::freezeQuiet(double time) {
    candidates_.clear();
    for (uint32_t island = 0; island < nodes_.size(); ++island) {
        const Node& node = nodes_[island];
        if (mayFreeze(node) && time - node.since >= double(after_)) candidates_.push_back(island);
    }
    if (candidates_.empty()) return;
    standing_.assign(nodes_.size(), Standing::none);
    for (const uint32_t island : candidates_) standing_[island] = Standing::candidate;
    findTouches();
    findGrounded();
    for (const uint32_t island : candidates_) {
        if (standing_[island] == Standing::grounded) {
            freeze(island);
        } else {
            nodes_[island].since = time - double(after_) / 2;  // looked at again after a while
        }
    }
    for (const Touch& touch : touches_) {
        const auto isFrozen = [this](uint32_t id) {
            return (id & kForeign) == 0 && nodes_[id].isFrozen;
        };
        if (isFrozen(touch.a) || isFrozen(touch.b))
            link(touch.a, touch.b, touch.aBearsB, touch.bBearsA);
    }
    for (Other& other : others_)
        if (other.links.empty()) other.object = nullptr;
}

}  // namespace sherd
