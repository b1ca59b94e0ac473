// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "sherd/formats/result.h"
#include "sherd/runtime/asset.h"
#include "sherd/runtime/hooks.h"

namespace sherd {

class FragmentShapes;
class RestOverlaps;

/// An asset in one size with Bullet's shapes of all its fragments: all that a spawn needs and that
/// takes time. Immutable; any number of worlds on any threads share it.
struct PreparedAsset {
    std::shared_ptr<const Asset> asset;  ///< in that size
    std::shared_ptr<const FragmentShapes> shapes;
    std::shared_ptr<const RestOverlaps> overlaps;  ///< which of them lie inside each other
};

/// Default of WorldOptions::overlapTolerance.
constexpr float kOverlapTolerance = 1e-5F;

/// Makes it, on whatever thread: some microseconds for every collider. `DestructionWorld::use`
/// gives it to a world; with another `overlapTolerance` than the world's, part of it is made again
/// there. Errors: `badArgument` for a null asset or a scale that is not positive.
Result<PreparedAsset> prepareAsset(const std::shared_ptr<const Asset>& asset, float scale = 1,
                                   const Jobs& jobs = {},
                                   float overlapTolerance = kOverlapTolerance);

}  // namespace sherd
