// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cut_checks.h"
#include "geometry/inside_test.h"
#include "volume/volume_sites.h"
#include "volume/voronoi_cells.h"

using namespace sherd;
using namespace sherd::test;

namespace {

std::vector<glm::dvec3> sitesOf(const Solid& solid, const VolumeSites& options) {
    return volumeSites(solid.positions, solid.triangles, options).value();
}

double meanDistance(const std::vector<glm::dvec3>& sites, const glm::dvec3& from) {
    double sum = 0;
    for (const glm::dvec3& s : sites) sum += glm::distance(s, from);
    return sum / static_cast<double>(sites.size());
}

}  // namespace

TEST_CASE("uniform sites are inside, as many as asked for, and the same for the same seed") {
    const Solid ring = torusSolid(1, 0.25F, 24, 8);
    const InsideTest inside(ring.positions, ring.triangles);
    VolumeSites options;
    options.count = 300;
    const auto sites = sitesOf(ring, options);
    CHECK(sites.size() == 300);
    for (const glm::dvec3& s : sites) CHECK(inside.inside(s));
    CHECK(sites == sitesOf(ring, options));
    options.seed = 2;
    CHECK(sites != sitesOf(ring, options));
}

TEST_CASE("sites of a solid too thin to hit lie on its skin") {
    const Solid sheet = boxSolid(glm::vec3(0), glm::vec3(1, 1, 1e-7F));
    Solid skew = sheet;
    skew.transform([](const glm::vec3& p) { return glm::vec3(p.x, p.y, p.z + p.x + p.y); });
    VolumeSites options;
    options.count = 20;
    for (const glm::dvec3& s : sitesOf(skew, options)) CHECK(std::abs(s.z - s.x - s.y) < 1e-6);
}

TEST_CASE("crowded sites gather around their points") {
    const Solid box = boxSolid(glm::vec3(-1), glm::vec3(1));
    VolumeSites options;
    options.count = 200;
    const double uniform = meanDistance(sitesOf(box, options), glm::dvec3(1));
    options.kind = VolumeSites::Kind::crowded;
    options.around = {glm::dvec3(1)};
    CHECK(meanDistance(sitesOf(box, options), glm::dvec3(1)) < 0.6 * uniform);
}

TEST_CASE("a lattice without jitter cuts a box into equal boxes") {
    const Solid box = boxSolid(glm::vec3(0), glm::vec3(3, 2, 1));
    VolumeSites options;
    options.kind = VolumeSites::Kind::lattice;
    options.count = 6;
    options.jitter = 0;
    const auto sites = sitesOf(box, options);
    CHECK(sites.size() == 6);
    const CutGrid grid = CutGrid::around(box.positions, box.triangles).value();
    CutSolid cut;
    std::string wrong;
    REQUIRE(cutSolid(box, {voronoiCells(sites, grid).value()}, cut, wrong));
    REQUIRE(cut.pieces.pieces.size() == 6);
    for (const PieceMesh& piece : cut.pieces.pieces) CHECK(piece.volume == doctest::Approx(1));
}

TEST_CASE("stretched cells are longer along their axis and as closed") {
    const Solid box = boxSolid(glm::vec3(0), glm::vec3(4, 4, 4), 3);
    const CutGrid grid = CutGrid::around(box.positions, box.triangles).value();
    VolumeSites options;
    options.count = 60;
    const auto sites = sitesOf(box, options);
    for (const double stretch : {1.0, 1.5, 8.0, 64.0}) {
        CAPTURE(stretch);
        CutSolid cut;
        std::string wrong;
        REQUIRE(cutSolid(box, {voronoiCells(sites, grid, {1, 1, stretch}).value()}, cut, wrong));
        Random random(1);
        REQUIRE(whatBreaks(cut, random, 200) == "");
        // The largest piece, as a share of the box's height.
        double height = 0;
        for (const PieceMesh& piece : cut.pieces.pieces) {
            glm::vec3 low(1e9F), high(-1e9F);
            for (const uint32_t v : piece.vertices) {
                low = glm::min(low, cut.cut.positions[v]);
                high = glm::max(high, cut.cut.positions[v]);
            }
            height += (high.z - low.z) / static_cast<double>(cut.pieces.pieces.size());
        }
        CHECK(height > (stretch == 1 ? 1 : (stretch < 8 ? 1.6 : 2.5)));
        CHECK(height < (stretch == 1 ? 2.2 : 4.1));
    }
}

TEST_CASE("sites of a thousand cells with crowds are found to the last neighbour") {
    // Crowds make cells of very different sizes, where a search that stops early would miss some.
    const Solid ball = sphereSolid(glm::vec3(0), glm::vec3(1), 12, 9);
    VolumeSites options;
    options.kind = VolumeSites::Kind::crowded;
    options.around = {{0.9, 0, 0}};
    options.spread = 0.02;
    options.count = 600;
    const CutGrid grid = CutGrid::around(ball.positions, ball.triangles).value();
    CutSolid cut;
    std::string wrong;
    REQUIRE(cutSolid(ball, {voronoiCells(sitesOf(ball, options), grid).value()}, cut, wrong));
    Random random(1);
    REQUIRE(brokenClosed(cut) == "");
    REQUIRE(brokenVolume(cut) == "");
    REQUIRE(brokenPlaces(cut) == "");
}

TEST_CASE("options of sites are checked") {
    const Solid box = boxSolid(glm::vec3(0), glm::vec3(1));
    const auto errorOf = [&](const VolumeSites& options) {
        return volumeSites(box.positions, box.triangles, options).error().code;
    };
    VolumeSites options;
    options.count = 0;
    CHECK(errorOf(options) == ErrorCode::badArgument);
    options.count = 5;
    options.kind = VolumeSites::Kind::crowded;
    CHECK(errorOf(options) == ErrorCode::badArgument);
    options.around = {{0, 0, 0}};
    options.spread = 0;
    CHECK(errorOf(options) == ErrorCode::badArgument);
    options = {};
    options.jitter = 2;
    CHECK(errorOf(options) == ErrorCode::badArgument);
    const CutGrid grid = CutGrid::around(box.positions, box.triangles).value();
    const std::vector<glm::dvec3> one{{0, 0, 0}};
    CHECK(voronoiCells(one, grid, {1, 1, 65}).error().code == ErrorCode::badArgument);
}
