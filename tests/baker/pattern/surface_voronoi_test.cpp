// SPDX-License-Identifier: MIT
// Voronoi and wood, through the same door as the baker.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "geometry/triangle.h"
#include "pattern/power_cells.h"
#include "pattern/site_sampling.h"
#include "pattern/surface_voronoi.h"
#include "shapes.h"
#include "sherd/baker/bake.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

struct Shape {
    const char* name;
    SurfaceMesh mesh;
    uint32_t groups;
};

std::vector<Shape> shapes() {
    const SurfaceMesh cube = chartedCube(1, 2);
    return {{"cube of 12 triangles", chartedCube(), 1},
            {"ball", ball(8, 12), 1},
            {"torus", torus(16, 8), 1},
            {"frame with two holes", genusTwo(), 1},
            {"thin plate", thinPlate(), 1},
            {"two touching cubes", together({cube, moved(cube, {1, 0.25F, 0.25F})}), 1},
            {"two separate cubes", together({cube, moved(cube, {3, 0, 0})}), 2},
            {"cube in a cube", together({cube, moved(cube, glm::vec3(0.25F), 0.5F)}), 1},
            {"open sheet", flatSquare(6), 1},
            {"pinched cubes", voxels(2, 2, 1, [](int x, int y, int) { return x == y; }), 1}};
}

glm::dvec3 middleOf(const SplitSurface& surface, uint32_t t) {
    const auto& v = surface.triangles[t].v;
    return (glm::dvec3(surface.positions[v[0]]) + glm::dvec3(surface.positions[v[1]]) +
            glm::dvec3(surface.positions[v[2]])) /
           3.0;
}

std::vector<std::array<uint32_t, 3>> combinatorics(const Grown& grown) {
    std::vector<std::array<uint32_t, 3>> result = vertexTriangles(grown.cut.surface);
    for (size_t t = 0; t < grown.components.leaf.size(); ++t) {
        result.push_back({grown.components.leaf[t], 0, 0});
        result.push_back(grown.cut.surface.triangles[t].line);
    }
    return result;
}

}  // namespace

TEST_CASE("Voronoi makes exactly the pieces asked on every shape, and one per group at least") {
    for (const Shape& shape : shapes()) {
        for (const uint32_t count : {1U, 2U, 5U, 12U, 50U}) {
            for (const char* seed : {":1", ":7"}) {
                const std::string text = "voronoi:" + std::to_string(count) + seed;
                CAPTURE(shape.name);
                CAPTURE(text);
                const Grown grown = grow(shape.mesh, text);
                CHECK(grown.cut.groups.groups == shape.groups);
                CHECK(grown.count() == std::max(count, shape.groups));
                REQUIRE(grown.reports.size() == 1);
                CHECK(grown.reports[0].asked == count);
                CHECK(grown.reports[0].made == grown.count());
                CHECK(grown.reports[0].domains == shape.groups);
            }
        }
    }
}

TEST_CASE("one piece of one object is refused, one for two objects is reported") {
    const Result<BakedObject> one = bakeObject(chartedCube(1, 2), patterns({"voronoi:1"}), {}, 0);
    REQUIRE_FALSE(one.has_value());
    CHECK(one.error().code == ErrorCode::separatesNothing);
    CHECK(one.error().message.find("ask for more") != std::string::npos);
    const SurfaceMesh cube = chartedCube(1, 2);
    const SurfaceMesh two = together({cube, moved(cube, {3, 0, 0})});
    const Result<BakedObject> each = bakeObject(two, patterns({"voronoi:1"}), {}, 0);
    if (!each) FAIL(each.error().message);
    CHECK(each->report.levels[1].fragments == 2);
    const auto& findings = each->report.findings;
    CHECK(std::any_of(findings.begin(), findings.end(), [](const BakeFinding& f) {
        return f.code == "pattern" && f.message.find("do not touch") != std::string::npos;
    }));
}

