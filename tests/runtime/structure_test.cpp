// SPDX-License-Identifier: MIT
#include "sherd/runtime/structure.h"

#include <doctest/doctest.h>

#include <random>

#include "sherd/runtime/damage.h"
#include "support/box_fracture.h"

using namespace sherd;

namespace {

std::shared_ptr<const Asset> makeBox(const test::BoxFracture& recipe) {
    return Asset::fromFractureSet(test::makeBoxFracture(recipe)).value();
}

/// The islands of all that stands.
struct Island {
    std::vector<uint32_t> fragments;
    bool anchored;
    double mass;
};

std::vector<Island> islandsOf(const Structure& structure) {
    std::vector<uint32_t> standing;
    for (uint32_t f = 0; f < structure.asset().fragmentCount(); ++f)
        if (structure.stands(f)) standing.push_back(f);
    IslandFinder finder;
    finder.find(structure, standing);
    std::vector<Island> islands;
    for (const IslandFinder::Island& island : finder.islands()) {
        const auto fragments = finder.fragmentsOf(island);
        islands.push_back({{fragments.begin(), fragments.end()}, island.anchored, island.mass});
    }
    return islands;
}

Hit hitAt(const glm::vec3& point, float energy, uint32_t fragment = 0) {
    Hit hit;
    hit.fragment = fragment;
    hit.point = point;
    hit.energy = energy;
    hit.stress = 1e12F;  // whatever the distance
    return hit;
}

}  // namespace

TEST_CASE("every fragment owns a run of leaves, and its children share it out") {
    const auto asset = makeBox({.level1 = {3, 2, 1}, .level2 = {2, 2, 2}});
    const BondGraph& graph = asset->graph();
    CHECK(graph.leafCount() == 48);
    for (uint32_t f = 0; f < asset->fragmentCount(); ++f) {
        const Range leaves = graph.leavesOf(f);
        const Range children = asset->fragment(f).children;
        uint32_t next = leaves.first;
        for (uint32_t c = children.first; c < children.first + children.count; ++c) {
            CHECK(graph.leavesOf(c).first == next);
            next += graph.leavesOf(c).count;
            for (uint32_t l = graph.leavesOf(c).first; l < next; ++l)
                CHECK(graph.childWith(f, l) == c);
        }
        if (children.count > 0) CHECK(next == leaves.first + leaves.count);
        if (children.count == 0) CHECK(graph.fragmentOfLeaf(leaves.first) == f);
    }
}

TEST_CASE("each bond is an edge of both its leaves, an anchor of one") {
    FractureSet set = test::makeBoxFracture({.level2 = {2, 1, 1}});
    Bond anchor = set.bonds[0];
    anchor.b = -1;
    set.bonds.push_back(anchor);
    const auto asset = Asset::fromFractureSet(std::move(set)).value();
    const BondGraph& graph = asset->graph();
    std::vector<int> sides(graph.bonds().size(), 0);
    for (uint32_t leaf = 0; leaf < graph.leafCount(); ++leaf) {
        for (const BondGraph::Edge& edge : graph.edgesOf(leaf)) {
            ++sides[edge.bond];
            const BondGraph::Bond& bond = graph.bond(edge.bond);
            CHECK((bond.a == leaf ? bond.b : bond.a) == edge.other);
        }
    }
    for (uint32_t b = 0; b < sides.size(); ++b)
        CHECK(sides[b] == (graph.bond(b).b == BondGraph::kWorld ? 1 : 2));
    CHECK(graph.isAnchored(0));
    CHECK(graph.isAnchored(uint32_t(asset->set().bonds[0].a)));
    CHECK_FALSE(graph.isAnchored(1 + 7));
}

TEST_CASE("an object nothing has hit is whole and takes no memory for its bonds") {
    const Structure structure(makeBox({}));
    CHECK_FALSE(structure.isDamaged());
    CHECK(structure.stands(0));
    CHECK_FALSE(structure.stands(1));
    CHECK(structure.health(0) == 1);
    REQUIRE(islandsOf(structure).size() == 1);
    CHECK(islandsOf(structure)[0].mass == doctest::Approx(1000));
}

TEST_CASE("a hit of exactly all bonds' energy breaks them all, a little less leaves some") {
    const auto asset = makeBox({});  // 8 cubes, 12 bonds of 12.5 J
    HitResult result;
    Structure all(asset);
    HitSolver().apply(all, hitAt({-0.5F, 0.1F, 0.1F}, 150.01F), {}, result);
    CHECK(result.bonds.size() == 12);
    CHECK(result.consumed == doctest::Approx(150));
    CHECK(result.area == doctest::Approx(3));
    CHECK(islandsOf(all).size() == 8);

    Structure some(asset);
    HitSolver().apply(some, hitAt({-0.5F, 0.1F, 0.1F}, 140), {}, result);
    CHECK(result.consumed == doctest::Approx(140));
    CHECK(result.bonds.size() < 12);
    CHECK_FALSE(result.bonds.empty());
    CHECK(islandsOf(some).size() < 8);
}

