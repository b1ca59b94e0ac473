// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "sherd/formats/result.h"
#include "sherd/runtime/asset.h"
#include "sherd/runtime/hooks.h"

namespace sherd {

class FragmentShapes;

/// An asset in one size with Bullet's shapes of all its fragments: all that a spawn needs and that
/// takes time. Immutable; any number of worlds on any threads share it.
struct PreparedAsset {
    std::shared_ptr<const Asset> asset;  ///< in that size
    std::shared_ptr<const FragmentShapes> shapes;
};

/// Makes it, on whatever thread: about 1 us for every collider. `DestructionWorld::use` gives it to
/// a world. Errors: `badArgument` for a null asset or a scale that is not positive.
Result<PreparedAsset> prepareAsset(const std::shared_ptr<const Asset>& asset, float scale = 1,
                                   const Jobs& jobs = {});

}  // namespace sherd