TEST_CASE("pieces are the nearest sites' by brute force, where no stray was merged") {
    int judged = 0;
    for (const Shape& shape : shapes()) {
        if (shape.groups > 1) continue;
        CAPTURE(shape.name);
        const Grown grown = grow(shape.mesh, "voronoi:12:5");
        if (grown.strays() > 0) continue;
        const SplitSurface uncut = uncutSurface(shape.mesh);
        std::vector<uint32_t> all(uncut.triangles.size());
        for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
        const SiteGrid grid(uncut.positions, glm::dvec3(0.0), 1);
        const std::vector<SitePoint> sites = sampleSites(uncut, all, 12, grid, {5, 0.5, {}});
        REQUIRE(sites.size() == 12);
        std::map<uint32_t, uint32_t> pieceOfSite;
        for (uint32_t t = 0; t < grown.cut.surface.triangles.size(); ++t) {
            const SitePoint p = grid.snap(middleOf(grown.cut.surface, t));
            std::vector<std::pair<int64_t, uint32_t>> order;
            for (uint32_t s = 0; s < sites.size(); ++s)
                order.emplace_back(squaredDistance(sites[s], p), s);
            std::sort(order.begin(), order.end());
            // Right at a border rounding decides.
            if (order[1].first - order[0].first < 1e-5 * static_cast<double>(order[1].first))
                continue;
            ++judged;
            const auto [it, isNew] =
                pieceOfSite.try_emplace(order[0].second, grown.components.leaf[t]);
            REQUIRE(it->second == grown.components.leaf[t]);
        }
        CHECK(pieceOfSite.size() == 12);
        std::set<uint32_t> pieces;
        for (const auto& [site, piece] : pieceOfSite) pieces.insert(piece);
        CHECK(pieces.size() == 12);
    }
    CHECK(judged > 1000);
}

TEST_CASE("sites on vertices, in rows and all equally far still give exact cells") {
    // The sites of the whole lattice, borders through vertices and along edges and diagonals.
    const SurfaceMesh mesh = chartedCube(4, 4);
    const SplitSurface uncut = uncutSurface(mesh);
    const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
    std::vector<uint32_t> all(uncut.triangles.size());
    for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
    const SiteGrid grid(uncut.positions, glm::dvec3(0.0), 1);
    for (const double step : {1.0, 2.0, 4.0}) {
        std::vector<SitePoint> sites;
        for (double x = 0; x <= 4; x += step)
            for (double y = 0; y <= 4; y += step)
                for (double z = 0; z <= 4; z += step) sites.push_back(grid.snap({x, y, z}));
        const SiteTree tree(sites);
        const std::vector<Chord> chords = voronoiBorders(uncut, all, grid, tree, 1);
        const Result<ChordCuts> cuts = cutsOfChords(chords);
        REQUIRE(cuts.has_value());
        // Every chord end on an edge is met from the other side of the edge.
        std::map<std::pair<uint32_t, int64_t>, int> ends;
        for (const Cut& cut : cuts->cuts) {
            for (const CutEnd& end : {cut.from, cut.to}) {
                if (end.where != CutEnd::Where::edge) continue;
                const uint32_t h = 3 * cut.triangle + end.k;
                const auto& v = uncut.triangles[cut.triangle].v;
                const bool up = v[end.k] < v[(end.k + 1) % 3];
                const int64_t steps = std::llround(end.t.approximate() * kGridOne);
                ends[{topology.halfEdgeEdge[h], up ? steps : kGridOne - steps}] +=
                    h < topology.opposite[h] ? 1 : -1;
            }
        }
        for (const auto& [place, balance] : ends) REQUIRE(balance == 0);
    }
}

