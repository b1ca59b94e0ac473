// SPDX-License-Identifier: MIT
#include "sherd/runtime/area_damage.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "core/bond_price.h"
#include "core/finite.h"
#include "sherd/runtime/structure.h"

namespace sherd {
namespace {

/// What of the fluence reaches a place, 0..1.
float shareAt(const AreaDamage& damage, const glm::vec3& place) {
    if (damage.shape == AreaDamage::Shape::box) {
        const glm::vec3 off = glm::abs(glm::inverse(damage.rotation) * (place - damage.a));
        return glm::all(glm::lessThanEqual(off, damage.b)) ? 1.0F : 0.0F;
    }
    glm::vec3 nearest = damage.a;
    if (damage.shape == AreaDamage::Shape::capsule) {
        const glm::vec3 way = damage.b - damage.a;
        const float length2 = glm::dot(way, way);
        if (length2 > 0)
            nearest += way * glm::clamp(glm::dot(place - damage.a, way) / length2, 0.0F, 1.0F);
    }
    const float inside = 1 - glm::distance(place, nearest) / damage.radius;
    if (!(inside >= 0)) return 0;
    return damage.falloff > 0 ? std::min(inside / damage.falloff, 1.0F) : 1.0F;
}

}  // namespace

const char* whyRefused(const AreaDamage& damage) {
    if (!isFinite(damage.a) || !isFinite(damage.b) || !isFinite(damage.shear))
        return "places and directions must be finite";
    if (!isUnit(damage.rotation)) return "the rotation must be a unit quaternion";
    if (!(damage.fluence >= 0)) return "the fluence must not be negative";
    if (!(damage.falloff >= 0 && damage.falloff <= 1)) return "the falloff must be 0 to 1";
    if (damage.shape != AreaDamage::Shape::box && !(damage.radius > 0 && damage.radius < HUGE_VALF))
        return "the radius must be positive and finite";
    return nullptr;
}

AreaDamage seenFrom(const RigidPose& frame, const AreaDamage& damage) {
    const glm::quat back = glm::inverse(frame.rotation);
    AreaDamage result = damage;
    result.a = back * (damage.a - frame.translation);
    if (damage.shape == AreaDamage::Shape::capsule)
        result.b = back * (damage.b - frame.translation);
    result.rotation = back * damage.rotation;
    result.shear = back * damage.shear;
    return result;
}

void applyArea(Structure& structure, std::span<const uint32_t> fragments, const AreaDamage& damage,
               const DamageOptions& options, HitResult& result) {
    const BondGraph& graph = structure.graph();
    const Asset& asset = structure.asset();
    result.clear();
    const auto deal = [&](uint32_t b) {
        const BondGraph::Bond& bond = graph.bond(b);
        const float share = shareAt(damage, bond.centroid);
        if (!(share > 0) || structure.isBroken(b)) return;
        const uint32_t level = asset.fragment(bond.parting).level;
        if (level >= options.maxLevel) return;
        float fluence = damage.fluence * share;
        if (damage.shear != glm::vec3(0.0F)) {
            const float across = glm::dot(damage.shear, bond.normal);
            fluence *= std::sqrt(std::max(1 - across * across, 0.0F));
        }
        if (!(fluence > 0)) return;
        const float price = priceOf(asset, bond, options);
        const float left = price * structure.health(b);
        const float brought = fluence * bond.area;
        if (brought >= left) {
            structure.breakBond(b);
            result.bonds.push_back(b);
            result.area += bond.area;
            result.consumed += left;
            result.level = std::max(result.level, level + 1);
        } else {
            structure.weaken(b, brought / price);
            result.consumed += brought;
        }
    };
    for (const uint32_t fragment : fragments) {
        const Range leaves = graph.leavesOf(fragment);
        for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf) {
            // Once: anchors are beyond all leaves.
            for (const BondGraph::Edge& edge : graph.edgesOf(leaf))
                if (edge.other > leaf) deal(edge.bond);
        }
    }
    for (const uint32_t b : result.bonds)
        if (graph.bond(b).b != BondGraph::kWorld)
            structure.openDownTo(graph.bond(b).parting, result.opened);
}

void heal(Structure& structure, float share) {
    if (!structure.isDamaged() || !(share > 0)) return;
    for (uint32_t b = 0; b < structure.graph().bonds().size(); ++b)
        if (!structure.isBroken(b)) structure.strengthen(b, share);
}

}  // namespace sherd
