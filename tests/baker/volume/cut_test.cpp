// SPDX-License-Identifier: MIT
// Cuts whose outcome is known, the awkward ones first.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "cut_checks.h"
#include "volume/slab_cells.h"
#include "volume/voronoi_cells.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Cut by planes that make slabs, and checked.
CutSolid slabsOf(const Solid& solid, const std::vector<CutPlane>& planes) {
    CutSolid cut;
    std::string wrong;
    REQUIRE(cutSolid(solid, {slabCells(planes, gridOf(solid)).value()}, cut, wrong));
    Random random(1);
    REQUIRE(whatBreaks(cut, random, 200) == "");
    return cut;
}

CutSolid voronoiOf(const Solid& solid, const std::vector<glm::dvec3>& sites) {
    CutSolid cut;
    std::string wrong;
    REQUIRE(cutSolid(solid, {voronoiCells(sites, gridOf(solid)).value()}, cut, wrong));
    Random random(1);
    REQUIRE(whatBreaks(cut, random, 200) == "");
    return cut;
}

CutSolid slicesOf(const Solid& solid, const SliceOptions& options) {
    const glm::dvec3 one(1);
    CutSolid cut;
    std::string wrong;
    REQUIRE(cutSolid(solid, sliceCells(options, -one, one, gridOf(solid)).value(), cut, wrong));
    Random random(1);
    REQUIRE(whatBreaks(cut, random, 200) == "");
    return cut;
}

Solid cube(int n = 1) {
    return boxSolid(glm::vec3(-1), glm::vec3(1), n);
}

size_t trianglesOf(const CutSolid& cut) {
    return std::accumulate(cut.pieces.pieces.begin(), cut.pieces.pieces.end(), size_t{0},
                           [](size_t sum, const PieceMesh& p) { return sum + p.triangles.size(); });
}

}  // namespace

TEST_CASE("a cube cut by one plane gives two closed halves") {
    const CutSolid cut = slabsOf(cube(), {{{0.25, 0, 0}, {1, 0, 0}}});
    REQUIRE(cut.pieces.pieces.size() == 2);
    CHECK(cut.pieces.pieces[0].volume == doctest::Approx(5));
    CHECK(cut.pieces.pieces[1].volume == doctest::Approx(3));
    REQUIRE(cut.cut.caps.size() == 1);
    // Four sides are cut, each of their two triangles.
    CHECK(cut.cut.report.united == 0);
    for (const PieceMesh& piece : cut.pieces.pieces) CHECK(piece.lumps == 1);
}

TEST_CASE("a plane through vertices cuts along edges and makes no new vertex") {
    const Solid solid = cube(2);
    const CutSolid cut = slabsOf(solid, {{{0, 0, 0}, {0, 1, 0}}});
    REQUIRE(cut.pieces.pieces.size() == 2);
    for (const PieceMesh& piece : cut.pieces.pieces) {
        for (const uint32_t v : piece.vertices) CHECK(v < solid.positions.size());
    }
    // Half of 48, and a cap with 8 corners.
    CHECK(trianglesOf(cut) == 48 + 2 * 6);
}

TEST_CASE("planes through edges and corners in every direction meet in clean corners") {
    const CutSolid cut = slicesOf(cube(4), {{4, 4, 4}});
    CHECK(cut.pieces.pieces.size() == 64);
    CHECK(trianglesOf(cut) == 64 * 12);
    CHECK(cut.cut.caps.size() == 3 * 48);
    CHECK(cut.cut.report.fans == 0);
}

TEST_CASE("a diagonal plane through two opposite edges halves a cube") {
    const CutSolid cut = slabsOf(cube(), {{{0, 0, 0}, {1, 1, 0}}});
    REQUIRE(cut.pieces.pieces.size() == 2);
    CHECK(cut.pieces.pieces[0].volume == doctest::Approx(4));
}

TEST_CASE("a plane in a face of the mesh moves off it and cuts nothing") {
    for (const double side : {-1.0, 1.0}) {
        const CutSolid cut = slabsOf(cube(3), {{{side, 0, 0}, {1, 0, 0}}});
        REQUIRE(cut.pieces.pieces.size() == 1);
        CHECK(cut.pieces.pieces[0].volume == doctest::Approx(8));
        CHECK(cut.cut.report.movedPlanes == 1);
        CHECK(cut.cut.report.opposedPlanes == 0);
    }
}