TEST_CASE("damage falls with distance, adds up, and breaks when it is full") {
    const auto asset = makeBox({.size = {8, 1, 1}, .level1 = {8, 1, 1}});  // a chain, 50 J a bond
    Structure structure(asset);
    HitResult result;
    HitSolver().apply(structure, hitAt({-3.4F, 0, 0}, 30), {}, result);
    CHECK_FALSE(result.brokeSomething());
    CHECK(result.consumed == doctest::Approx(30));
    const auto& graph = structure.graph();
    for (uint32_t b = 1; b < graph.bonds().size(); ++b)
        CHECK(structure.health(b) > structure.health(b - 1));
    int hits = 1;
    for (; hits < 20 && !result.brokeSomething(); ++hits)
        HitSolver().apply(structure, hitAt({-3.4F, 0, 0}, 30), {}, result);
    CHECK(hits < 10);
    REQUIRE(result.bonds.size() == 1);
    CHECK(result.bonds[0] == 0);
    CHECK(islandsOf(structure).size() == 2);
}

TEST_CASE("stress below a bond's strength takes nothing from it, whatever the energy") {
    const auto asset = makeBox({.size = {8, 1, 1}, .level1 = {8, 1, 1}});
    Structure structure(asset);
    HitResult result;
    Hit hit = hitAt({-4, 0, 0}, 1e9F);
    hit.stress = 0.9e6F;  // bonds hold 1 MPa
    HitSolver().apply(structure, hit, {}, result);
    CHECK(result.consumed == 0);
    CHECK_FALSE(structure.isDamaged());
    hit.stress = 1.5e6F;  // falls below 1 MPa somewhere along the chain
    HitSolver().apply(structure, hit, {}, result);
    CHECK(result.bonds.size() > 0);
    CHECK(result.bonds.size() < 7);
    DamageOptions strong;
    strong.strengthScale = 10;
    Structure other(asset);
    HitSolver().apply(other, hit, strong, result);
    CHECK_FALSE(result.brokeSomething());
}

TEST_CASE("what is left descends into the part that was struck, and only there") {
    const auto asset = makeBox({.level2 = {2, 2, 2}});
    Structure structure(asset);
    HitResult result;
    const float all = asset->breakEnergy(0);
    HitSolver().apply(structure, hitAt({-0.5F, -0.4F, -0.4F}, all + 35), {}, result);
    REQUIRE(result.opened.size() == 2);
    CHECK(result.opened[0] == 0);
    CHECK(result.opened[1] == 1);
    CHECK(result.level == 2);
    CHECK(structure.stands(2));
    CHECK_FALSE(structure.stands(1));
    CHECK(asset->fragment(result.struck).level == 2);
    DamageOptions shallow;
    shallow.maxLevel = 1;
    Structure other(asset);
    HitSolver().apply(other, hitAt({-0.5F, -0.4F, -0.4F}, all + 35), shallow, result);
    CHECK(result.opened.size() == 1);
}

TEST_CASE("an island that loses its last anchor is no longer anchored") {
    FractureSet set = test::makeBoxFracture({.size = {4, 1, 1}, .level1 = {4, 1, 1}});
    Bond anchor = set.bonds[0];
    anchor.b = -1;
    anchor.centroid = {-2, 0, 0};
    set.bonds.push_back(anchor);
    Structure structure(Asset::fromFractureSet(std::move(set)).value());
    structure.open(0);
    REQUIRE(islandsOf(structure).size() == 1);
    CHECK(islandsOf(structure)[0].anchored);
    structure.breakBond(1);
    auto islands = islandsOf(structure);
    REQUIRE(islands.size() == 2);
    CHECK(islands[0].anchored);
    CHECK_FALSE(islands[1].anchored);
    structure.breakBond(3);
    CHECK_FALSE(islandsOf(structure)[0].anchored);
}

TEST_CASE("random hits consume no more than they bring, and never mend anything") {
    for (uint32_t seed = 1; seed <= 200; ++seed) {
        CAPTURE(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(0, 1);
        const auto asset = makeBox({.level1 = {2, 3, 2}, .level2 = {2, 2, 1}, .toughness = 10});
        Structure structure(asset);
        double brought = 0, consumed = 0;
        std::vector<float> health(asset->graph().bonds().size(), 1.0F);
        for (int i = 0; i < 20; ++i) {
            std::vector<uint32_t> standing;
            for (uint32_t f = 0; f < asset->fragmentCount(); ++f)
                if (structure.stands(f)) standing.push_back(f);
            const glm::vec3 point{unit(random) - 0.5F, unit(random) - 0.5F, unit(random) - 0.5F};
            Hit hit = hitAt(point, 20 * unit(random),
                            standing[size_t(unit(random) * 0.999F * float(standing.size()))]);
            hit.stress = 1e6F * (1 + 4 * unit(random));
            HitResult result;
            HitSolver().apply(structure, hit, {}, result);
            CHECK(result.consumed <= hit.energy * 1.00001F);
            brought += double(hit.energy);
            consumed += double(result.consumed);
            for (uint32_t b = 0; b < health.size(); ++b) {
                CHECK(structure.health(b) <= health[b]);
                health[b] = structure.health(b);
            }
        }
        double lost = 0;
        for (uint32_t b = 0; b < health.size(); ++b) {
            const auto& bond = asset->graph().bond(b);
            lost += double((1 - health[b]) * bond.area * bond.toughness);
        }
        CHECK(consumed <= brought);
        CHECK(lost == doctest::Approx(consumed).epsilon(1e-3));
        // Every leaf is in exactly one island.
        uint32_t leaves = 0;
        for (const Island& island : islandsOf(structure))
            for (const uint32_t f : island.fragments) leaves += asset->graph().leavesOf(f).count;
        CHECK(leaves == asset->graph().leafCount());
    }
}
