// SPDX-License-Identifier: MIT
// Property: whatever closed mesh is cut into whatever cells, the pieces are closed and fill it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "cut_checks.h"
#include "geometry/bounds.h"
#include "geometry/closed_mesh.h"
#include "volume/slab_cells.h"
#include "volume/voronoi_cells.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// In and around the solid; aligned: on its own grid of quarters, more or less.
glm::dvec3 randomSite(Random& random, const Bounds& box, bool aligned) {
    const double reach = 0.7 * std::max({box.size().x, box.size().y, box.size().z});
    glm::dvec3 p;
    for (int k = 0; k < 3; ++k) {
        p[k] = box.middle()[k] + random.in(-reach, reach);
        if (aligned) p[k] = std::round(4 * p[k]) / 4;
    }
    return p;
}

glm::dvec3 someVertex(Random& random, const Solid& solid) {
    const auto& t = solid.triangles[random.below(static_cast<uint32_t>(solid.triangles.size()))];
    return solid.positions[t[random.below(3)]];
}

/// Mirror images in planes through vertices, edges and faces, too.
std::vector<glm::dvec3> randomSites(Random& random, const Solid& solid) {
    const Bounds box = boundsOf(solid.positions, solid.triangles);
    const bool aligned = random.oneIn(2);
    std::vector<glm::dvec3> sites;
    const uint32_t count = 1 + random.below(12);
    while (sites.size() < count) {
        sites.push_back(randomSite(random, box, aligned));
        if (sites.size() >= count || !random.oneIn(3)) continue;
        const glm::dvec3 v = someVertex(random, solid);
        const int axis = static_cast<int>(random.below(3));
        glm::dvec3 mirrored = 2.0 * v - sites.back();
        if (random.oneIn(2)) {
            mirrored = sites.back();
            mirrored[axis] = 2 * v[axis] - mirrored[axis];
        }
        sites.push_back(mirrored);
    }
    return sites;
}

std::vector<CellFamily> randomSlices(Random& random, const Solid& solid) {
    SliceOptions options;
    do {
        for (uint32_t& n : options.counts) n = 1 + random.below(4);
    } while (options.counts[0] * options.counts[1] * options.counts[2] > 12);
    options.seed = random.below(1000);
    if (random.oneIn(2)) options.offsetJitter = random.unit();
    if (random.oneIn(2)) options.angleJitter = random.unit();
    const Bounds box = boundsOf(solid.positions, solid.triangles);
    return sliceCells(options, box.low, box.high, gridOf(solid)).value();
}

std::vector<CellFamily> randomCells(Random& random, const Solid& solid) {
    const CutGrid grid = gridOf(solid);
    switch (random.below(4)) {
        case 0:
            return randomSlices(random, solid);
        case 1: {  // planes through vertices
            std::vector<CutPlane> planes(1 + random.below(3));
            for (CutPlane& p : planes) {
                p.point = someVertex(random, solid);
                p.normal = {random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
                if (random.oneIn(2)) p.normal = glm::round(2.0 * p.normal);
                if (p.normal == glm::dvec3(0)) p.normal = {0, 0, 1};
            }
            return planeCells(planes, grid).value();
        }
        default:
            return {voronoiCells(randomSites(random, solid), grid).value()};
    }
}

}  // namespace

TEST_CASE("random closed meshes in up to 12 cells give closed pieces that fill them") {
    uint32_t crossed = 0, united = 0, moved = 0, slivers = 0;
    for (const uint32_t seed : propertySeeds(1'000'000, 5000)) {
        CAPTURE(seed);
        Random random(seed);
        const Solid solid = randomSolid(random);
        std::vector<CellFamily> cells = randomCells(random, solid);
        CutSolid cut;
        std::string wrong;
        const bool done = cutSolid(solid, std::move(cells), cut, wrong);
        REQUIRE(wrong == "");
        REQUIRE(done);
        REQUIRE(whatBreaks(cut, random, 20) == "");
        REQUIRE(cut.cut.report.fans == 0);
        crossed += cut.cut.report.crossedCaps;
        united += cut.cut.report.united;
        moved += cut.cut.report.movedPlanes;
        slivers += cut.pieces.slivers;
    }
    // What the test is for does happen.
    CHECK(crossed > 0);
    CHECK(united > 0);
    CHECK(moved > 0);
    MESSAGE("caps crossing themselves " << crossed << ", vertices united " << united
                                        << ", planes moved " << moved << ", slivers " << slivers);
}

TEST_CASE("a mesh of another size, by a power of two, is cut into the same pieces") {
    for (const uint32_t seed : propertySeeds(2'000'000, 300)) {
        CAPTURE(seed);
        std::vector<CutSolid> cuts;
        for (const float scale : {1.0F, 0x1p-10F, 0x1p10F}) {
            Random random(seed);
            Solid solid = randomSolid(random);
            std::vector<CellFamily> cells = randomCells(random, solid);
            solid.transform([scale](const glm::vec3& p) { return p * scale; });
            std::string wrong;
            cuts.emplace_back();
            REQUIRE(cutSolid(solid, std::move(cells), cuts.back(), wrong));
            const CutSolid& cut = cuts.back();
            REQUIRE(cut.pieces.pieces.size() == cuts[0].pieces.pieces.size());
            for (size_t p = 0; p < cut.pieces.pieces.size(); ++p) {
                REQUIRE(cut.pieces.pieces[p].vertices == cuts[0].pieces.pieces[p].vertices);
                REQUIRE(cut.pieces.pieces[p].triangles == cuts[0].pieces.pieces[p].triangles);
            }
            REQUIRE(cut.cut.positions.size() == cuts[0].cut.positions.size());
            for (size_t v = 0; v < cut.cut.positions.size(); ++v)
                REQUIRE(cut.cut.positions[v] == cuts[0].cut.positions[v] * scale);
        }
    }
}

TEST_CASE("a mesh a thousand times as large or small gives as many pieces of the same volumes") {
    for (const uint32_t seed : propertySeeds(3'000'000, 300)) {
        CAPTURE(seed);
        std::vector<double> volumes;
        for (const float scale : {1.0F, 1e-3F, 1e3F}) {
            Random random(seed);
            Solid solid = randomSolid(random);
            const Bounds box = boundsOf(solid.positions, solid.triangles);
            std::vector<glm::dvec3> sites(1 + random.below(12));
            for (glm::dvec3& s : sites) s = double{scale} * randomSite(random, box, false);
            solid.transform([scale](const glm::vec3& p) { return p * scale; });
            CutSolid cut;
            std::string wrong;
            REQUIRE(cutSolid(solid, {voronoiCells(sites, gridOf(solid)).value()}, cut, wrong));
            REQUIRE(brokenClosed(cut) == "");
            const double whole = signedVolume(solid.positions, solid.triangles, glm::dvec3(0));
            std::vector<double> shares;
            for (const PieceMesh& piece : cut.pieces.pieces) shares.push_back(piece.volume / whole);
            if (volumes.empty()) volumes = shares;
            REQUIRE(shares.size() == volumes.size());
            for (size_t p = 0; p < shares.size(); ++p)
                REQUIRE(std::abs(shares[p] - volumes[p]) <= 1e-6);
        }
    }
}
