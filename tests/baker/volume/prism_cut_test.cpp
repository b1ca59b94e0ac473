// SPDX-License-Identifier: MIT
// Drawings projected straight through solids. That pieces are where the drawing says is judged by
// points: what lies over one place of the drawing is one piece, and so is what no line parts.
#include "volume/prism_cut.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "cut_checks.h"
#include "geometry/closed_mesh.h"
#include "geometry/inside_test.h"
#include "map/planar_map.h"
#include "volume/prism_map.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Lines = std::vector<std::vector<glm::dvec2>>;  ///< in the solid's unit, in the plane

struct Prisms {
    CutSolid solid;
    Lines lines;
    uint32_t axis = 2, idle = 0, faces = 0;
};

glm::dvec2 planar(const glm::dvec3& p, uint32_t axis) {
    return {p[static_cast<int>((axis + 1) % 3)], p[static_cast<int>((axis + 2) % 3)]};
}

Prisms cutBy(const Solid& whole, const Lines& lines, uint32_t axis = 2) {
    const CutGrid grid = CutGrid::around(whole.positions, whole.triangles).value();
    FractureMap drawn;
    for (const std::vector<glm::dvec2>& line : lines) {
        FractureMap::Line& out = drawn.lines.emplace_back();
        for (const glm::dvec2& p : line) {
            glm::dvec3 place(0);
            place[static_cast<int>((axis + 1) % 3)] = p.x;
            place[static_cast<int>((axis + 2) % 3)] = p.y;
            out.points.push_back(planar(grid.toGrid(place), axis) / 0x1p26 + 0.5);
        }
    }
    const PlanarMap planarMap = planarise(drawn).value();
    const PrismMap map = PrismMap::of(planarMap).value();
    Result<MeshCut> cut = cutByPrisms(whole.positions, whole.triangles, grid, map, axis);
    if (!cut) FAIL(cut.error().message);
    CutPieces pieces = assemblePieces(*cut, {.groups = map.faces()});
    return {{whole, grid, std::move(*cut), std::move(pieces)},
            lines,
            axis,
            map.idleEdges(),
            map.faceCount()};
}

std::vector<double> volumesOf(const Prisms& prisms) {
    std::vector<double> volumes;
    for (const PieceMesh& piece : prisms.solid.pieces.pieces) volumes.push_back(piece.volume);
    std::sort(volumes.begin(), volumes.end());
    return volumes;
}

/// Distance of a line from a segment a b; 0 where they cross.
double distance(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                const glm::dvec2& d) {
    const auto cross = [](const glm::dvec2& u, const glm::dvec2& v) {
        return u.x * v.y - u.y * v.x;
    };
    const auto side = [&](const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
        return cross(q - p, r - p) > 0;
    };
    if (side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)) return 0;
    const auto toSegment = [](const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
        const glm::dvec2 qr = r - q;
        const double length = glm::dot(qr, qr);
        const double t = length > 0 ? std::clamp(glm::dot(p - q, qr) / length, 0.0, 1.0) : 0;
        return glm::length(p - q - t * qr);
    };
    return std::min(
        {toSegment(a, c, d), toSegment(b, c, d), toSegment(c, a, b), toSegment(d, a, b)});
}

double distanceToLines(const Prisms& prisms, const glm::dvec2& a, const glm::dvec2& b) {
    double least = 1e30;
    for (const auto& line : prisms.lines)
        for (size_t k = 0; k + 1 < line.size(); ++k)
            least = std::min(least, distance(a, b, line[k], line[k + 1]));
    return least;
}

