// SPDX-License-Identifier: MIT
// The part of sherd.h about assets. No exception passes: out of memory is a status.
#include <cmath>
#include <utility>

#include "c_abi/convert.h"
#include "sherd/runtime/asset.h"

using namespace sherd;
using namespace sherd::c_abi;

namespace sherd::c_abi {

HandleTable<const Asset>& assets() {
    static auto* table = new HandleTable<const Asset>;
    return *table;
}

}  // namespace sherd::c_abi

namespace {

/// With a fragment of it; null when there is none such.
std::shared_ptr<const Asset> find(sherd_asset asset, uint32_t fragment) {
    auto found = assets().find(asset.id);
    return found && fragment < found->fragmentCount() ? found : nullptr;
}

/// `status`, if it is not for want of memory.
sherd_status sayWhy(sherd_error* error, const Error& why, sherd_status status) {
    const bool isLarge = why.code == ErrorCode::limitExceeded;
    return say(error, isLarge ? SHERD_NO_MEMORY : status, why.message, why.where);
}

sherd_status refusal(sherd_asset asset) {
    return assets().find(asset.id) ? SHERD_BAD_ARGUMENT : SHERD_GONE;
}

}  // namespace

uint32_t sherd_abi_version(void) {
    return SHERD_ABI_VERSION;
}

const char* sherd_version(void) {
    return SHERD_VERSION;
}

sherd_status sherd_load(const void* bytes, size_t size, sherd_asset* out, uint32_t capacity,
                        uint32_t* count, sherd_error* error) {
    if (count) *count = 0;
    if (!count || !bytes || (!out && capacity > 0))
        return say(error, SHERD_BAD_ARGUMENT, "a pointer is null", "arguments");
    return guarded([&] {
        const auto loaded = loadAssets(std::span(static_cast<const uint8_t*>(bytes), size));
        if (!loaded) return sayWhy(error, loaded.error(), SHERD_MALFORMED);
        *count = uint32_t(loaded->size());
        if (!out || loaded->size() > capacity)
            return say(error, SHERD_TOO_SMALL, "the file holds more objects than the array",
                       "capacity");
        for (size_t i = 0; i < loaded->size(); ++i) out[i] = {assets().add((*loaded)[i])};
        return SHERD_OK;
    });
}

sherd_status sherd_asset_scale(sherd_asset asset, float factor, sherd_asset* out,
                               sherd_error* error) {
    if (!out) return say(error, SHERD_BAD_ARGUMENT, "a pointer is null", "out");
    if (!(factor > 0) || !std::isfinite(factor))
        return say(error, SHERD_BAD_ARGUMENT, "the factor must be positive and finite", "factor");
    const auto found = assets().find(asset.id);
    if (!found) return say(error, SHERD_GONE, "there is no such asset", "asset");
    return guarded([&] {
        auto scaled = Asset::scaled(found, factor);
        if (!scaled) return sayWhy(error, scaled.error(), SHERD_BAD_ARGUMENT);
        *out = {assets().add(std::move(*scaled))};
        return SHERD_OK;
    });
}

void sherd_asset_release(sherd_asset asset) {
    assets().release(asset.id);
}

sherd_status sherd_asset_get_info(sherd_asset asset, sherd_asset_info* out) {
    if (!out) return SHERD_BAD_ARGUMENT;
    const auto found = assets().find(asset.id);
    if (!found) return SHERD_GONE;
    const FractureSet& set = found->set();
    *out = {};
    out->name = set.name.c_str();
    out->bake_hash = found->bakeHash();
    out->fragment_count = found->fragmentCount();
    out->level_count = uint32_t(set.levels.size());
    out->bond_count = uint32_t(found->graph().bonds().size());
    out->material_count = uint32_t(set.materials.size());
    const FractureGeometry& geometry = found->geometry();
    out->vertex_count = uint32_t(geometry.positions.size());
    out->index_count = uint32_t(geometry.indices.size());
    out->attribute_count = uint32_t(geometry.attributes.size()) + 1;
    out->diagonal = found->diagonal();
    out->scale = found->scale();
    out->rest_pose = pose(set.restPose);
    return SHERD_OK;
}

