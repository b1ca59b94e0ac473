// SPDX-License-Identifier: MIT
#include "bullet/overlaps.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>

#include "bullet/own_body.h"

namespace sherd {
namespace {

template <class Visit>
void forEachHull(const btCollisionShape& shape, const btTransform& place, const Visit& visit) {
    if (!shape.isCompound()) {
        visit(static_cast<const btConvexShape&>(shape), place);
        return;
    }
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int c = 0; c < compound.getNumChildShapes(); ++c)
        forEachHull(*compound.getChildShape(c), place * compound.getChildTransform(c), visit);
}

template <class Visit>
void forEachHull(const btCollisionObject& body, const Visit& visit) {
    forEachHull(*body.getCollisionShape(), body.getWorldTransform(), visit);
}

/// Signed distance by GJK, and EPA where they overlap (van den Bergen 2001), as Bullet's own
/// narrow phase finds it, so that what is called apart here makes no contact force there.
float hullDistance(const btConvexShape& a, const btTransform& poseA, const btConvexShape& b,
                   const btTransform& poseB) {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btGjkPairDetector detector(&a, &b, &simplex, &penetration);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = poseA;
    input.m_transformB = poseB;
    btPointCollector closest;
    detector.getClosestPoints(input, closest, nullptr);
    // No result means that both algorithms gave up, which they do only deep inside.
    return closest.m_hasResult ? closest.m_distance : -BT_LARGE_FLOAT;
}

bool hullsPenetrate(const btConvexShape& a, const btTransform& poseA, const btConvexShape& b,
                    const btTransform& poseB, float tolerance) {
    btVector3 lowA;
    btVector3 highA;
    btVector3 lowB;
    btVector3 highB;
    a.getAabb(poseA, lowA, highA);
    b.getAabb(poseB, lowB, highB);
    if (!TestAabbAgainstAabb2(lowA, highA, lowB, highB)) return false;
    return hullDistance(a, poseA, b, poseB) < -tolerance;
}

constexpr size_t kChecksPerStep = 256;  // about 0.3 ms

}  // namespace

bool penetrates(const btCollisionObject& a, const btCollisionObject& b, float tolerance) {
    bool found = false;
    forEachHull(a, [&](const btConvexShape& hullA, const btTransform& poseA) {
        forEachHull(b, [&](const btConvexShape& hullB, const btTransform& poseB) {
            found = found || hullsPenetrate(hullA, poseA, hullB, poseB, tolerance);
        });
    });
    return found;
}

namespace {

/// By its list alone: a body of Sherd's takes Bullet's question for the beginning of a contact.
bool ignores(const btCollisionObject& a, const btCollisionObject& b) {
    return !a.btCollisionObject::checkCollideWithOverride(&b);
}

void setIgnored(btCollisionObject& a, const btCollisionObject& b, bool ignored) {
    a.setIgnoreCollisionCheck(&b, ignored);
    if (auto* own = dynamic_cast<OwnBody*>(&a)) own->keepWatch();
}

}  // namespace

void IgnoredPairs::addIfOverlapping(btCollisionObject& a, btCollisionObject& b, float tolerance) {
    if (&a != &b && !ignores(a, b) && penetrates(a, b, tolerance)) add(a, b, tolerance);
}

void IgnoredPairs::add(btCollisionObject& a, btCollisionObject& b, float tolerance) {
    if (ignores(a, b)) return;
    pairs_.push_back({&a, &b, tolerance});
    setIgnored(pairs_.back(), true);
}

void IgnoredPairs::releaseSeparated() {
    for (size_t checked = 0; checked < kChecksPerStep && !pairs_.empty(); ++checked) {
        if (next_ == 0) next_ = pairs_.size();
        const Pair pair = pairs_[--next_];
        if (!pair.a->isActive() && !pair.b->isActive()) {
            if (next_ == 0) return;
            continue;
        }
        if (!penetrates(*pair.a, *pair.b, pair.tolerance)) {
            setIgnored(pair, false);
            pairs_[next_] = pairs_.back();
            pairs_.pop_back();
            next_ = std::min(next_, pairs_.size());
        }
        if (next_ == 0) return;
    }
}

void IgnoredPairs::remove(const btCollisionObject& body, Vector<btCollisionObject*>& partners) {
    size_t kept = 0;
    for (const Pair& pair : pairs_) {
        if (pair.a != &body && pair.b != &body) {
            pairs_[kept++] = pair;
            continue;
        }
        setIgnored(pair, false);
        partners.push_back(pair.a == &body ? pair.b : pair.a);
    }
    pairs_.resize(kept);
    next_ = std::min(next_, pairs_.size());
}

void IgnoredPairs::setIgnored(const Pair& pair, bool ignored) {
    sherd::setIgnored(*pair.a, *pair.b, ignored);
    sherd::setIgnored(*pair.b, *pair.a, ignored);
    if (!ignored) {
        pair.a->activate();
        pair.b->activate();
    }
}

}  // namespace sherd
