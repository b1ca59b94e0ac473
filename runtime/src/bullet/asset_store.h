// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bullet/fragment_shapes.h"
#include "sherd/runtime/bullet/prepared_asset.h"

namespace sherd {

/// The assets that a world has bodies of, by size.
class AssetStore {
  public:
    /// `overlapTolerance`: share of an object's diagonal.
    explicit AssetStore(float overlapTolerance) : tolerance_(overlapTolerance) {}

    /// The asset in that size and of that density, made if there is none yet.
    Result<std::shared_ptr<const Asset>> take(const std::shared_ptr<const Asset>& asset,
                                              float scale, float density = 1);
    void add(const PreparedAsset& prepared);
    /// It must be there.
    [[nodiscard]] const PreparedAsset& find(const Asset& asset) const;
    template <class Visit>
    void forEach(const Visit& visit) const {
        for (const PreparedAsset& known : assets_) visit(*known.asset);
    }
    /// Forgets those that nobody else holds.
    void trim();

  private:
    float tolerance_;
    std::vector<PreparedAsset> assets_;
};

}  // namespace sherd
