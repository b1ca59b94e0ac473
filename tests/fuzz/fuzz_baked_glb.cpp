// SPDX-License-Identifier: MIT
// What a game loads: assets whose every index is in range, or an error; and the check of the file.
#include "fuzzed_promise.h"
#include "glb_mutation.h"
#include "sherd/formats/validate.h"
#include "sherd/runtime/island_world.h"
#include "support/still_bodies.h"

namespace {

using namespace sherd;
using fuzz::require;

bool within(Range range, size_t count) {
    return size_t{range.first} + range.count <= count;
}

void breakUp(const std::shared_ptr<const Asset>& asset) {
    test::StillBodies bodies;
    IslandWorld world(bodies);
    const ObjectId object = world.spawn(asset, {}, {}, true, {});
    ReportedHit hit;
    hit.energy = 10;
    hit.speed = 10;
    hit.impulse = 10;
    const float consumed = world.takeHit(0, 0, hit);
    require(consumed >= 0 && consumed <= hit.energy * 1.001F, "a hit takes what it brought");
    world.workOnStress({0, -10, 0}, 8);
    world.breakAll(object.index);
    require(world.poses().size() <= asset->fragmentCount(), "no fragment is drawn twice");
    for (const float mass : bodies.masses)
        require(mass >= 0 && std::isfinite(mass), "a body has a mass");
    world.remove(object.index);
}

void walk(const Asset& asset) {
    const FractureSet& set = asset.set();
    require(!set.fragments.empty(), "there is a fragment");
    for (const uint32_t index : asset.geometry().indices)
        require(index < asset.geometry().positions.size(), "an index is in range");
    for (uint32_t f = 0; f < asset.fragmentCount(); ++f) {
        const Fragment& fragment = asset.fragment(f);
        require(fragment.parent < static_cast<int32_t>(f), "parents come first");
        require(within(fragment.children, asset.fragmentCount()), "children are in range");
        require(fragment.mass > 0 && std::isfinite(fragment.mass), "a fragment has a mass");
        require(within(fragment.hulls, set.hulls.size()), "hulls are in range");
        for (const DrawRange& range : asset.drawRanges(f)) {
            require(within(range.indices, asset.geometry().indices.size()), "a draw is in range");
            require(range.material < set.materials.size(), "a material is in range");
        }
        require(!std::isnan(asset.breakEnergy(f)), "breaking takes energy");
    }
    for (const ConvexHull& hull : set.hulls)
        require(within(hull.points, set.hullPoints.size()), "hull points are in range");
    for (const Bond& bond : set.bonds) {
        const auto count = static_cast<int32_t>(asset.fragmentCount());
        require(bond.a >= 0 && bond.a < count && bond.b >= -1 && bond.b < count,
                "a bond joins fragments");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::span<const uint8_t> glb(data, size);
    const auto assets = loadAssets(glb);
    if (!assets) {
        require(!assets.error().message.empty(), "an error says what");
        return 0;
    }
    require(!assets->empty(), "a file that was read has an object");
    for (const auto& asset : *assets) {
        walk(*asset);
        breakUp(asset);
    }
    CheckOptions options;
    options.coverage = false;
    (void)checkFractureSets(glb, options);
    return 0;
}