TEST_CASE("a plane along a step of the mesh keeps the step's skin on its solid") {
    // An L, seen along y.
    Solid solid;
    solid.positions = {{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {1, 0, 2}, {0, 0, 2},
                       {0, 1, 0}, {2, 1, 0}, {2, 1, 1}, {1, 1, 1}, {1, 1, 2}, {0, 1, 2}};
    const auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
        solid.triangles.push_back({a, b, c});
        solid.triangles.push_back({a, c, d});
    };
    quad(0, 1, 2, 3);
    quad(0, 3, 4, 5);
    quad(6, 9, 8, 7);
    quad(6, 11, 10, 9);
    for (uint32_t k = 0; k < 6; ++k) quad((k + 1) % 6, k, k + 6, (k + 1) % 6 + 6);
    const CutSolid cut = slabsOf(solid, {{{0, 0, 1}, {0, 0, 1}}});
    REQUIRE(cut.pieces.pieces.size() == 2);
    CHECK(cut.cut.report.movedPlanes == 1);
    CHECK(cut.pieces.pieces[0].volume == doctest::Approx(2).epsilon(1e-5));
    CHECK(cut.pieces.pieces[1].volume == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("faces that look both ways at a plane leave it to the larger area") {
    Solid two = boxSolid(glm::vec3(-1, 0, 0), glm::vec3(0, 2, 2));
    two.append(boxSolid(glm::vec3(0, 0.5F, 0.5F), glm::vec3(1, 1, 1)));
    const CutSolid cut = slabsOf(two, {{{0, 0, 0}, {1, 0, 0}}});
    CHECK(cut.cut.report.opposedPlanes == 1);
    REQUIRE(cut.pieces.pieces.size() == 2);
    CHECK(cut.pieces.pieces[0].volume == doctest::Approx(4).epsilon(1e-5));
    CHECK(cut.pieces.pieces[0].lumps == 2);  // a film of the smaller box
}

TEST_CASE("a hollow cube gives pieces with a hollow") {
    Solid solid = cube(2);
    Solid inner = boxSolid(glm::vec3(-0.5F), glm::vec3(0.5F));
    inner.turnInsideOut();
    solid.append(inner);
    const CutSolid cut = slabsOf(solid, {{{0.1, 0, 0}, {1, 0, 0}}});
    REQUIRE(cut.pieces.pieces.size() == 2);
    CHECK(cut.pieces.pieces[0].volume == doctest::Approx(4.4 - 0.6));
    CHECK(cut.pieces.pieces[1].volume == doctest::Approx(3.6 - 0.4));
}

TEST_CASE("a hollow that no plane meets stays in one piece") {
    Solid solid = cube(2);
    Solid inner = boxSolid(glm::vec3(-0.5F), glm::vec3(-0.25F));
    inner.turnInsideOut();
    solid.append(inner);
    const CutSolid cut = slabsOf(solid, {{{0.1, 0, 0}, {1, 0, 0}}});
    REQUIRE(cut.pieces.pieces.size() == 2);
    CHECK(cut.pieces.pieces[0].lumps == 2);
    CHECK(cut.pieces.pieces[0].volume == doctest::Approx(4.4 - 1.0 / 64));
}

TEST_CASE("overlapping solids are each closed in each piece") {
    Solid solid = cube(2);
    Solid other = cube(2);
    other.transform([](const glm::vec3& p) { return p * 0.75F + glm::vec3(0.6F, 0.3F, 0.1F); });
    solid.append(other);
    const CutSolid cut = slabsOf(solid, {{{0.1, 0, 0}, {1, 0.2, 0}}});
    CHECK(cut.pieces.pieces.size() == 2);
    CHECK(cut.cut.report.crossedCaps == 1);
    CHECK(cut.cut.report.fans == 0);
}

TEST_CASE("the same solid twice is closed twice in each piece") {
    Solid solid = cube(2);
    solid.append(cube(2));
    const CutSolid cut = voronoiOf(solid, {{-0.5, 0.1, 0.2}, {0.5, 0, 0}, {0.1, 0.6, -0.3}});
    CHECK(cut.pieces.pieces.size() == 3);
}

TEST_CASE("one site leaves the mesh whole and equal sites count once") {
    CHECK(voronoiOf(cube(), {{0.3, 0.2, 0.1}}).pieces.pieces.size() == 1);
    const CutSolid cut = voronoiOf(cube(), {{0.3, 0, 0}, {0.3, 0, 0}, {-0.3, 0, 0}, {0.3, 0, 0}});
    REQUIRE(cut.pieces.pieces.size() == 2);
    CHECK(cut.pieces.pieceOfCell ==
          std::vector<uint32_t>{0, CutPieces::kNone, 1, CutPieces::kNone});
}

TEST_CASE("sites on a lattice, where eight cells meet in a point, make a lattice of pieces") {
    std::vector<glm::dvec3> sites;
    sites.reserve(27);
    for (int n = 0; n < 27; ++n) sites.emplace_back(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    const CutSolid cut = voronoiOf(boxSolid(glm::vec3(-1.5F), glm::vec3(1.5F), 3), sites);
    CHECK(cut.pieces.pieces.size() == 27);
    CHECK(trianglesOf(cut) == 27 * 12);
    CHECK(cut.cut.caps.size() == 54);
}

TEST_CASE("sites on a sphere, whose cells all meet in the middle, share it") {
    const Solid ball = sphereSolid(glm::vec3(0), glm::vec3(1), 16, 8);
    std::vector<glm::dvec3> sites;
    for (const glm::vec3& p : ball.positions) sites.push_back(glm::dvec3(p) * 0.9);
    CHECK(voronoiOf(ball, sites).pieces.pieces.size() == ball.positions.size());
}

TEST_CASE("cells that hold nothing are no pieces") {
    const CutSolid cut = voronoiOf(cube(), {{0, 0, 0}, {3.9, 0, 0}, {0.5, 0.5, 0.5}});
    CHECK(cut.pieces.pieces.size() == 2);
    CHECK(cut.pieces.pieceOfCell[1] == CutPieces::kNone);
}

TEST_CASE("a fold without volume, alone in its cell, goes to the largest piece") {
    Solid solid = cube();
    const auto first = static_cast<uint32_t>(solid.positions.size());
    solid.positions.insert(solid.positions.end(), {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}});
    solid.triangles.push_back({first, first + 1, first + 2});
    solid.triangles.push_back({first + 2, first + 1, first});
    const CutSolid cut = slabsOf(solid, {{{-0.5, 0, 0}, {1, 0, 0}}, {{2, 0, 0}, {1, 0, 0}}});
    REQUIRE(cut.pieces.pieces.size() == 2);
    CHECK(cut.pieces.slivers == 1);
    CHECK(cut.pieces.pieces[0].lumps == 1);
    CHECK(cut.pieces.pieces[1].lumps == 2);
    CHECK(cut.pieces.pieces[1].volume == doctest::Approx(6));
}

TEST_CASE("a ring cut lengthwise twice gives a piece of two lumps") {
    const Solid ring = torusSolid(1, 0.25F, 24, 8);
    const CutSolid cut = slabsOf(ring, {{{-0.3, 0, 0}, {1, 0, 0}}, {{0.3, 0, 0}, {1, 0, 0}}});
    REQUIRE(cut.pieces.pieces.size() == 3);
    CHECK(cut.pieces.pieces[1].lumps == 2);
}

TEST_CASE("slices with jitter that makes planes cross stay a partition") {
    SliceOptions options{{5, 4, 3}};
    options.offsetJitter = options.angleJitter = 1;
    for (options.seed = 0; options.seed < 20; ++options.seed)
        CHECK(slicesOf(cube(2), options).pieces.pieces.size() >= 40);
}

TEST_CASE("the same plane twice is one") {
    const std::vector<CutPlane> planes{{{0, 0, 0}, {1, 2, 3}}, {{0, 0, 0}, {-2, -4, -6}}};
    CHECK(planeCells(planes, gridOf(cube())).value().size() == 1);
}

TEST_CASE("planes that meet in one point or line cut around it, up to eight of them") {
    const Solid solid = cube(2);
    for (const bool line : {false, true}) {
        std::vector<CutPlane> planes;
        for (int k = 0; k < 12; ++k) {
            const double angle = 0.25 * k;
            planes.push_back({{0, 0, 0}, {std::cos(angle), std::sin(angle), line ? 0.0 : 0.5}});
        }
        CHECK(planeCells(planes, gridOf(solid)).error().code == ErrorCode::limitExceeded);
        planes.resize(8);
        CutSolid cut;
        std::string wrong;
        REQUIRE(cutSolid(solid, planeCells(planes, gridOf(solid)).value(), cut, wrong));
        Random random(1);
        CHECK(whatBreaks(cut, random, 200) == "");
        // Around a line 2 n; around a point n (n - 1) + 2.
        CHECK(cut.pieces.pieces.size() == (line ? 16 : 58));
        planes.resize(12, {{0, 0, 0}, {1, 2, 3}});
        for (size_t k = 8; k < planes.size(); ++k)
            planes[k].point = {0.1 * static_cast<double>(k), 0, 0};
        // Where such a plane crosses the line of eight there are nine.
        CHECK(planeCells(planes, gridOf(solid)).has_value() != line);
    }
}

TEST_CASE("cells of one group are one piece") {
    const Solid solid = cube(2);
    const CutGrid grid = gridOf(solid);
    MeshCut cut =
        cutMesh(
            solid.positions, solid.triangles, grid,
            CellFunctions::of(sliceCells({{2, 2, 2}}, glm::dvec3(-1), glm::dvec3(1), grid).value())
                .value())
            .value();
    PieceOptions options;
    const std::vector<uint32_t> groups{7, 7, 7, 1, 2, 2, 2, 2};
    options.groups = groups;
    const CutPieces pieces = assemblePieces(cut, options);
    REQUIRE(pieces.pieces.size() == 3);
    CHECK(pieces.pieces[0].volume == doctest::Approx(3));
    CHECK(pieces.pieces[1].volume == doctest::Approx(1));
    CHECK(pieces.pieces[2].volume == doctest::Approx(4));
}

TEST_CASE("what cannot be cut is refused with a reason") {
    const Solid solid = cube();
    const CutGrid grid = gridOf(solid);
    const auto cells = [&] {
        const std::vector<glm::dvec3> sites{{0, 0, 0}, {1, 0, 0}};
        return CellFunctions::of({voronoiCells(sites, grid).value()}).value();
    };
    const auto errorOf = [&](const Solid& s) {
        return cutMesh(s.positions, s.triangles, grid, cells()).error().code;
    };
    Solid open = solid;
    open.triangles.pop_back();
    CHECK(errorOf(open) == ErrorCode::openMesh);
    Solid inwards = solid;
    inwards.turnInsideOut();
    CHECK(errorOf(inwards) == ErrorCode::invalidData);
    CHECK(errorOf(Solid()) == ErrorCode::noTriangles);

    Solid point = solid;
    point.transform([](const glm::vec3&) { return glm::vec3(1); });
    CHECK(CutGrid::around(point.positions, point.triangles).error().code == ErrorCode::invalidData);
    Solid broken = solid;
    broken.positions[0].x = std::numeric_limits<float>::quiet_NaN();
    CHECK(CutGrid::around(broken.positions, broken.triangles).error().code ==
          ErrorCode::invalidData);
    broken = solid;
    broken.triangles[3][1] = 99;
    CHECK(CutGrid::around(broken.positions, broken.triangles).error().where == "triangle 3");

    const std::vector<glm::dvec3> far{{1e9, 0, 0}};
    CHECK(voronoiCells(far, grid).error().code == ErrorCode::badArgument);
    CHECK(CellFunctions::of({CellFamily()}).error().code == ErrorCode::badArgument);
    CHECK(slabCells(std::vector<CutPlane>{{{0, 0, 0}, {0, 0, 0}}}, grid).error().code ==
          ErrorCode::badArgument);
    CHECK(planeCells(std::vector<CutPlane>(17), grid).error().code == ErrorCode::limitExceeded);
    SliceOptions many{{1000, 1000, 1}};
    CHECK(CellFunctions::of(sliceCells(many, glm::dvec3(-1), glm::dvec3(1), grid).value())
              .error()
              .code == ErrorCode::limitExceeded);
    many.counts[0] = 0;
    CHECK(sliceCells(many, glm::dvec3(-1), glm::dvec3(1), grid).error().code ==
          ErrorCode::badArgument);
}

TEST_CASE("the checks see a broken cut") {
    Random random(5);
    const auto whole = [] {
        return voronoiOf(cube(2), {{-0.5, 0.1, 0.2}, {0.5, 0, 0}, {0.1, 0.6, -0.3}});
    };
    CutSolid cut = whole();
    cut.pieces.pieces[1].triangles.pop_back();
    CHECK(brokenClosed(cut) != "");
    cut = whole();
    std::swap(cut.pieces.pieces[0], cut.pieces.pieces[1]);
    CHECK(brokenClosed(cut) == "");
    CHECK(brokenSharing(cut) != "");
    CHECK(brokenPlaces(cut) != "");
    CHECK(brokenCoverage(cut, random, 200) != "");
    cut = whole();
    cut.cut.positions.back() += glm::vec3(1e-3F);  // the vertex inside, where no skin is
    CHECK(brokenPlaces(cut) != "");
    cut = whole();
    cut.cut.weights[0][0].x += 1e-3;
    CHECK(brokenPlaces(cut) != "");
    cut = whole();
    cut.cut.skin.pop_back();
    CHECK(brokenSkin(cut) != "");
    cut = whole();
    cut.pieces.pieces.pop_back();
    CHECK(brokenVolume(cut) != "");
}