/// Each point inside is in one piece, outside in none; those that no line parts are in the same.
std::string brokenPrisms(const Prisms& prisms, Random& random, uint32_t count) {
    const CutSolid& cut = prisms.solid;
    const InsideTest whole(cut.whole.positions, cut.whole.triangles);
    std::vector<std::vector<glm::vec3>> positions;
    std::vector<InsideTest> pieces;
    for (const PieceMesh& piece : cut.pieces.pieces) positions.push_back(piece.positions(cut.cut));
    for (size_t p = 0; p < positions.size(); ++p)
        pieces.emplace_back(positions[p], cut.pieces.pieces[p].triangles);
    const double reach = cut.grid.extent() / 2, near = 1e-5 * cut.grid.extent();
    struct Found {
        glm::dvec2 at;
        size_t piece;
    };
    std::vector<Found> found;
    for (uint32_t n = 0; n < count; ++n) {
        const glm::dvec3 p =
            cut.grid.toWorld(glm::dvec3(0)) +
            reach * glm::dvec3(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
        const glm::dvec2 at = planar(p, prisms.axis);
        if (distanceToLines(prisms, at, at) < near) continue;
        size_t in = 0, last = 0;
        for (size_t k = 0; k < pieces.size(); ++k) {
            if (!pieces[k].inside(p)) continue;
            ++in;
            last = k;
        }
        if (in != (whole.inside(p) ? 1 : 0)) return "a point in " + std::to_string(in) + " pieces";
        if (in == 1) found.push_back({at, last});
    }
    for (size_t n = 1; n < found.size(); ++n)
        for (size_t k = 0; k < std::min<size_t>(n, 20); ++k)
            if (found[n].piece != found[n - 1 - k].piece &&
                distanceToLines(prisms, found[n].at, found[n - 1 - k].at) > near)
                return "two pieces where no line is between";
    return "";
}

std::string whatBreaks(const Prisms& prisms, Random& random, uint32_t points) {
    for (const std::string& broken :
         {brokenClosed(prisms.solid), brokenSharing(prisms.solid), brokenVolume(prisms.solid),
          brokenSkin(prisms.solid), brokenPrisms(prisms, random, points)})
        if (!broken.empty()) return broken;
    return "";
}

std::vector<glm::dvec2> ring(const glm::dvec2& middle, double radius, int corners) {
    std::vector<glm::dvec2> points;
    for (int k = 0; k <= corners; ++k) {
        const double angle = 2 * std::numbers::pi * (k % corners + 0.25) / corners;
        points.push_back(middle + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

Lines rectangle(const glm::dvec2& low, const glm::dvec2& high) {
    return {{low, {high.x, low.y}, high, {low.x, high.y}, low}};
}

}  // namespace

TEST_CASE("lines of a grid cut a box into boxes, along every axis") {
    for (uint32_t axis = 0; axis < 3; ++axis) {
        CAPTURE(axis);
        Lines lines;
        for (const double at : {0.25, 0.5, 0.75}) {
            lines.push_back({{at, 0}, {at, 1}});
            lines.push_back({{0, at}, {1, at}});
        }
        const Prisms prisms = cutBy(boxSolid({0, 0, 0}, {1, 1, 1}, 2), lines, axis);
        // The lines' ends lie in the box's sides: moved or not, each cell is parted from the next.
        Lines longer = lines;
        for (auto& line : longer) {
            line[0] -= 0.1 * glm::dvec2(line[0].x == 0 ? 1 : 0, line[0].y == 0 ? 1 : 0);
            line[1] += 0.1 * glm::dvec2(line[1].x == 1 ? 1 : 0, line[1].y == 1 ? 1 : 0);
        }
        const Lines outline = rectangle({-0.1, -0.1}, {1.1, 1.1});
        longer.insert(longer.end(), outline.begin(), outline.end());
        const Prisms closed = cutBy(boxSolid({0, 0, 0}, {1, 1, 1}, 2), longer, axis);
        REQUIRE(closed.solid.pieces.pieces.size() == 16);
        for (const double volume : volumesOf(closed)) CHECK(volume == doctest::Approx(1.0 / 16));
        Random random(1);
        CHECK(whatBreaks(closed, random, 300) == "");
        CHECK(whatBreaks(prisms, random, 300) == "");
    }
}

TEST_CASE("loops in loops: a face with a hole is one piece with a hole") {
    Lines lines = rectangle({0.1, 0.1}, {0.9, 0.9});
    const Lines inner = rectangle({0.3, 0.3}, {0.7, 0.7});
    lines.insert(lines.end(), inner.begin(), inner.end());
    const Prisms prisms = cutBy(boxSolid({0, 0, 0}, {1, 1, 1}, 1), lines);
    const std::vector<double> volumes = volumesOf(prisms);
    REQUIRE(volumes.size() == 3);
    CHECK(volumes[0] == doctest::Approx(0.16));
    CHECK(volumes[1] == doctest::Approx(0.36));
    CHECK(volumes[2] == doctest::Approx(0.48));
    Random random(2);
    CHECK(whatBreaks(prisms, random, 500) == "");
}

TEST_CASE("a concave face, an outline along the box's sides, and a line through its vertices") {
    Random random(3);
    const Solid box = boxSolid({0, 0, 0}, {1, 1, 1}, 4);
    // An L, its lines along edges of the mesh.
    const Prisms concave = cutBy(box, {{{0.25, 0.25},
                                        {0.75, 0.25},
                                        {0.75, 0.5},
                                        {0.5, 0.5},
                                        {0.5, 0.75},
                                        {0.25, 0.75},
                                        {0.25, 0.25}}});
    CHECK(volumesOf(concave).size() == 2);
    CHECK(volumesOf(concave)[0] == doctest::Approx(0.1875));
    CHECK(whatBreaks(concave, random, 500) == "");
    Lines outline = rectangle({0, 0}, {1, 1});
    outline.push_back({{0, 0}, {1, 1}});
    const Prisms halves = cutBy(box, outline);
    CHECK(volumesOf(halves).size() == 2);
    CHECK(volumesOf(halves)[0] == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(whatBreaks(halves, random, 500) == "");
}

TEST_CASE("the check of prisms sees pieces in the wrong place") {
    Prisms prisms = cutBy(boxSolid({0, 0, 0}, {1, 1, 1}, 1), rectangle({0.2, 0.2}, {0.5, 0.5}));
    Random random(6);
    CHECK(brokenPrisms(prisms, random, 300) == "");
    // As if it were cut along other lines.
    Prisms moved = prisms;
    moved.lines = rectangle({0.4, 0.4}, {0.8, 0.8});
    CHECK(brokenPrisms(moved, random, 300) != "");
    prisms.solid.pieces.pieces.pop_back();
    CHECK(brokenPrisms(prisms, random, 300) != "");
}

TEST_CASE("a ring through a sphere makes a core and what is around it") {
    const Solid sphere = sphereSolid({0, 0, 0}, {1, 1, 1}, 48, 24);
    const Prisms prisms = cutBy(sphere, {ring({0, 0}, 0.5, 64)});
    const std::vector<double> volumes = volumesOf(prisms);
    REQUIRE(volumes.size() == 2);
    const double core = 4 * std::numbers::pi / 3 * (1 - std::pow(0.75, 1.5));
    CHECK(volumes[0] == doctest::Approx(core).epsilon(0.03));
    Random random(4);
    CHECK(whatBreaks(prisms, random, 800) == "");
}

TEST_CASE("dangling lines, lines within a face and repeated ones cut nothing and are counted") {
    const Solid box = boxSolid({0, 0, 0}, {1, 1, 1}, 1);
    const Prisms none = cutBy(box, {{{0.2, 0.2}, {0.6, 0.7}}, {{0.1, 0.1}, {0.1, 3}}});
    CHECK(none.solid.pieces.pieces.size() == 1);
    CHECK(none.idle == 2);
    Lines lines = rectangle({0.25, 0.25}, {0.75, 0.75});
    lines.push_back(lines[0]);
    lines.push_back({{0.5, 0.5}, {0.75, 0.75}});
    const Prisms one = cutBy(box, lines);
    CHECK(volumesOf(one).size() == 2);
    CHECK(one.idle == 1);
    Random random(5);
    CHECK(whatBreaks(one, random, 300) == "");
}

TEST_CASE("dangling lines leave the skin whole") {
    Lines lines = rectangle({0.25, 0.25}, {0.75, 0.75});
    const Prisms plain = cutBy(boxSolid({0, 0, 0}, {1, 1, 1}, 1), lines);
    for (int k = 0; k < 50; ++k) lines.push_back({{0.3, 0.3 + 0.008 * k}, {0.7, 0.31 + 0.008 * k}});
    const Prisms dangling = cutBy(boxSolid({0, 0, 0}, {1, 1, 1}, 1), lines);
    CHECK(dangling.solid.cut.skin.size() == plain.solid.cut.skin.size());
    CHECK(dangling.idle >= 50);
}

TEST_CASE("a drawing of thousands of faces goes through a sphere in little time") {
    Lines lines;
    constexpr int kLines = 60;
    for (int k = 0; k <= kLines; ++k) {
        const double at = -1.05 + 2.1 * k / kLines;
        lines.push_back({{at, -1.05}, {at + 0.013, 1.05}});
        lines.push_back({{-1.05, at}, {1.05, at - 0.017}});
    }
    const Prisms prisms = cutBy(sphereSolid({0, 0, 0}, {1, 1, 1}, 40, 20), lines);
    CHECK(prisms.faces > 3000);
    CHECK(prisms.solid.pieces.pieces.size() > 2000);
    CHECK(brokenClosed(prisms.solid) == "");
    CHECK(brokenVolume(prisms.solid) == "");
    CHECK(brokenSkin(prisms.solid) == "");
}

TEST_CASE("random drawings through random solids: closed, shared, complete, and as drawn") {
    uint32_t pieces = 0, cut = 0;
    for (const uint32_t seed : propertySeeds(1, 120)) {
        CAPTURE(seed);
        Random random(seed);
        const Solid solid = randomSolid(random);
        const CutGrid grid = CutGrid::around(solid.positions, solid.triangles).value();
        const uint32_t axis = random.below(3);
        const glm::dvec2 middle = planar(grid.toWorld(glm::dvec3(0)), axis);
        const double reach = 0.6 * grid.extent();
        // Aligned as the solids are: lines meet edges and vertices of the mesh all the time.
        const bool aligned = random.oneIn(2);
        const auto place = [&] {
            glm::dvec2 p = middle + reach * glm::dvec2(random.in(-1, 1), random.in(-1, 1));
            if (aligned) p = glm::round(p * 4.0) / 4.0;
            return p;
        };
        Lines lines;
        for (uint32_t n = 1 + random.below(10); n > 0; --n) {
            std::vector<glm::dvec2> line;
            for (uint32_t k = 2 + random.below(4); k > 0; --k) line.push_back(place());
            if (random.oneIn(2)) line.push_back(line[0]);
            lines.push_back(std::move(line));
        }
        if (random.oneIn(3)) lines.push_back(ring(place(), reach * random.unit(), 7));
        const Prisms prisms = cutBy(solid, lines, axis);
        pieces += static_cast<uint32_t>(prisms.solid.pieces.pieces.size());
        cut += prisms.solid.pieces.pieces.size() > 1 ? 1 : 0;
        if (solid.simple) {
            CHECK(whatBreaks(prisms, random, 150) == "");
        } else {
            CHECK(brokenVolume(prisms.solid) == "");
            for (const PieceMesh& piece : prisms.solid.pieces.pieces)
                CHECK(proveByIds(piece.triangles).closed());
        }
        CHECK(prisms.solid.cut.report.fans == 0);
    }
    MESSAGE(pieces << " pieces of " << cut << " solids that were cut");
    CHECK(3 * cut > static_cast<uint32_t>(propertyCases(120)));  // what the test is for does happen
}
