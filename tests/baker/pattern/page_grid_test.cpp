// SPDX-License-Identifier: MIT
// Grids, bricks and broken glass, and how a page lies on an object.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "shapes.h"
#include "support/plans.h"
#include "support/property.h"
#include "surface/page_frames.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FracturePlan drawing(const std::vector<std::vector<glm::dvec2>>& polylines,
                     const std::string& projection) {
    FracturePlan plan;
    FractureMap map;
    for (const auto& points : polylines) map.lines.push_back({points, 1, "test", {}});
    plan.drawings.push_back({map, *parseProjection(projection)});
    return plan;
}

/// The summed area of each component's triangles.
std::vector<double> areas(const Grown& grown) {
    std::vector<double> result(grown.count(), 0);
    for (uint32_t t = 0; t < grown.components.leaf.size(); ++t) {
        const auto& v = grown.cut.surface.triangles[t].v;
        const glm::dvec3 a = grown.cut.surface.positions[v[0]];
        const glm::dvec3 b = grown.cut.surface.positions[v[1]];
        const glm::dvec3 c = grown.cut.surface.positions[v[2]];
        result[grown.components.leaf[t]] += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return result;
}

}  // namespace

TEST_CASE("a planar grid cuts a slab into columns times rows, through front and back") {
    const SurfaceMesh slab = voxels(4, 3, 1, [](int, int, int) { return true; });
    for (const std::string text : {"grid:4x3", "grid:4x3:on=planar/z", "grid:4x3:on=planar/-z",
                                   "grid:4x3:7:jitter=1", "grid:4x3:on=planar"}) {
        CAPTURE(text);
        CHECK(grow(slab, text).count() == 12);
        CHECK(grow(thinPlate(), text).count() == 12);
    }
    CHECK(grow(slab, "grid:3x4:on=planar/x").count() == 12);
    CHECK(grow(slab, "grid:1x2").count() == 2);
    CHECK(grow(slab, "grid:1x1").count() == 1);
    CHECK(grow(chartedCube(1, 3), "grid:3x3:on=planar/1,1,1").count() == 9);
}

TEST_CASE("bricks: shifted rows have a brick more") {
    const SurfaceMesh slab = voxels(4, 3, 1, [](int, int, int) { return true; });
    const Grown grown = grow(slab, "grid:4x3:brick");
    CHECK(grown.count() == 4 + 5 + 4);
    CHECK(grown.reports[0].asked == 13);
    CHECK(grow(slab, "grid:1x2:brick").count() == 3);
    CHECK(grow(slab, "grid:4x3:1:brick:jitter=1").count() == 13);
}

TEST_CASE("a grid on a box has its columns and rows on every side") {
    const Grown grown = grow(chartedCube(1, 2), "grid:3x2:on=box");
    CHECK(grown.count() == 36);
    CHECK(grown.strays() == 0);
    for (const double area : areas(grown)) CHECK(area == doctest::Approx(1.0 / 6).epsilon(1e-5));
    CHECK(grow(chartedCube(), "grid:1x1:on=box").count() == 6);
    CHECK(grow(chartedCube(1, 2), "grid:3x2:brick:on=box").count() == 6 * 7);
}

TEST_CASE("a grid in UV ends at chart borders") {
    // Six charts of 0.2, the page from 0 to 1: lines at a third cut none of the six but at 0.333
    // and 0.667, where charts begin at 0.25 and 0.5.
    const Grown grown = grow(chartedCube(), "grid:10x10:on=uv");
    CHECK(grown.count() == 6 * 2 * 2 + 2 * 2);  // the middle charts have 3 columns
    const Grown whole = grow(chartedCube(), "grid:1x1:on=uv");
    CHECK(whole.count() == 6);
}

TEST_CASE("a grid around an axis has its columns all around") {
    const Grown grown = grow(tube(24, 4), "grid:6x1:on=cylindrical/y");
    CHECK(grown.count() >= 6);
    const Grown ballGrid = grow(ball(8, 24), "grid:4x2:on=cylindrical/y");
    CHECK(ballGrid.count() >= 8);
}

TEST_CASE("broken glass has sectors times rings") {
    const SurfaceMesh disc = voxels(
        16, 16, 1,
        [](int x, int y, int) {
            return (2 * x - 15) * (2 * x - 15) + (2 * y - 15) * (2 * y - 15) < 256;
        },
        glm::vec3(0.1F, 0.1F, 0.05F));
    for (const std::string text : {"radial:6x3", "radial:6x3:9:jitter=1", "radial:6x3:2:jitter=0",
                                   "radial:6x3:1:axis=z", "radial:6x3:1:axis=-z"}) {
        CAPTURE(text);
        CHECK(grow(disc, text).count() == 18);
    }
    CHECK(grow(disc, "radial:1x4").count() == 4);
    CHECK(grow(disc, "radial:5x1").count() == 5);
    CHECK(grow(disc, "radial:2x1").count() == 2);
    CHECK(grow(disc, "radial:1x1").count() == 1);
    // Struck near a corner: cells that miss the object are missed, and said to be.
    const Grown corner = grow(disc, "radial:8x3:1:at=0.4,0.4,0");
    CHECK(corner.count() > 8);
    CHECK(corner.count() <= 24);
}

