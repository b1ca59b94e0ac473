// SPDX-License-Identifier: MIT
// Property: whatever is drawn on whatever mesh, cutting gives what exact arithmetic gives.
#include <doctest/doctest.h>

#include <cmath>

#include "split_checks.h"
#include "support/plans.h"
#include "support/random_surfaces.h"

using namespace sherd;
using namespace sherd::test;

namespace {

struct Tally {
    uint32_t undecided = 0, samples = 0, cells = 0;
};

/// Cuts and runs every check; `partition`: the brute force over cells, too.
std::string whatBreaks(const SurfaceMesh& mesh, const FractureMap& map, bool partition,
                       Tally& tally) {
    const MeshTopology before = buildTopology(mesh.positions, mesh.triangles);
    const Result<CutSurface> cut = cutSurface(mesh, before, planOf(map), exactOptions());
    if (!cut) return cut.error().message;
    const Components components =
        floodFill(cut->surface, cut->topology, cut->lines, cut->lines.levels());
    CutOracle oracle(mesh, map);
    if (oracle.levels != cut->lines.levels()) return "another number of levels";
    for (const std::string& wrong :
         {brokenConformity(mesh, *cut), brokenArea(mesh, *cut), brokenPlaces(mesh, *cut),
          brokenMarks(*cut), brokenComponents(*cut, components),
          brokenGeometry(mesh, *cut, oracle, tally.undecided)}) {
        if (!wrong.empty()) return wrong;
    }
    if (!partition) return "";
    oracle.findComponents();
    tally.cells += static_cast<uint32_t>(oracle.samples.size());
    return brokenPartition(mesh, *cut, components, oracle, tally.samples);
}

double randomScale(Random& random) {
    return random.oneIn(2) ? 1.0 : std::pow(10.0, static_cast<int>(random.below(13)) - 6);
}

}  // namespace

TEST_CASE("small meshes and maps are cut into the very parts that exact arithmetic finds") {
    Tally tally;
    for (const uint32_t seed : propertySeeds(100'000, 8000)) {
        CAPTURE(seed);
        Random random(seed);
        SurfaceChoice choice;
        choice.cells = 1 + random.below(3);
        choice.scale = randomScale(random);
        const SurfaceMesh mesh = randomSurface(random, choice);
        REQUIRE(whatBreaks(mesh, randomMap(random, mesh, 4), true, tally) == "");
    }
    MESSAGE(tally.samples, " of ", tally.cells, " cells compared, ", tally.undecided, " thin");
    CHECK(tally.samples > tally.cells / 2);
}

TEST_CASE("meshes that touch themselves, with fins and needles, are split as exactly") {
    Tally tally;
    for (const uint32_t seed : propertySeeds(200'000, 1500)) {
        CAPTURE(seed);
        Random random(seed);
        SurfaceChoice choice;
        choice.nonManifold = true;
        choice.scale = randomScale(random);
        const SurfaceMesh mesh = randomSurface(random, choice);
        REQUIRE(whatBreaks(mesh, randomMap(random, mesh, 20), false, tally) == "");
    }
}

TEST_CASE("up to 200 lines on one mesh are cut as exactly") {
    Tally tally;
    for (const uint32_t seed : propertySeeds(300'000, 500)) {
        CAPTURE(seed);
        Random random(seed);
        SurfaceChoice choice;
        choice.cells = 1 + random.below(6);
        choice.scale = randomScale(random);
        const SurfaceMesh mesh = randomSurface(random, choice);
        REQUIRE(whatBreaks(mesh, randomMap(random, mesh, 160), false, tally) == "");
    }
}