TEST_CASE("borders within large triangles are those that every pair of sites makes") {
    // Sites that no border can reach are passed over: none too many.
    const int cases = propertyCases(30);
    for (int i = 0; i < cases; ++i) {
        const auto seed = static_cast<uint32_t>(70 + i);
        CAPTURE(seed);
        const SurfaceMesh mesh = i % 3 == 0 ? thinPlate() : i % 3 == 1 ? chartedCube() : ball(3, 4);
        const SplitSurface uncut = uncutSurface(mesh);
        std::vector<uint32_t> all(uncut.triangles.size());
        for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
        const SiteGrid grid(uncut.positions, glm::dvec3(0.0), 1);
        const std::vector<SitePoint> sites = sampleSites(uncut, all, 150, grid, {seed, 1, {}});
        const SiteTree tree(sites);
        std::vector<size_t> found(all.size(), 0), expected(all.size(), 0);
        for (const Chord& chord : voronoiBorders(uncut, all, grid, tree, 1))
            ++found[chord.triangle];
        for (const uint32_t t : all) {
            std::vector<CornerValues> values;
            for (const SitePoint& s : sites) {
                CornerValues& value = values.emplace_back();
                for (size_t k = 0; k < 3; ++k)
                    value[k] =
                        squaredDistance(grid.snap(uncut.positions[uncut.triangles[t].v[k]]), s);
            }
            for (uint32_t s = 0; s < sites.size(); ++s) {
                PowerCell cell(s);
                for (uint32_t o = 0; o < sites.size() && !cell.empty(); ++o)
                    if (o != s) cell.clip(values, o);
                for (const CellSide& side : cell.sides())
                    if (!side.edge && side.index > s) ++expected[t];
            }
        }
        REQUIRE(found == expected);
    }
}

