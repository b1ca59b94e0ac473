// SPDX-License-Identifier: MIT
#include "bullet/resting_pieces.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "bullet/convert.h"

namespace sherd {
namespace {

constexpr float kTouch = 1e-3F;  // of the object's diagonal: how near is touching

/// Cosine of the steepest slope on which friction holds: Bullet multiplies those of both sides.
float holdingSlope(float friction) {
    return 1 / std::sqrt(1 + friction * friction);
}

/// Something static under a body, not beside it.
struct Bearer final : btCollisionWorld::ContactResultCallback {
    Bearer(const btRigidBody& upper, const btVector3& upwards, float tolerance)
        : body(upper), up(upwards) {
        m_closestDistanceThreshold = tolerance;
    }
    bool needsCollision(btBroadphaseProxy* proxy) const override {
        const auto* other = static_cast<const btCollisionObject*>(proxy->m_clientObject);
        return !found && other != &body && other->isStaticObject() && other->hasContactResponse();
    }
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int, int,
                             const btCollisionObjectWrapper* b, int, int) override {
        const btCollisionObject* other = a->getCollisionObject();
        if (other == &body) other = b->getCollisionObject();
        const btScalar slope = std::abs(point.m_normalWorldOnB.dot(up));
        const bool isBelow =
            (point.getPositionWorldOnB() - body.getWorldTransform().getOrigin()).dot(up) < 0;
        if (point.getDistance() <= m_closestDistanceThreshold && isBelow &&
            slope >= holdingSlope(float(body.getFriction() * other->getFriction())))
            found = other;
        return 0;
    }
    const btRigidBody& body;
    btVector3 up;
    const btCollisionObject* found = nullptr;
};

struct Pile {
    struct Bond {
        uint32_t lower, upper;  ///< islands
        bool bears;
    };
    Vector<uint32_t> islandOf;  ///< per leaf; UINT32_MAX: gone
    Vector<Bond> bonds;
};

Pile pileOf(const IslandWorld& islands, uint32_t object, const glm::vec3& up) {
    const IslandWorld::Object& pieces = islands.object(object);
    const Asset& asset = *pieces.asset;
    const BondGraph& graph = asset.graph();
    Pile pile;
    pile.islandOf.assign(graph.leafCount(), UINT32_MAX);
    for (const uint32_t island : pieces.islands) {
        for (const uint32_t fragment : islands.island(island).fragments) {
            const Range leaves = graph.leavesOf(fragment);
            for (uint32_t l = 0; l < leaves.count; ++l) pile.islandOf[leaves.first + l] = island;
        }
    }
    for (const BondGraph::Bond& bond : graph.bonds()) {
        if (bond.b == BondGraph::kWorld) continue;
        const uint32_t a = pile.islandOf[bond.a], b = pile.islandOf[bond.b];
        if (a == b || a == UINT32_MAX || b == UINT32_MAX) continue;
        const float rise = glm::dot(islands.placesOf(a).now.rotation * bond.normal, up);
        const float friction = asset.fragment(graph.fragmentOfLeaf(bond.a)).friction *
                               asset.fragment(graph.fragmentOfLeaf(bond.b)).friction;
        const bool bears = std::abs(rise) >= holdingSlope(friction);
        pile.bonds.push_back(rise < 0 ? Pile::Bond{b, a, bears} : Pile::Bond{a, b, bears});
    }
    return pile;
}

}  // namespace

bool isAtRest(const IslandWorld& islands, BulletBodies& bodies, uint32_t object) {
    for (const uint32_t island : islands.object(object).islands)
        if (!bodies.quiet().isSlow(island)) return false;
    return true;
}

void restWhatIsBorne(btDynamicsWorld& world, const IslandWorld& islands, BulletBodies& bodies,
                     uint32_t object) {
    const btVector3 gravity = world.getGravity();
    if (!(gravity.length2() > 0)) return;
    const btVector3 up = -gravity.normalized();
    const Pile pile = pileOf(islands, object, toGlm(up));
    QuietDebris& quiet = bodies.quiet();
    const Vector<uint32_t>& pieces = islands.object(object).islands;
    const auto isFirm = [&](uint32_t island) {
        return islands.island(island).isFixed || quiet.isFrozen(island);
    };
    for (const uint32_t island : pieces) {
        if (isFirm(island)) continue;
        btRigidBody& body = bodies.body(island);
        Bearer bearer(body, up, kTouch * bodies.diagonalOf(island));
        if (body.isInWorld()) world.contactTest(&body, bearer);
        if (bearer.found && quiet.rest(island)) quiet.touchBearer(island, *bearer.found);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (const Pile::Bond& bond : pile.bonds)
            if (bond.bears && isFirm(bond.lower) && !isFirm(bond.upper))
                changed = quiet.rest(bond.upper) || changed;
    }
    for (const Pile::Bond& bond : pile.bonds)
        if (quiet.isFrozen(bond.lower) || quiet.isFrozen(bond.upper))
            quiet.touch(bond.lower, bond.upper, bond.bears);
}

}  // namespace sherd
