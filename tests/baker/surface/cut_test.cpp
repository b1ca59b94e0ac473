// SPDX-License-Identifier: MIT
// Corner cases of cutting drawn lines into a surface, each an ordinary input.
#include <doctest/doctest.h>

#include "cutting.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("a line through the middle of a square separates two components") {
    const CutResult r = cutAndCheck(flatSquare(3), linesOf({{{-0.1, 0.41}, {1.1, 0.47}}}));
    CHECK(r.count() == 2);
    CHECK(r.cut.surface.triangles.size() > 18);
}

TEST_CASE("a line along edges of the mesh adds no triangle and separates") {
    const CutResult r = cutAndCheck(flatSquare(4), linesOf({{{0.5, -0.1}, {0.5, 1.1}}}));
    CHECK(r.count() == 2);
    CHECK(r.cut.surface.triangles.size() == 32);
}

TEST_CASE("a line along diagonals, through vertices only, separates without a new vertex") {
    const CutResult r = cutAndCheck(flatSquare(4), linesOf({{{0, 1}, {1, 0}}}));
    CHECK(r.count() == 2);
    CHECK(r.cut.surface.positions.size() == 25);
}

TEST_CASE("a line through a vertex and the middles of edges splits each of them once") {
    // From a corner of the square through the centre vertex of a 2 x 2 grid, at another slope after
    // it.
    const CutResult r = cutAndCheck(flatSquare(2), linesOf({{{0, 0}, {0.5, 0.5}, {1, 0.75}}}));
    CHECK(r.count() == 2);
}

TEST_CASE("a line that only touches a corner of the surface cuts nothing") {
    const CutResult r = cutAndCheck(flatSquare(2), linesOf({{{-0.5, 0.5}, {0.5, -0.5}}}));
    CHECK(r.count() == 1);
    CHECK(r.cut.surface.triangles.size() == 8);
}

TEST_CASE("three lines through one point make six sectors") {
    const CutResult r = cutAndCheck(
        flatSquare(2), linesOf({{{0, 0.3}, {1, 0.7}}, {{0.3, 0}, {0.7, 1}}, {{0, 0.9}, {1, 0.1}}}));
    CHECK(r.count() == 6);
}

TEST_CASE("three lines through a vertex of the mesh make six sectors") {
    const CutResult r = cutAndCheck(
        flatSquare(2), linesOf({{{0.2, -1}, {0.8, 2}}, {{-1, 0.7}, {2, 0.3}}, {{-1, -1}, {2, 2}}}));
    CHECK(r.count() == 6);
}

TEST_CASE("a loop inside one triangle is a component, its surroundings another") {
    const FractureMap loop =
        linesOf({{{0.6, 0.2}, {0.7, 0.2}, {0.7, 0.3}, {0.6, 0.3}, {0.6, 0.2}}});
    const CutResult r = cutAndCheck(flatSquare(1), loop);
    CHECK(r.count() == 2);
}

TEST_CASE("loops in loops inside one triangle nest") {
    std::vector<std::vector<glm::dvec2>> loops;
    for (double s : {0.05, 0.04, 0.03, 0.02}) {
        loops.push_back({{0.7 - s, 0.2 - s},
                         {0.7 + s, 0.2 - s},
                         {0.7 + s, 0.2 + s},
                         {0.7 - s, 0.2 + s},
                         {0.7 - s, 0.2 - s}});
    }
    CHECK(cutAndCheck(flatSquare(1), linesOf(loops)).count() == 5);
}

TEST_CASE("a concave outline inside one triangle is triangulated within its bounds") {
    const FractureMap star =
        linesOf({{{0.6, 0.1}, {0.9, 0.1}, {0.9, 0.4}, {0.75, 0.2}, {0.62, 0.15}, {0.6, 0.1}}});
    CHECK(cutAndCheck(flatSquare(1), star).count() == 2);
}

TEST_CASE("a line that ends in the surface separates nothing") {
    CHECK(cutAndCheck(flatSquare(3), linesOf({{{-0.1, 0.4}, {0.6, 0.45}}})).count() == 1);
}

TEST_CASE("a line that ends on another separates with it") {
    const CutResult r =
        cutAndCheck(flatSquare(3), linesOf({{{-0.1, 0.5}, {1.1, 0.5}}, {{0.4, 0.5}, {0.45, 1.1}}}));
    CHECK(r.count() == 3);
}

TEST_CASE("the same line drawn twice, and drawn in pieces, cuts once") {
    const CutResult r = cutAndCheck(flatSquare(3), linesOf({{{-0.1, 0.41}, {1.1, 0.41}},
                                                            {{1.1, 0.41}, {-0.1, 0.41}},
                                                            {{0.2, 0.41}, {0.7, 0.41}}}));
    CHECK(r.count() == 2);
}