TEST_CASE("ten thousand sites in twelve triangles are all found a cell") {
    const SurfaceMesh mesh = chartedCube();
    const SplitSurface uncut = uncutSurface(mesh);
    std::vector<uint32_t> all(uncut.triangles.size());
    for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
    const SiteGrid grid(uncut.positions, glm::dvec3(0.0), 1);
    const SiteTree tree(sampleSites(uncut, all, 10'000, grid, {1, 1, {}}));
    CHECK(voronoiBorders(uncut, all, grid, tree, 1).size() > 10'000);
}

TEST_CASE("a pattern on the level of a modelled line divides what the line leaves") {
    SurfaceMesh mesh = chartedCube(1, 2);
    FractureMap::SurfaceLine ring;
    ring.source = "ring";
    for (const glm::dvec3 p : {glm::dvec3(0, 0, 0.3), glm::dvec3(1, 0, 0.3), glm::dvec3(1, 1, 0.3),
                               glm::dvec3(0, 1, 0.3), glm::dvec3(0, 0, 0.3)})
        ring.places.push_back({true, p});
    mesh.lines.push_back(ring);
    const Grown grown = grow(mesh, "voronoi:9");
    CHECK(grown.count(1) == 2);
    CHECK(grown.count(2) == 9);
}

TEST_CASE("the same seed gives the same pieces, another seed others") {
    const SurfaceMesh mesh = ball(8, 12);
    const Grown a = grow(mesh, "voronoi:12:3");
    const Grown b = grow(mesh, "voronoi:12:3");
    const Grown c = grow(mesh, "voronoi:12:4");
    CHECK(combinatorics(a) == combinatorics(b));
    CHECK(a.cut.surface.positions == b.cut.surface.positions);
    CHECK(a.cut.surface.positions != c.cut.surface.positions);
}

TEST_CASE("scaling by powers of two keeps every triangle, scaling by millions every count") {
    for (const std::string text : {"voronoi:12:3", "wood:9:2:axis=x", "voronoi:20:1:jitter=0"}) {
        CAPTURE(text);
        const Grown one = grow(torus(12, 8), text);
        for (const float scale : {0x1p-20F, 0.5F, 1024.0F}) {
            const Grown scaled = grow(moved(torus(12, 8), glm::vec3(0.0F), scale), text);
            CHECK(combinatorics(one) == combinatorics(scaled));
        }
        for (const float scale : {1e-6F, 1e6F}) {
            const Grown scaled = grow(moved(torus(12, 8), glm::vec3(0.0F), scale), text);
            CHECK(scaled.count() == one.count());
        }
    }
}

TEST_CASE("levels of patterns nest, each with exactly the pieces asked") {
    for (const auto& mesh : {chartedCube(1, 2), torus(16, 8), genusTwo()}) {
        const Grown grown = grow(mesh, patterns({"voronoi:4:3", "voronoi:13:2", "voronoi:40:9"}));
        CHECK(grown.count(1) == 4);
        CHECK(grown.count(2) == 13);
        CHECK(grown.count(3) == 40);
    }
    const Grown same = grow(chartedCube(1, 2), patterns({"voronoi:6", "voronoi:6:2"}));
    CHECK(same.count(2) == 6);  // one cell each: the bake refuses it
    const Grown wood = grow(chartedCube(1, 2), patterns({"voronoi:3", "wood:12"}));
    CHECK(wood.count(2) == 12);
}

TEST_CASE("many seeds on coarse and thin shapes: counts hold, strays or not") {
    const int cases = propertyCases(120);
    const std::vector<Shape> all = shapes();
    for (int i = 0; i < cases; ++i) {
        const auto seed = static_cast<uint32_t>(50 + i);
        CAPTURE(seed);
        Random random(seed);
        const Shape& shape = all[random.below(static_cast<uint32_t>(all.size()))];
        CAPTURE(shape.name);
        const uint32_t count = 2 + random.below(60);
        std::string text = random.below(4) == 0 ? "wood:" : "voronoi:";
        text += std::to_string(count) + ":" + std::to_string(seed) +
                ":jitter=" + std::to_string(0.5 * random.below(3));
        CAPTURE(text);
        CHECK(grow(shape.mesh, text).count() == count);
    }
}

TEST_CASE("crowds gather around their places") {
    const SurfaceMesh mesh = chartedCube(1, 6);
    const Grown grown = grow(mesh, "voronoi:40:1:around=1,1,1:spread=0.1");
    CHECK(grown.count() == 40);
    std::set<uint32_t> near;
    for (uint32_t t = 0; t < grown.cut.surface.triangles.size(); ++t)
        if (glm::distance(middleOf(grown.cut.surface, t), glm::dvec3(1.0)) < 0.5)
            near.insert(grown.components.leaf[t]);
    CHECK(near.size() > 20);
    // Far from the surface nobody is drawn anywhere: an even pattern.
    CHECK(grow(mesh, "voronoi:10:1:around=1e6,0,0:spread=0.001").count() == 10);
}

TEST_CASE("splinters of wood are longer along the grain than across") {
    const SurfaceMesh mesh = chartedCube(1, 4);
    const Grown grown = grow(mesh, "wood:20:3:axis=y:elongation=8");
    CHECK(grown.count() == 20);
    std::vector<glm::dvec3> low(20, glm::dvec3(9)), high(20, glm::dvec3(-9));
    for (uint32_t t = 0; t < grown.cut.surface.triangles.size(); ++t) {
        const uint32_t piece = grown.components.leaf[t];
        for (const uint32_t v : grown.cut.surface.triangles[t].v) {
            low[piece] = glm::min(low[piece], glm::dvec3(grown.cut.surface.positions[v]));
            high[piece] = glm::max(high[piece], glm::dvec3(grown.cut.surface.positions[v]));
        }
    }
    double along = 0, across = 0;
    for (size_t i = 0; i < 20; ++i) {
        along += high[i].y - low[i].y;
        across += 0.5 * (high[i].x - low[i].x + high[i].z - low[i].z);
    }
    CHECK(along > 1.8 * across);
}

TEST_CASE("parts group by touching, overlap and containment, near misses stay apart") {
    const SurfaceMesh cube = chartedCube();
    const auto groups = [&](const SurfaceMesh& other) {
        const SurfaceMesh mesh = together({cube, other});
        return groupParts(mesh, buildTopology(mesh.positions, mesh.triangles)).groups;
    };
    CHECK(groups(moved(cube, {1, 0, 0})) == 1);               // face to face
    CHECK(groups(moved(cube, {1, 1, 1})) == 1);               // corner to corner
    CHECK(groups(moved(cube, {0.5F, 0.5F, 0.5F})) == 1);      // overlapping
    CHECK(groups(moved(cube, glm::vec3(0.25F), 0.5F)) == 1);  // inside
    CHECK(groups(moved(cube, glm::vec3(-1), 3)) == 1);        // around
    CHECK(groups(moved(cube, {std::nextafter(1.0F, 2.0F), 0, 0})) == 2);
    CHECK(groups(moved(cube, {std::nextafter(1.0F, 2.0F), 1, 1})) == 2);
    // Within the box of a frame, but in its hole.
    const SurfaceMesh frame = genusTwo();
    const SurfaceMesh both = together({frame, moved(cube, {1.25F, 1.25F, 0.25F}, 0.5F)});
    CHECK(groupParts(both, buildTopology(both.positions, both.triangles)).groups == 2);
}

TEST_CASE("empty, tiny and degenerate meshes grow nothing and crash nothing") {
    for (const std::string text : {"voronoi:5", "wood:5", "grid:2x2", "grid:2x2:on=box",
                                   "grid:2x2:on=cylindrical", "radial:4x3", "grid:3x2:brick"}) {
        CAPTURE(text);
        SurfaceMesh none;
        none.attributes = {{"NORMAL", 3, {}}};
        const MeshTopology noTopology = buildTopology(none.positions, none.triangles);
        const auto empty = cutSurface(none, noTopology, patterns({text}), {});
        std::vector<CellReport> reports;
        if (empty) CHECK(componentsOf(*empty, reports).leafCount == 0);

        MeshMaker one;
        one.triangle({{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{0, 1, 0}, {0, 1}});
        CHECK(grow(one.mesh(), text).count() >= 1);

        MeshMaker needles;
        needles.triangle({{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{2, 0, 0}, {0, 1}});
        needles.triangle({{0, 0, 0}, {0, 0}}, {{2, 0, 0}, {1, 0}}, {{1, 1e-7F, 0}, {0, 1}});
        needles.triangle({{0, 0, 0}, {0, 0}}, {{0, 0, 0}, {1, 0}}, {{1, 0, 0}, {0, 1}});
        CHECK(grow(needles.mesh(), text).count() >= 1);

        MeshMaker same;
        same.triangle({{1, 1, 1}, {0, 0}}, {{1, 1, 1}, {1, 0}}, {{1, 1, 1}, {0, 1}});
        CHECK(grow(same.mesh(), text).count() <= 1);
    }
    CHECK(grow(chartedCube(), "voronoi:2").count() == 2);
}

TEST_CASE("an unused vertex far away changes no pattern") {
    SurfaceMesh mesh = chartedCube(1, 2);
    mesh.positions.emplace_back(1e6F, 0, 0);
    CHECK(grow(mesh, "voronoi:50").count() == 50);
    CHECK(grow(mesh, "radial:6x3").count() == grow(chartedCube(1, 2), "radial:6x3").count());
    CHECK(grow(mesh, "grid:3x3").count() == 9);
}

TEST_CASE("options that are no numbers or out of range crash nothing") {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e300, 0.0}) {
        for (const std::string text :
             {"voronoi:5:around=0,0,0", "wood:5", "grid:2x2", "radial:4x3"}) {
            CAPTURE(bad);
            CAPTURE(text);
            FracturePlan plan = patterns({text});
            Pattern& p = plan.patterns[0].pattern;
            p.jitter = bad;
            p.elongation = bad;
            p.spread = bad;
            p.axis = p.projection.axis = glm::dvec3(bad, 0, 0);
            p.around = {glm::dvec3(bad)};
            p.centre = glm::dvec3(bad);
            const SurfaceMesh mesh = chartedCube(1, 2);
            const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
            const auto cut = cutSurface(mesh, topology, plan, {});
            if (!cut) {
                CHECK_FALSE(cut.error().message.empty());
                continue;
            }
            std::vector<CellReport> reports;
            CHECK(componentsOf(*cut, reports).leafCount >= 1);
        }
    }
}
