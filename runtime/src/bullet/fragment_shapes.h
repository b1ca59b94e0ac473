// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <memory>
#include <span>
#include <vector>

#include "bullet/collider_set.h"
#include "sherd/runtime/asset.h"
#include "sherd/runtime/hooks.h"

namespace sherd {

/// Bullet shapes for every fragment of an asset, made once (so that a swap makes none) and shared
/// by all its bodies, in any number of worlds: nothing changes them. Body frame: origin in the
/// centre of mass, axes along the principal axes.
class FragmentShapes {
  public:
    explicit FragmentShapes(std::shared_ptr<const Asset> asset, const Jobs& jobs = {});

    [[nodiscard]] const std::shared_ptr<const Asset>& asset() const { return asset_; }
    [[nodiscard]] btCollisionShape* shape(uint32_t fragment) const;
    /// Body frame to object frame.
    [[nodiscard]] btTransform bodyFrame(uint32_t fragment) const;
    /// The fragment's colliders, in its body frame.
    [[nodiscard]] std::span<const std::unique_ptr<btConvexHullShape>> hulls(
        uint32_t fragment) const {
        const Range range = asset_->fragment(fragment).hulls;
        return std::span(hulls_).subspan(firstHull_[fragment], range.count);
    }

    /// The colliders of all children of a fragment, in the object's frame, to copy: so many take
    /// long to arrange.
    struct Family {
        std::unique_ptr<ColliderSet> colliders;
        std::vector<uint32_t> fragments;  ///< per collider
    };
    /// The one of which these, ascending, are most; null when there is none.
    [[nodiscard]] const Family* familyOf(std::span<const uint32_t> fragments) const;

  private:
    void makeFamily(uint32_t fragment);
    void make(uint32_t fragment);

    std::shared_ptr<const Asset> asset_;
    std::vector<std::unique_ptr<btConvexHullShape>> hulls_;  ///< fragment by fragment
    std::vector<uint32_t> firstHull_;
    std::vector<std::unique_ptr<ColliderSet>> compounds_;  ///< of those of several hulls
    std::vector<btCollisionShape*> shapes_;
    std::vector<Family> families_;  ///< per fragment; most have none
};

}  // namespace sherd
