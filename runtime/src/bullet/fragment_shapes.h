// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <memory>
#include <vector>

#include "sherd/runtime/asset.h"

namespace sherd {

/// Bullet shapes for every fragment of an asset, made once (so that a swap makes none) and shared
/// by all its bodies. Body frame: origin in the centre of mass, axes along the principal axes.
class FragmentShapes {
  public:
    explicit FragmentShapes(std::shared_ptr<const Asset> asset);

    [[nodiscard]] const std::shared_ptr<const Asset>& asset() const { return asset_; }
    [[nodiscard]] btCollisionShape* shape(uint32_t fragment) const;
    /// Body frame to object frame.
    [[nodiscard]] btTransform bodyFrame(uint32_t fragment) const;

  private:
    std::shared_ptr<const Asset> asset_;
    std::vector<std::unique_ptr<btConvexHullShape>> hulls_;
    std::vector<std::unique_ptr<btCompoundShape>> compounds_;
    std::vector<btCollisionShape*> shapes_;
};

}  // namespace sherd