TEST_CASE("levels nest: a line of level 2 divides what level 1 left whole") {
    FractureMap map = linesOf({{{-0.1, 0.41}, {1.1, 0.43}}});
    map.lines.push_back({{{0.52, -0.1}, {0.57, 1.1}}, 2, "test"});
    const CutResult r = cutAndCheck(flatSquare(3), map, 0.01, 2);
    CHECK(r.components.count == std::vector<uint32_t>{2, 4});
    for (uint32_t a = 0; a < 4; ++a) CHECK(r.components.at(1, a) < 2);
}

TEST_CASE("a triangle whose UV is a line conducts a crossing line from edge to edge") {
    // Two unit squares joined by a strip whose UV has no width.
    MeshMaker maker;
    const auto p = [](float x, float y, float u) { return MeshMaker::Corner{{x, y, 0}, {u, y}}; };
    maker.quad(p(0, 0, 0), p(1, 0, 0.5F), p(1, 1, 0.5F), p(0, 1, 0));
    maker.quad(p(1, 0, 0.5F), p(2, 0, 0.5F), p(2, 1, 0.5F), p(1, 1, 0.5F));
    maker.quad(p(2, 0, 0.5F), p(3, 0, 1), p(3, 1, 1), p(2, 1, 0.5F));
    const CutResult r = cutAndCheck(maker.mesh(), linesOf({{{-0.1, 0.3}, {1.1, 0.7}}}));
    CHECK(r.count() == 2);
}

TEST_CASE("a line through the UV point of a collapsed edge marks that edge") {
    MeshMaker maker;
    const auto p = [](float x, float y, float u, float v) {
        return MeshMaker::Corner{{x, y, 0}, {u, v}};
    };
    // The middle strip is collapsed along u; its edges x = 1 and x = 2 at y = 0.5 meet a vertex.
    const auto strip = [&](float x0, float x1, float u0, float u1) {
        maker.quad(p(x0, 0, u0, 0), p(x1, 0, u1, 0), p(x1, 0.5F, u1, 0.5F), p(x0, 0.5F, u0, 0.5F));
        maker.quad(p(x0, 0.5F, u0, 0.5F), p(x1, 0.5F, u1, 0.5F), p(x1, 1, u1, 1), p(x0, 1, u0, 1));
    };
    strip(0, 1, 0, 0.5F);
    strip(1, 2, 0.5F, 0.5F);
    strip(2, 3, 0.5F, 1);
    CHECK(cutAndCheck(maker.mesh(), linesOf({{{-0.1, 0.5}, {1.1, 0.5}}})).count() == 2);
}

TEST_CASE("triangles collapsed to a point in UV neither crash nor leak") {
    MeshMaker maker;
    const MeshMaker::Corner a{{0, 0, 0}, {0.5F, 0.5F}};
    maker.triangle(a, {{1, 0, 0}, {0.5F, 0.5F}}, {{0, 1, 0}, {0.5F, 0.5F}});
    CHECK(cutAndCheck(maker.mesh(), linesOf({{{0, 0}, {1, 1}}})).count() == 1);
}

TEST_CASE("a ring around a cube of six charts meets itself over every seam") {
    // Around +x, +y, -x, -y at height z = 0.4; the ends stick out a hair beyond each chart.
    std::vector<std::vector<glm::dvec2>> ring;
    for (int face : {0, 1}) ring.push_back({cubeUv(face, -0.01, 0.4), cubeUv(face, 1.01, 0.4)});
    for (int face : {2, 3}) ring.push_back({cubeUv(face, 0.4, -0.01), cubeUv(face, 0.4, 1.01)});
    const CutResult r = cutAndCheck(chartedCube(), linesOf(ring));
    CHECK(r.count() == 2);
    CHECK(r.cut.seams.loose.empty());
}

TEST_CASE(
    "line ends that miss each other at a seam are joined within the distance and reported beyond") {
    std::vector<std::vector<glm::dvec2>> ring;
    ring.push_back({cubeUv(0, -0.01, 0.405), cubeUv(0, 1.01, 0.404)});
    ring.push_back({cubeUv(1, -0.01, 0.4), cubeUv(1, 1.01, 0.4)});
    for (int face : {2, 3}) ring.push_back({cubeUv(face, 0.4, -0.01), cubeUv(face, 0.4, 1.01)});
    SUBCASE("joined") {
        const CutResult r = cutAndCheck(chartedCube(), linesOf(ring), 0.01);
        CHECK(r.count() == 2);
        CHECK(r.cut.seams.joined == 2);
        CHECK(r.cut.seams.loose.empty());
    }
    SUBCASE("averaged in order, as the thesis does") {
        const SurfaceMesh cube = chartedCube();
        const MeshTopology topology = buildTopology(cube.positions, cube.triangles);
        const Result<CutSurface> cut =
            cutSurface(cube, topology, planOf(linesOf(ring)), cutOptions(0, true));
        REQUIRE(cut.has_value());
        CHECK(floodFill(cut->surface, cut->topology, cut->lines, 1).count[0] == 2);
        CHECK(cut->seams.joined == 0);
        CHECK(cut->seams.loose.empty());
        CHECK(isFaithfulSplit(cube, topology, *cut, 1e-6));
    }
    SUBCASE("too far apart") {
        const CutResult r = cutAndCheck(chartedCube(), linesOf(ring), 0.001);
        CHECK(r.count() == 1);
        CHECK(r.cut.seams.loose.size() == 4);
    }
}