TEST_CASE("glass struck far beside the object is still a bake, or refused with the reason") {
    for (const std::string text :
         {"radial:6x3:1:at=30,0,0", "radial:6x3:1:at=1e6,0,0", "radial:6x3:1:at=1e300,1e300,1e300",
          "radial:6x3:1:at=0,0,1e6"}) {
        CAPTURE(text);
        const SurfaceMesh mesh = chartedCube(1, 2);
        const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
        const auto cut = cutSurface(mesh, topology, patterns({text}), {});
        if (cut) {
            CHECK(isFaithfulSplit(mesh, topology, *cut, 1e-6));
            continue;
        }
        CHECK(cut.error().code == ErrorCode::badArgument);
        CHECK(cut.error().message.find("radial") != std::string::npos);
    }
    // How far in front of the object does not matter.
    CHECK(grow(thinPlate(), "radial:6x3:1:at=2,1.5,1000:axis=z").count() == 18);
}

TEST_CASE("a planar drawing cuts front and back alike, wherever it lies") {
    for (const std::string projection : {"planar:z", "planar:-z", "planar:x", "planar:y"}) {
        CAPTURE(projection);
        const Grown grown =
            grow(chartedCube(1, 2), drawing({{{0.3, -0.1}, {0.3, 1.1}}}, projection));
        CHECK(grown.count() == 2);
        std::vector<double> area = areas(grown);
        std::sort(area.begin(), area.end());
        CHECK(area[0] == doctest::Approx(1 + 4 * 0.3).epsilon(1e-5));
    }
    // A closed line in the middle is a plug's two caps: the sides are untouched.
    const Grown plug =
        grow(chartedCube(1, 2),
             drawing({{{0.3, 0.3}, {0.7, 0.3}, {0.7, 0.7}, {0.3, 0.7}, {0.3, 0.3}}}, "planar:z"));
    CHECK(plug.count() == 3);
}

TEST_CASE("a cylindrical drawing joins over the page's edge without a seam") {
    // A ring around a tube cuts the outer and the inner wall.
    const Grown ring = grow(tube(12, 3), drawing({{{-0.1, 0.45}, {1.1, 0.45}}}, "cylindrical:y"));
    CHECK(ring.count() == 2);
    CHECK(ring.cut.deadEnds.empty());
    CHECK(ring.cut.seams.loose.empty());
    // A slanted line that leaves the page on one side and returns on the other at the same height.
    const Grown wave = grow(
        tube(12, 3), drawing({{{0, 0.4}, {0.25, 0.6}, {0.75, 0.3}, {1, 0.4}}}, "cylindrical:y"));
    CHECK(wave.count() == 2);
    // A closed line over the edge of the page, drawn past it.
    const Grown spot = grow(
        tube(12, 3), drawing({{{0.95, 0.4}, {1.05, 0.4}, {1.05, 0.6}, {0.95, 0.6}, {0.95, 0.4}}},
                             "cylindrical:y"));
    CHECK(spot.count() == 3);  // the outer wall's patch, the inner one's, the rest
    for (const char* axis : {"cylindrical", "cylindrical:-y", "cylindrical:x", "cylindrical:1,2,3"})
        CHECK(grow(tube(12, 3), drawing({{{-0.1, 0.45}, {1.1, 0.45}}}, axis)).count() >= 2);
}

TEST_CASE("a drawing on a box lies on each of its sides") {
    const Grown spots =
        grow(chartedCube(1, 2),
             drawing({{{0.3, 0.3}, {0.7, 0.3}, {0.7, 0.7}, {0.3, 0.7}, {0.3, 0.3}}}, "box"));
    CHECK(spots.count() == 7);
    // Middle lines of four sides meet at the edges.
    const Grown rings = grow(chartedCube(1, 2), drawing({{{-0.1, 0.5}, {1.1, 0.5}}}, "box"));
    CHECK(rings.count() >= 2);
}

TEST_CASE("random drawings on every projection keep the surface") {
    const int cases = propertyCases(80);
    const std::vector<SurfaceMesh> meshes{chartedCube(1, 2), tube(9, 2), ball(6, 8), genusTwo()};
    for (int i = 0; i < cases; ++i) {
        const auto seed = static_cast<uint32_t>(600 + i);
        CAPTURE(seed);
        Random random(seed);
        std::vector<std::vector<glm::dvec2>> lines;
        for (uint32_t l = 1 + random.below(5); l > 0; --l) {
            auto& line = lines.emplace_back();
            for (uint32_t n = 2 + random.below(4); n > 0; --n) {
                const auto c = [&] {
                    return random.below(2) == 0 ? random.below(9) / 8.0 : random.in(-0.2, 1.2);
                };
                line.emplace_back(c(), c());
            }
            if (random.below(2) == 0) line.push_back(line[0]);
        }
        const char* const kinds[] = {"planar", "planar:1,1,0", "cylindrical", "cylindrical:x",
                                     "box"};
        CHECK(grow(meshes[random.below(4)], drawing(lines, kinds[random.below(5)])).count() >= 1);
    }
}
