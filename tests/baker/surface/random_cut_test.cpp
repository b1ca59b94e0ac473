// SPDX-License-Identifier: MIT
// Property: whatever is drawn on whatever closed mesh, the cut surface is the same surface.
#include <doctest/doctest.h>

#include "cutting.h"
#include "geometry/closed_mesh.h"
#include "interior/stitching.h"
#include "support/property.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Lines between points of a grid that the mesh's own vertices lie on, so that they meet vertices,
/// edges and each other all the time; some off the grid.
FractureMap randomMap(Random& random, uint32_t grid) {
    FractureMap map;
    const uint32_t lines = 1 + random.below(12);
    const auto coordinate = [&] {
        if (random.below(4) == 0) return random.in(-0.1, 1.1);
        return random.below(2 * grid + 1) / (2.0 * grid);
    };
    for (uint32_t i = 0; i < lines; ++i) {
        FractureMap::Line line;
        line.level = 1 + random.below(2);
        const uint32_t points = 2 + random.below(5);
        for (uint32_t p = 0; p < points; ++p) line.points.emplace_back(coordinate(), coordinate());
        if (random.below(3) == 0) line.points.push_back(line.points[0]);
        map.lines.push_back(line);
    }
    return map;
}

SurfaceMesh randomMesh(Random& random, uint32_t& grid) {
    grid = 3 + random.below(4);
    switch (random.below(3)) {
        case 0:
            return torus(static_cast<int>(grid), static_cast<int>(grid));
        case 1:
            return chartedCube(1, static_cast<int>(grid));
        default:
            return flatSquare(static_cast<int>(grid));
    }
}

}  // namespace

TEST_CASE("random maps on random meshes: area is kept, closed stays closed, pieces close") {
    for (const uint32_t seed : propertySeeds(1000, 1500)) {
        CAPTURE(seed);
        Random random(seed);
        uint32_t grid = 0;
        const SurfaceMesh mesh = randomMesh(random, grid);
        const CutResult r = cutAndCheck(mesh, randomMap(random, grid), 0.01, 2);
        REQUIRE(r.components.count[0] <= r.components.count[1]);
        const HiddenSheet sheet =
            plainSheet(r.cut.surface, r.cut.topology, r.cut.surface.positions);
        const std::vector<HiddenFace> hidden =
            stitch(r.cut.surface, r.cut.topology, sheet, r.components);
        for (uint32_t level = 1; level <= 2; ++level) {
            const auto triangles =
                levelTopology(r.cut.surface, r.cut.topology, sheet, r.components, hidden, level);
            REQUIRE(proveByIds(triangles).manifold());
        }
    }
}
