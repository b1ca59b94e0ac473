// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <cstddef>

namespace sherd {

/// A compound that can be copied, tree and all, for a tenth of what it takes to make, and whose box
/// comes from its tree, not from a look at every child. The children have margins of their own.
class ColliderSet final : public btCompoundShape {
  public:
    /// Empty, for so many; below some eight, testing every child is cheaper than a tree.
    explicit ColliderSet(size_t capacity) : ColliderSet(capacity, capacity > 8) {}
    ColliderSet(size_t capacity, bool withTree);
    ColliderSet(const ColliderSet& from);
    ColliderSet& operator=(const ColliderSet&) = delete;
    ~ColliderSet() override = default;

    void recalculateLocalAabb() override;
};

}  // namespace sherd
