// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bullet/fragment_shapes.h"
#include "sherd/runtime/bullet/prepared_asset.h"

namespace sherd {

/// The assets that a world has bodies of, by size.
class AssetStore {
  public:
    /// The asset in that size and of that density, made if there is none yet.
    Result<std::shared_ptr<const Asset>> take(const std::shared_ptr<const Asset>& asset,
                                              float scale, float density = 1);
    void add(const PreparedAsset& prepared);
    [[nodiscard]] const FragmentShapes& shapesOf(const Asset& asset) const;
    template <class Visit>
    void forEach(const Visit& visit) const {
        for (const PreparedAsset& known : assets_) visit(*known.asset);
    }
    /// Forgets those that nobody else holds.
    void trim();

  private:
    std::vector<PreparedAsset> assets_;
};

}  // namespace sherd
