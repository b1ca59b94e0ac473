// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include "sherd/runtime/memory.h"

namespace sherd {

/// Whether two bodies made of convex hulls are inside each other by more than `tolerance`, metres,
/// collision margins included.
bool penetrates(const btCollisionObject& a, const btCollisionObject& b, float tolerance);

/// Pairs of bodies that overlapped when they were released. Pushing them apart at once would blow
/// the pile up (hulls of concave neighbours overlap), so they ignore each other until apart.
class IgnoredPairs {
  public:
    /// Ignores the pair if it is not ignored already; one that penetrates until it no longer does.
    void add(btCollisionObject& a, btCollisionObject& b, float tolerance);
    /// If it penetrates.
    void addIfOverlapping(btCollisionObject& a, btCollisionObject& b, float tolerance);

    /// Lets pairs that came apart collide again. Looks at a bounded number of pairs per call, in
    /// turn, so that the cost of a step stays bounded however many there are.
    void releaseSeparated();

    /// Forgets a body about to be deleted. Its partners are appended to `partners`.
    void remove(const btCollisionObject& body, Vector<btCollisionObject*>& partners);

    [[nodiscard]] size_t size() const { return pairs_.size(); }

  private:
    struct Pair {
        btCollisionObject* a = nullptr;
        btCollisionObject* b = nullptr;
        float tolerance = 0;
    };
    static void setIgnored(const Pair& pair, bool ignored);

    Vector<Pair> pairs_;
    size_t next_ = 0;
};

}  // namespace sherd
