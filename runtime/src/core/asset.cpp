// SPDX-License-Identifier: MIT
#include "sherd/runtime/asset.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <new>
#include <string>
#include <utility>

#include "core/asset_validation.h"
#include "core/finite.h"
#include "core/mass_properties.h"
#include "core/rigid_pose.h"
#include "core/scaled_body.h"
#include "sherd/formats/glb_read.h"

namespace sherd {
namespace {

/// Leaves scaled so that they make up the object's mass, everything above them composed of them.
void composeMasses(std::vector<Fragment>& fragments) {
    double leaves = 0;
    for (const Fragment& fragment : fragments)
        if (fragment.children.count == 0) leaves += double(fragment.mass);
    const double scale = double(fragments[0].mass) / leaves;
    std::vector<MassProperties> sums(fragments.size());
    for (size_t f = fragments.size(); f-- > 0;) {
        Fragment& fragment = fragments[f];
        if (fragment.children.count == 0) {
            fragment.mass = float(scale * double(fragment.mass));
            fragment.inertiaDiagonal = glm::vec3(scale * glm::dvec3(fragment.inertiaDiagonal));
            sums[f] = massOf(fragment);
        } else {
            for (uint32_t c = 0; c < fragment.children.count; ++c)
                sums[f] = sums[f] + sums[fragment.children.first + c];
            const PrincipalInertia principal = principalInertia(sums[f]);
            fragment.mass = float(sums[f].mass);
            fragment.centerOfMass = glm::vec3(sums[f].center);
            fragment.inertiaDiagonal = principal.diagonal;
            fragment.inertiaOrientation = principal.orientation;
        }
    }
}

/// Fowler, Noll, Vo (1991).
uint64_t hashOf(const FractureSet& set) {
    uint64_t hash = 0xcbf29ce484222325;
    const auto mix = [&hash](uint64_t number) {
        for (int i = 0; i < 64; i += 8) hash = (hash ^ ((number >> i) & 0xff)) * 0x100000001b3;
    };
    for (const char c : set.sourceHash) mix(uint8_t(c));
    for (const Fragment& fragment : set.fragments) {
        mix(fragment.children.first);
        mix(fragment.children.count);
    }
    for (const Bond& bond : set.bonds) {
        mix(uint32_t(bond.a));
        mix(uint32_t(bond.b));
        mix(std::bit_cast<uint32_t>(bond.area));
    }
    return hash;
}

/// Masses that are each sound may make nothing sound together: too large a sum, too small a share.
Result<void> checkComposed(const std::vector<Fragment>& fragments) {
    for (size_t f = 0; f < fragments.size(); ++f) {
        const Fragment& fragment = fragments[f];
        const glm::vec3 &inertia = fragment.inertiaDiagonal, &center = fragment.centerOfMass;
        const float least = std::min({fragment.mass, inertia.x, inertia.y, inertia.z});
        const float most = std::max({fragment.mass, inertia.x, inertia.y, inertia.z});
        const bool isSound = least > 0 && std::isfinite(most) && isFinite(center);
        if (!isSound)
            return fail(
                ErrorCode::invalidData,
                "the masses of an object's parts do not add up to it; bake the object again",
                "/fragments/" + std::to_string(f) + "/mass");
    }
    return {};
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

Asset::Asset(FractureSet set) : set_(std::move(set)), graph_(set_) {
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
    breakEnergy_.assign(set_.fragments.size(), 0.0F);
    // An anchor holds the object to the world, not its pieces together.
    for (const BondGraph::Bond& bond : graph_.bonds())
        if (bond.b != BondGraph::kWorld) breakEnergy_[bond.parting] += bond.area * bond.toughness;
    boxes_.reserve(set_.fragments.size());
    for (uint32_t f = 0; f < fragmentCount(); ++f) boxes_.push_back(boxAt(f, {}));
    composeMasses(set_.fragments);
    const glm::dvec3 center(set_.fragments[0].centerOfMass);
    massMoments_.reserve(set_.fragments.size());
    for (const Fragment& fragment : set_.fragments)
        massMoments_.push_back(momentsAbout(center, massOf(fragment)));
    bakeHash_ = hashOf(set_);
    diagonal_ = boundingDiagonal(set_.hullPoints);
}

Result<std::shared_ptr<const Asset>> Asset::fromFractureSet(FractureSet set) {
    try {
        if (auto valid = validateForRuntime(set); !valid) {
            return tl::unexpected<Error>(valid.error());
        }
        return checked(std::shared_ptr<const Asset>(new Asset(std::move(set))));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory for the object");
    }
}

Result<std::shared_ptr<const Asset>> Asset::checked(std::shared_ptr<const Asset> asset) {
    if (auto sound = checkComposed(asset->set().fragments); !sound)
        return tl::unexpected<Error>(sound.error());
    return asset;
}

Result<std::shared_ptr<const Asset>> Asset::scaled(const std::shared_ptr<const Asset>& asset,
                                                   float factor, float density) {
    if (!asset) return fail(ErrorCode::badArgument, "the asset is null; load one first", "asset");
    if (!(factor > 0) || !std::isfinite(factor))
        return fail(ErrorCode::badArgument, "the scale must be positive and finite", "scale");
    if (!(density > 0) || !std::isfinite(density))
        return fail(ErrorCode::badArgument, "the density must be positive and finite", "density");
    try {
        const float scale = asset->scale_ * factor;
        density *= asset->density_;
        std::shared_ptr<const Asset> original = asset->original_ ? asset->original_ : asset;
        if (scale == 1 && density == 1) return original;
        std::shared_ptr<Asset> result(new Asset(scaledBody(original->set_, scale, density)));
        result->original_ = std::move(original);
        result->scale_ = scale;
        result->density_ = density;
        result->bakeHash_ ^= uint64_t(std::bit_cast<uint32_t>(scale)) << 32;
        result->bakeHash_ ^= std::bit_cast<uint32_t>(density);
        return checked(std::move(result));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory for the scaled object");
    }
}

Asset::Box Asset::boxAt(uint32_t f, const RigidPose& pose) const {
    const Range hulls = set_.fragments[f].hulls;
    Box box{glm::vec3(HUGE_VALF), glm::vec3(-HUGE_VALF)};
    for (uint32_t h = hulls.first; h < hulls.first + hulls.count; ++h) {
        const ConvexHull& hull = set_.hulls[h];
        for (uint32_t p = hull.points.first; p < hull.points.first + hull.points.count; ++p) {
            const glm::vec3 point = pose * set_.hullPoints[p];
            box.low = glm::min(box.low, point - hull.margin);
            box.high = glm::max(box.high, point + hull.margin);
        }
    }
    return box;
}

Asset::Box Asset::boxAround(std::span<const uint32_t> fragments) const {
    Box around = boxes_[fragments.front()];
    for (const uint32_t f : fragments) {
        around.low = glm::min(around.low, boxes_[f].low);
        around.high = glm::max(around.high, boxes_[f].high);
    }
    return around;
}

float Asset::distance(const Box& box, const glm::vec3& point) {
    return glm::distance(point, glm::clamp(point, box.low, box.high));
}

std::span<const DrawRange> Asset::drawRanges(uint32_t f) const {
    const Asset& drawn = original();
    const Range range = drawn.drawRangesOf_[f];
    return std::span<const DrawRange>(drawn.drawRanges_).subspan(range.first, range.count);
}

Result<std::vector<std::shared_ptr<const Asset>>> loadAssets(std::span<const uint8_t> glb) {
    return loadGuarded(glb);
}

Result<std::vector<std::shared_ptr<const Asset>>> loadAssets(const std::filesystem::path& path) {
    return loadGuarded(path);
}

Result<std::vector<std::shared_ptr<const Asset>>> loadAssets(const FileReader& reader,
                                                             const char* path) {
    if (!reader.read || !path)
        return fail(ErrorCode::badArgument, "the reader and the path must not be null", "reader");
    std::vector<uint8_t> bytes;
    if (!reader.read(reader.user, path, bytes))
        return fail(ErrorCode::fileNotFound, "the game's reader found no such file", path);
    auto assets = loadAssets(bytes);
    if (!assets) assets.error().where = path + (":" + assets.error().where);
    return assets;
}

}  // namespace sherd
