// SPDX-License-Identifier: MIT
#include "sherd/runtime/structure_queries.h"

#include <doctest/doctest.h>

#include "support/box_fracture.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Three pieces in a row, 1 m wide, each of the next two in halves: 0 whole; 1, 2, 3; 4 to 9.
Structure row() {
    return Structure(
        Asset::fromFractureSet(
            makeBoxFracture({.size = {3, 1, 1}, .level1 = {3, 1, 1}, .level2 = {1, 2, 1}}))
            .value());
}

/// All bonds between two fragments, of whatever levels.
std::vector<uint32_t> bondsBetween(const Structure& structure, uint32_t x, uint32_t y) {
    const BondGraph& graph = structure.graph();
    std::vector<uint32_t> found;
    for (uint32_t b = 0; b < graph.bonds().size(); ++b) {
        const BondGraph::Bond& bond = graph.bond(b);
        if ((graph.contains(x, bond.a) && graph.contains(y, bond.b)) ||
            (graph.contains(y, bond.a) && graph.contains(x, bond.b)))
            found.push_back(b);
    }
    return found;
}

}  // namespace

TEST_CASE("an intact object has no neighbours, and what does not stand has none either") {
    const Structure structure = row();
    std::vector<Neighbor> found{{1, 1, 1}};
    for (const uint32_t fragment : {0U, 1U, 5U, 4000000U}) {
        findNeighbors(structure, fragment, found);
        CHECK(found.empty());
    }
    CHECK(healthOf(structure, 0) == 1);
}

TEST_CASE("a fragment's neighbours are those that stand across bonds that hold") {
    Structure structure = row();
    structure.open(0);
    std::vector<Neighbor> found;
    findNeighbors(structure, 2, found);
    REQUIRE(found.size() == 2);
    CHECK(found[0].fragment == 1);
    CHECK(found[1].fragment == 3);
    CHECK(found[0].area == doctest::Approx(1));
    CHECK(found[0].health == 1);

    // One of the two leaf bonds to 1 breaks, the other is worn: a quarter is left of it all.
    const auto between = bondsBetween(structure, 1, 2);
    REQUIRE(between.size() == 2);
    structure.breakBond(between[0]);
    structure.weaken(between[1], 0.5F);
    findNeighbors(structure, 2, found);
    REQUIRE(found.size() == 2);
    CHECK(found[0].area == doctest::Approx(0.5));
    CHECK(found[0].health == doctest::Approx(0.25));
    CHECK(healthOf(structure, 1) < healthOf(structure, 3));

    structure.breakBond(between[1]);
    findNeighbors(structure, 2, found);
    REQUIRE(found.size() == 1);
    CHECK(found[0].fragment == 3);

    // Opened further, its halves are each other's neighbours.
    structure.open(3);
    findNeighbors(structure, 2, found);
    CHECK(found.size() == 2);
    findNeighbors(structure, found[0].fragment, found);
    CHECK(found.size() == 2);
}

TEST_CASE("a fragment's health counts bonds within and around it once each") {
    Structure structure = row();
    for (const uint32_t b : bondsBetween(structure, 1, 2)) structure.breakBond(b);
    // 1 has a bond of 1 m x 1 m within, and lost two of 1 m x 0.5 m.
    CHECK(healthOf(structure, 1) == doctest::Approx(0.5));
    for (uint32_t b = 0; b < structure.graph().bonds().size(); ++b) structure.breakBond(b);
    CHECK(healthOf(structure, 0) == 0);
}

TEST_CASE("an object of one piece is as healthy as can be") {
    const Structure structure(
        Asset::fromFractureSet(makeBoxFracture({.level1 = {1, 1, 1}})).value());
    CHECK(healthOf(structure, 0) == 1);
}
