// SPDX-License-Identifier: MIT
// What hangs together after random damage, against components found from the bonds alone.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "sherd/runtime/island_world.h"
#include "support/box_fracture.h"
#include "support/property.h"
#include "support/still_bodies.h"

using namespace sherd;

namespace {

/// Joins what bonds that hold join.
class Components {
  public:
    explicit Components(const Structure& structure) : parent_(structure.asset().fragmentCount()) {
        std::iota(parent_.begin(), parent_.end(), 0U);
        const BondGraph& graph = structure.graph();
        for (uint32_t b = 0; b < graph.bonds().size(); ++b) {
            const BondGraph::Bond& bond = graph.bond(b);
            if (structure.isBroken(b) || bond.b == BondGraph::kWorld) continue;
            parent_[of(structure.fragmentAt(bond.a))] = of(structure.fragmentAt(bond.b));
        }
    }
    uint32_t of(uint32_t fragment) const {
        while (parent_[fragment] != fragment) fragment = parent_[fragment];
        return fragment;
    }

  private:
    std::vector<uint32_t> parent_;
};

/// Islands that are not whole components, and components that are not one island each.
size_t wrongIslands(const IslandWorld& world, uint32_t object) {
    const Structure& structure = *world.object(object).structure;
    const Components components(structure);
    std::vector<uint32_t> seen;
    size_t wrong = 0, standing = 0;
    for (const uint32_t i : world.object(object).islands) {
        const IslandWorld::Island& island = world.island(i);
        const uint32_t component = components.of(island.fragments.front());
        seen.push_back(component);
        double mass = 0;
        for (const uint32_t fragment : island.fragments) {
            wrong += structure.stands(fragment) && components.of(fragment) == component ? 0 : 1;
            mass += double(structure.asset().fragment(fragment).mass);
        }
        wrong += std::is_sorted(island.fragments.begin(), island.fragments.end()) ? 0 : 1;
        wrong += std::abs(mass - island.mass) <= 1e-9 * mass ? 0 : 1;
        standing += island.fragments.size();
    }
    std::sort(seen.begin(), seen.end());
    wrong += std::adjacent_find(seen.begin(), seen.end()) == seen.end() ? 0 : 1;
    for (uint32_t f = 0; f < structure.asset().fragmentCount(); ++f)
        standing -= structure.stands(f) ? 1 : 0;
    return wrong + (standing == 0 ? 0 : 1);
}

}  // namespace

TEST_CASE("after every hit, islands are what bonds that hold hold together") {
    uint32_t most = 0;
    for (uint32_t seed = 1; seed <= 16; ++seed) {
        CAPTURE(seed);
        test::Random random(seed);
        FractureSet set =
            test::makeBoxFracture({.size = {2, 1.6F, 1}, .level1 = {5, 4, 2}, .level2 = {2, 2, 2}});
        // Children that nothing holds together come apart as soon as what they are in is open.
        if (seed % 2 == 0) std::erase_if(set.bonds, [&](const Bond&) { return random.oneIn(2); });
        const auto asset = Asset::fromFractureSet(std::move(set)).value();
        const Asset::Box box = asset->box(0);
        const auto number = [&](float from, float to) {
            return float(random.in(double(from), double(to)));
        };
        const auto place = [&] {
            const glm::vec3 &a = box.low, &b = box.high;
            return glm::vec3(number(a.x, b.x), number(a.y, b.y), number(a.z, b.z));
        };
        test::StillBodies bodies;
        IslandWorld world(bodies);
        const uint32_t object = world.spawn(asset, {}, {}, true, {}).index;
        size_t wrong = 0;
        for (int i = 0; i < 60; ++i) {
            world.allowBodies(seed % 3 == 0 ? 2 : UINT32_MAX);
            const auto& islands = world.object(object).islands;
            const uint32_t island = islands[random.below(uint32_t(islands.size()))];
            const auto& fragments = world.island(island).fragments;
            const uint32_t fragment = fragments[random.below(uint32_t(fragments.size()))];
            const uint32_t way = random.below(8);
            if (way < 3) {
                ReportedHit hit;
                hit.point = place();
                hit.energy = asset->breakEnergy(0) * number(0, way == 0 ? 0.3F : 0.03F);
                hit.impulse = hit.speed = 1e3F;
                (void)world.takeHit(island, fragment, hit);
            } else if (way < 6) {
                AreaDamage damage;
                damage.shape = way == 5 ? AreaDamage::Shape::box : AreaDamage::Shape::sphere;
                damage.a = place();
                damage.b = {number(0, 0.5F), 3, number(0, 0.1F)};
                damage.radius = number(0.05F, 0.4F);
                damage.fluence = number(0, 1e3F);
                (void)world.dealArea(object, damage);
            } else if (way == 6) {
                (void)world.breakFragment(object, fragment, random.oneIn(2));
            } else {
                (void)world.pinFragment(object, fragment, !random.oneIn(3));
            }
            wrong += wrongIslands(world, object);
        }
        CHECK(wrong == 0);
        most = std::max(most, world.islandCount());
    }
    CHECK(most > 30);
}