sherd_status sherd_asset_fragment(sherd_asset asset, uint32_t fragment, sherd_fragment* out) {
    if (!out) return SHERD_BAD_ARGUMENT;
    const auto found = find(asset, fragment);
    if (!found) return refusal(asset);
    const Fragment& f = found->fragment(fragment);
    *out = {};
    out->parent = f.parent;
    out->first_child = f.children.first;
    out->child_count = f.children.count;
    out->level = f.level;
    out->hull_count = f.hulls.count;
    out->name = f.name.c_str();
    out->material = f.material.c_str();
    out->mass = f.mass;
    out->volume = f.volume;
    out->density = f.density;
    out->friction = f.friction;
    out->restitution = f.restitution;
    out->strength = f.strength;
    out->toughness = f.toughness;
    put(out->center_of_mass, f.centerOfMass);
    put(out->low, found->box(fragment).low);
    put(out->high, found->box(fragment).high);
    return SHERD_OK;
}

sherd_status sherd_asset_hull(sherd_asset asset, uint32_t fragment, uint32_t hull,
                              const float** points, uint32_t* count, float* margin) {
    if (!points || !count || !margin) return SHERD_BAD_ARGUMENT;
    const auto found = find(asset, fragment);
    if (!found || hull >= found->fragment(fragment).hulls.count) return refusal(asset);
    const FractureSet& set = found->set();
    const ConvexHull& shape = set.hulls[found->fragment(fragment).hulls.first + hull];
    *points = &set.hullPoints[shape.points.first].x;
    *count = shape.points.count;
    *margin = shape.margin;
    return SHERD_OK;
}

sherd_status sherd_asset_attribute(sherd_asset asset, uint32_t attribute, sherd_attribute* out) {
    if (!out) return SHERD_BAD_ARGUMENT;
    const auto found = assets().find(asset.id);
    if (!found || attribute > found->geometry().attributes.size()) return refusal(asset);
    const FractureGeometry& geometry = found->geometry();
    if (attribute == 0) {
        *out = {"POSITION", 3, geometry.positions.empty() ? nullptr : &geometry.positions[0].x};
    } else {
        const Attribute& values = geometry.attributes[attribute - 1];
        *out = {values.semantic.c_str(), values.components, values.values.data()};
    }
    return SHERD_OK;
}

const uint32_t* sherd_asset_indices(sherd_asset asset, uint32_t* count) {
    const auto found = assets().find(asset.id);
    if (count) *count = found ? uint32_t(found->geometry().indices.size()) : 0;
    return found ? found->geometry().indices.data() : nullptr;
}

int32_t sherd_asset_material(sherd_asset asset, uint32_t material) {
    const auto found = assets().find(asset.id);
    return found && material < found->set().materials.size() ? found->set().materials[material]
                                                             : -1;
}

uint32_t sherd_asset_draw_ranges(sherd_asset asset, uint32_t fragment, sherd_draw_range* out,
                                 uint32_t capacity) {
    const auto found = find(asset, fragment);
    if (!found) return 0;
    const auto ranges = found->drawRanges(fragment);
    for (size_t i = 0; out && i < std::min<size_t>(ranges.size(), capacity); ++i)
        out[i] = {ranges[i].material, ranges[i].exposedFrom, ranges[i].indices.first,
                  ranges[i].indices.count};
    return uint32_t(ranges.size());
}

sherd_status sherd_asset_bond(sherd_asset asset, uint32_t bond, sherd_bond* out) {
    if (!out) return SHERD_BAD_ARGUMENT;
    const auto found = assets().find(asset.id);
    if (!found || bond >= found->graph().bonds().size()) return refusal(asset);
    const BondGraph& graph = found->graph();
    const BondGraph::Bond& b = graph.bond(bond);
    *out = {};
    out->a = graph.fragmentOfLeaf(b.a);
    out->b = b.b == BondGraph::kWorld ? SHERD_NONE : graph.fragmentOfLeaf(b.b);
    put(out->centroid, b.centroid);
    put(out->normal, b.normal);
    out->area = b.area;
    out->strength = b.strength;
    out->toughness = b.toughness;
    out->energy = b.energy;
    return SHERD_OK;
}