TEST_CASE("the thesis' averaging leaves edges that are no seams, and far pairs, alone") {
    const SurfaceMesh square = flatSquare(1);
    const MeshTopology topology = buildTopology(square.positions, square.triangles);
    // Two lines end on the diagonal from its two sides, 0.4 % of its length apart.
    const FractureMap lines = linesOf({{{0.2, 1.1}, {0.5, 0.5}}, {{0.502, 0.498}, {0.8, -0.1}}});
    const Result<CutSurface> cut = cutSurface(square, topology, planOf(lines), cutOptions(0, true));
    REQUIRE(cut.has_value());
    CHECK(cut->seams.averaged == 0);
    CHECK(floodFill(cut->surface, cut->topology, cut->lines, 1).count[0] == 1);

    std::vector<std::vector<glm::dvec2>> ring;
    ring.push_back({cubeUv(0, -0.01, 0.43), cubeUv(0, 1.01, 0.404)});
    ring.push_back({cubeUv(1, -0.01, 0.4), cubeUv(1, 1.01, 0.4)});
    for (int face : {2, 3}) ring.push_back({cubeUv(face, 0.4, -0.01), cubeUv(face, 0.4, 1.01)});
    const SurfaceMesh cube = chartedCube();
    const MeshTopology cubeTopology = buildTopology(cube.positions, cube.triangles);
    const Result<CutSurface> far =
        cutSurface(cube, cubeTopology, planOf(linesOf(ring)), cutOptions(0, true));
    REQUIRE(far.has_value());
    CHECK(far->seams.averaged == 1);  // 0.4 % apart at one seam, 3 % at the other
    CHECK(far->seams.loose.size() == 2);
}

TEST_CASE("a line that ends in the surface is reported with its place") {
    const CutResult r = cutAndCheck(flatSquare(3), linesOf({{{-0.1, 0.4}, {0.6, 0.45}}}));
    REQUIRE(r.cut.deadEnds.size() == 1);
    CHECK(r.cut.deadEnds[0].uv->x == doctest::Approx(0.6));
    CHECK(r.cut.deadEnds[0].position->x == doctest::Approx(0.6));
}

TEST_CASE("a line that ends exactly on an edge of the mesh is reported as well") {
    // On the upright edges of the grid, at u = 1/2.
    const CutResult r = cutAndCheck(flatSquare(2), linesOf({{{-0.1, 0.3}, {0.5, 0.3}}}));
    REQUIRE(r.cut.deadEnds.size() == 1);
    CHECK(r.cut.deadEnds[0].uv->x == doctest::Approx(0.5));
}

TEST_CASE("line ends on both sides of a corner of a chart are joined around it") {
    // On one face the line leaves just before the corner, on the next it starts just after it, so
    // the stretch between lies on two seams.
    std::vector<std::vector<glm::dvec2>> lines;
    lines.push_back({cubeUv(0, -0.01, 0.004), cubeUv(0, 1.01, 0.004)});  // +x, near z = 0
    lines.push_back({cubeUv(1, -0.01, 0.004), cubeUv(1, 1.01, 0.004)});  // -x
    for (int face : {2, 3})
        lines.push_back({cubeUv(face, 0.004, -0.01), cubeUv(face, 0.004, 1.01)});
    CHECK(cutAndCheck(chartedCube(), linesOf(lines), 0.02).count() == 2);
}

TEST_CASE("a map shifted by a power of two tiles with the mesh's UV cuts the same") {
    const FractureMap map = linesOf({{{-0.1, 0.41}, {1.1, 0.47}}, {{0.31, -0.1}, {0.36, 1.1}}});
    const CutResult here = cutAndCheck(flatSquare(3), map);
    SurfaceMesh mesh = flatSquare(3);
    for (Attribute& a : mesh.attributes) {
        if (a.semantic == "TEXCOORD_0") {
            for (float& x : a.values) x += 4;
        }
    }
    FractureMap shifted = map;
    for (auto& line : shifted.lines) {
        for (auto& p : line.points) p += 4.0;
    }
    const CutResult there = cutAndCheck(mesh, shifted);
    CHECK(there.count() == here.count());
}

TEST_CASE("a texture coordinate beyond eight tiles is refused with its place") {
    SurfaceMesh mesh = flatSquare(1);
    mesh.attributes[1].values[0] = 9;
    const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
    const Result<CutSurface> cut =
        cutSurface(mesh, topology, planOf(linesOf({{{0, 0}, {1, 1}}})), {});
    REQUIRE_FALSE(cut.has_value());
    CHECK(cut.error().code == ErrorCode::limitExceeded);
    CHECK(cut.error().where.find("9.0") != std::string::npos);
}
