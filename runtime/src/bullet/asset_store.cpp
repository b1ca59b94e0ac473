// SPDX-License-Identifier: MIT
#include "bullet/asset_store.h"

#include <algorithm>
#include <new>

#include "bullet/rest_overlaps.h"

namespace sherd {

Result<PreparedAsset> prepareAsset(const std::shared_ptr<const Asset>& asset, float scale,
                                   const Jobs& jobs, float overlapTolerance) {
    auto sized = Asset::scaled(asset, scale);
    if (!sized) return tl::unexpected<Error>(sized.error());
    try {
        PreparedAsset prepared;
        prepared.shapes = std::make_shared<const FragmentShapes>(*sized, jobs);
        prepared.overlaps =
            std::make_shared<const RestOverlaps>(*prepared.shapes, overlapTolerance);
        prepared.asset = std::move(*sized);
        return prepared;
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory for the object's shapes");
    }
}

Result<std::shared_ptr<const Asset>> AssetStore::take(const std::shared_ptr<const Asset>& asset,
                                                      float scale) {
    const float size = asset->scale() * scale;
    for (const PreparedAsset& known : assets_)
        if (&known.asset->original() == &asset->original() && known.asset->scale() == size)
            return known.asset;
    auto prepared = prepareAsset(asset, scale, {}, tolerance_);
    if (!prepared) return tl::unexpected<Error>(prepared.error());
    assets_.push_back(*prepared);
    return std::move(prepared->asset);
}

void AssetStore::add(const PreparedAsset& prepared) {
    for (const PreparedAsset& known : assets_)
        if (&known.asset->original() == &prepared.asset->original() &&
            known.asset->scale() == prepared.asset->scale())
            return;
    assets_.push_back(prepared);
    if (prepared.overlaps->tolerance() != tolerance_)
        assets_.back().overlaps =
            std::make_shared<const RestOverlaps>(*prepared.shapes, tolerance_);
}

const PreparedAsset& AssetStore::find(const Asset& asset) const {
    size_t i = 0;
    while (assets_[i].asset.get() != &asset) ++i;
    return assets_[i];
}

void AssetStore::trim() {
    // Its own, and the shapes'.
    std::erase_if(assets_, [](const PreparedAsset& known) {
        return known.asset.use_count() == 2 && known.shapes.use_count() == 1;
    });
}

}  // namespace sherd
