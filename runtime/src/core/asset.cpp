// SPDX-License-Identifier: MIT
#include "sherd/runtime/asset.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <new>
#include <utility>

#include "core/asset_validation.h"
#include "sherd/formats/glb_read.h"

namespace sherd {
namespace {

/// The children of `from` on the path down to `leaf`'s side: walks up from both ends of a bond to
/// the fragment under which they part. That fragment's break is the one that must break the bond.
int32_t partingFragment(const std::vector<Fragment>& fragments, int32_t a, int32_t b) {
    while (a != b) {
        // Parents lie in front of their children, so the larger index is never the common ancestor.
        int32_t& deeper = a > b ? a : b;
        deeper = fragments[size_t(deeper)].parent;
        if (deeper < 0) return -1;
    }
    return a;
}

float boundingDiagonal(const std::vector<glm::vec3>& points) {
    if (points.empty()) return 0;
    glm::vec3 low = points[0];
    glm::vec3 high = points[0];
    for (const glm::vec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::length(high - low);
}

Result<std::vector<std::shared_ptr<const Asset>>> toAssets(Result<std::vector<FractureSet>> sets) {
    if (!sets) return tl::unexpected<Error>(sets.error());
    if (sets->empty()) {
        return fail(ErrorCode::invalidData,
                    "the file holds no fracture set; bake it with sherd-bake, as the last tool "
                    "that writes it",
                    "/extensions/SHERD_mesh_fracture");
    }
    std::vector<std::shared_ptr<const Asset>> assets;
    for (size_t i = 0; i < sets->size(); ++i) {
        auto asset = Asset::fromFractureSet(std::move((*sets)[i]));
        if (!asset) {
            Error error = asset.error();
            error.where =
                "/extensions/SHERD_mesh_fracture/fractures/" + std::to_string(i) + error.where;
            return tl::unexpected<Error>(std::move(error));
        }
        assets.push_back(std::move(*asset));
    }
    return assets;
}

template <class Source>
Result<std::vector<std::shared_ptr<const Asset>>> loadGuarded(const Source& source) {
    try {
        return toAssets(readFractureSets(source));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory to load the file");
    }
}

}  // namespace

Asset::Asset(FractureSet set) : set_(std::move(set)) {
    const size_t primitiveCount = set_.geometry.primitives.size();
    for (size_t f = 0; f < set_.fragments.size(); ++f) {
        const auto first = uint32_t(drawRanges_.size());
        for (size_t p = 0; p < primitiveCount; ++p) {
            const Primitive& primitive = set_.geometry.primitives[p];
            const Range range = set_.fragmentRanges[f * primitiveCount + p];
            if (range.count == 0 || primitive.exposedFrom > set_.fragments[f].level) continue;
            drawRanges_.push_back({primitive.material, primitive.exposedFrom, range});
        }
        drawRangesOf_.push_back({first, uint32_t(drawRanges_.size()) - first});
    }
    bondArea_.assign(set_.fragments.size(), 0.0F);
    breakEnergy_.assign(set_.fragments.size(), 0.0F);
    for (const Bond& bond : set_.bonds) {
        if (bond.b < 0)
            continue;  // an anchor holds the object to the world, not its pieces together
        const int32_t parting = partingFragment(set_.fragments, bond.a, bond.b);
        if (parting < 0) continue;
        bondArea_[size_t(parting)] += bond.area;
        breakEnergy_[size_t(parting)] += bond.area * bond.toughness;
    }
    diagonal_ = boundingDiagonal(set_.hullPoints);
}

Result<std::shared_ptr<const Asset>> Asset::fromFractureSet(FractureSet set) {
    try {
        if (auto valid = validateForRuntime(set); !valid) {
            return tl::unexpected<Error>(valid.error());
        }
        return std::shared_ptr<const Asset>(new Asset(std::move(set)));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory for the object");
    }
}

std::span<const DrawRange> Asset::drawRanges(uint32_t f) const {
    const Range range = drawRangesOf_[f];
    return std::span<const DrawRange>(drawRanges_).subspan(range.first, range.count);
}

Result<std::vector<std::shared_ptr<const Asset>>> loadAssets(std::span<const uint8_t> glb) {
    return loadGuarded(glb);
}

Result<std::vector<std::shared_ptr<const Asset>>> loadAssets(const std::filesystem::path& path) {
    return loadGuarded(path);
}

}  // namespace sherd
