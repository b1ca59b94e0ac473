// SPDX-License-Identifier: MIT
// Lines drawn over the surface from place to place.
#include "surface/surface_path.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shapes.h"
#include "support/property.h"
#include "surface/surface_point.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Places = std::vector<glm::dvec3>;

FracturePlan over(const std::vector<Places>& lines) {
    FracturePlan plan;
    plan.drawings.emplace_back();
    for (const Places& places : lines) {
        FractureMap::SurfaceLine line{{}, 1, "stroke", {}};
        for (const glm::dvec3& p : places) line.places.push_back({true, p});
        plan.drawings[0].map.surfaceLines.push_back(line);
    }
    return plan;
}

Grown draw(const SurfaceMesh& mesh, const std::vector<Places>& lines, double snap = 1e300) {
    CutOptions options;
    options.snapDistance = snap;
    return grow(mesh, over(lines), options);
}

/// A circle around the z axis, closed.
Places circle(double radius, double z, int points, double turn = 0) {
    Places places;
    for (int i = 0; i <= points; ++i) {
        const double a = 2 * M_PI * (i % points) / points + turn;
        places.push_back({radius * std::cos(a), radius * std::sin(a), z});
    }
    return places;
}

/// What a cut by lines that bound something must look like.
void separates(const Grown& grown, uint32_t components = 2) {
    CHECK(grown.count() == components);
    CHECK(grown.cut.gaps.empty());
    CHECK(grown.cut.offSurface.empty());
}

}  // namespace

TEST_CASE("a closed curve around a ball parts it in two") {
    for (const int points : {3, 4, 7, 24}) {
        CAPTURE(points);
        separates(draw(ball(8, 12), {circle(1, 0, points)}));
        separates(draw(ball(8, 12), {circle(0.8, 0.6, points, 0.3)}));
        separates(draw(ball(3, 4), {circle(1, 0.1, points, 0.1)}));
    }
}

TEST_CASE("a curve around a torus alone parts nothing, two of a kind do") {
    const auto around = [](double z, double radius) { return circle(radius, z, 12); };
    const auto tubeRing = [](double angle) {
        Places places;
        for (int i = 0; i <= 8; ++i) {
            const double b = 2 * M_PI * (i % 8) / 8 + 0.1;
            const double r = 1 + 0.4 * std::cos(b);
            places.push_back({r * std::cos(angle), r * std::sin(angle), 0.4 * std::sin(b)});
        }
        return places;
    };
    const SurfaceMesh mesh = torus(16, 8);
    separates(draw(mesh, {around(0, 1.4)}), 1);
    separates(draw(mesh, {tubeRing(0.2)}), 1);
    separates(draw(mesh, {around(0, 1.4), around(0, 0.6)}), 2);
    separates(draw(mesh, {tubeRing(0.2), tubeRing(2.5)}), 2);
    separates(draw(mesh, {tubeRing(0.2), around(0, 1.4)}), 1);
    separates(draw(mesh, {tubeRing(0.2), tubeRing(2.5), around(0, 1.4)}), 2);
}

TEST_CASE("curves on a cube: over edges, through vertices, along edges and within one triangle") {
    const SurfaceMesh mesh = chartedCube();
    // Around four sides, places in faces.
    separates(
        draw(mesh, {{{1, 0.3, 0.4}, {0.3, 1, 0.4}, {0, 0.6, 0.4}, {0.6, 0, 0.4}, {1, 0.3, 0.4}}}));
    // The same with its places on edges.
    separates(draw(mesh, {{{1, 1, 0.5}, {0, 1, 0.5}, {0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}}}));
    // From vertex to vertex along edges; across faces by both diagonals.
    separates(draw(mesh, {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}}));
    separates(draw(mesh, {{{0, 0, 0}, {1, 1, 0}, {1, 1, 1}, {0, 0, 1}, {0, 0, 0}}}));
    separates(draw(mesh, {{{1, 0, 0}, {0, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 0, 0}}}));
    separates(draw(mesh, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}));
    // All in one triangle, one of them on a corner, and around one vertex.
    separates(draw(mesh, {{{1, 0.6, 0.1}, {1, 0.9, 0.1}, {1, 0.9, 0.4}, {1, 0.6, 0.1}}}));
    separates(draw(mesh, {{{1, 0, 0}, {1, 0.9, 0.1}, {1, 0.9, 0.4}, {1, 0, 0}}}));
    separates(draw(mesh, {{{1, 0.7, 1}, {0.7, 1, 1}, {1, 1, 0.7}, {1, 0.7, 1}}}));
    // The same place twice, and a line there and back, part nothing.
    separates(draw(mesh, {{{1, 0.5, 0.5}, {1, 0.5, 0.5}}}), 1);
    separates(draw(mesh, {{{1, 0.5, 0.5}, {0.5, 1, 0.5}, {1, 0.5, 0.5}}}), 1);
}

TEST_CASE("a path over a fine cube from face to face crosses edges and vertices exactly") {
    for (const int cells : {2, 4, 8}) {
        const SurfaceMesh mesh = chartedCube(1, cells);
        separates(draw(
            mesh, {{{1, 0.5, 0.5}, {0.5, 1, 0.5}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {1, 0.5, 0.5}}}));
        separates(draw(
            mesh, {{{1, 0.1, 0.2}, {0.2, 1, 0.7}, {0, 0.3, 0.1}, {0.6, 0, 0.9}, {1, 0.1, 0.2}}}));
    }
}

TEST_CASE("two curves that cross meet in branch points") {
    // Great circles of a ball: four quarters.
    const Places flat = circle(1, 0, 6, 0.2);
    Places upright;
    for (const glm::dvec3& p : flat) upright.push_back({p.x, p.z, p.y});
    separates(draw(ball(8, 12), {flat, upright}), 4);
    Places third;
    for (const glm::dvec3& p : flat) third.push_back({p.z, p.x, p.y});
    separates(draw(ball(8, 12), {flat, upright, third}), 8);
    // A figure of eight crosses itself: two loops and the rest.
    const SurfaceMesh mesh = chartedCube(1, 3);
    separates(
        draw(mesh, {{{1, 0.2, 0.2}, {1, 0.8, 0.7}, {1, 0.8, 0.2}, {1, 0.2, 0.7}, {1, 0.2, 0.2}}}),
        3);
}

TEST_CASE("a place off the surface is left out and reported, not a number too") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    const SurfaceMesh mesh = chartedCube(1, 2);
    for (const glm::dvec3& bad : {glm::dvec3(1, 0.5, 9), glm::dvec3(nan, 0, 0),
                                  glm::dvec3(0, inf, 0), glm::dvec3(1e300, 0, 0)}) {
        const Grown grown =
            draw(mesh, {{{1, 0.2, 0.2}, {1, 0.4, 0.3}, bad, {1, 0.8, 0.8}, {1, 0.6, 0.7}}}, 0.1);
        CHECK(grown.count() == 1);
        CHECK(grown.cut.offSurface.size() == 1);
    }
    // Whatever the reach: what is no place is never on the surface.
    CHECK(draw(mesh, {{{1, 0.2, 0.2}, {nan, nan, nan}}}).cut.offSurface.size() == 1);
    FracturePlan uv = over({{{1, 0.2, 0.2}, {1, 0.4, 0.3}}});
    uv.drawings[0].map.surfaceLines[0].places.push_back({false, {0.22, 0.1, 0}});  // between charts
    uv.drawings[0].map.surfaceLines[0].places.push_back({false, {nan, 0.1, 0}});
    uv.drawings[0].map.surfaceLines[0].places.push_back({false, {1e9, 0.1, 0}});
    CHECK(grow(mesh, uv).cut.offSurface.size() == 3);
}

TEST_CASE("places in UV and in 3D mix in one line") {
    FracturePlan plan = over({{{1, 0.3, 0.4}}});
    auto& places = plan.drawings[0].map.surfaceLines[0].places;
    const auto uv = [&](int face, double s, double t) {
        places.push_back({false, glm::dvec3(cubeUv(face, s, t), 0)});
    };
    uv(2, 0.4, 0.3);  // +y: s along z, t along x
    uv(1, 0.6, 0.4);  // -x: s along y, t along z
    uv(3, 0.4, 0.6);
    places.push_back({true, {1, 0.3, 0.4}});
    separates(grow(chartedCube(1, 2), plan));
}

TEST_CASE("places on different parts leave a gap that is reported") {
    const SurfaceMesh cube = chartedCube(1, 2);
    const SurfaceMesh mesh = together({cube, moved(cube, {3, 0, 0})});
    const Grown grown = draw(mesh, {{{1, 0.5, 0.5}, {3, 0.5, 0.5}}});
    CHECK(grown.cut.gaps.size() == 1);
    CHECK(grown.count() == 2);
}

TEST_CASE("where no plane leads the line follows edges, and says so") {
    // From one arm of a U to the other, tip to tip: the plane through both cuts each arm apart.
    const SurfaceMesh mesh = voxels(3, 3, 1, [](int x, int y, int) { return x != 1 || y == 0; });
    const Grown grown = draw(mesh, {{{0.5, 2.5, 1}, {2.5, 2.5, 1}}});
    CHECK(grown.cut.alongEdges.size() == 1);
    CHECK(grown.cut.gaps.empty());
    // Right opposite along the normals there is no plane at all.
    const Grown through = draw(chartedCube(1, 2), {{{0, 0.3, 0.4}, {1, 0.3, 0.4}}});
    CHECK(through.cut.gaps.empty());
    CHECK(through.cut.alongEdges.size() == 1);
}

TEST_CASE(
    "a curve around a plate goes over its rim from one side to the other, though normals cancel") {
    const SurfaceMesh plate = thinPlate();  // 4 x 3 x 0.05
    const Grown grown = draw(plate, {{{1, -0.01, 0.025},
                                      {1.2, 1.5, 0.05},
                                      {1, 3.01, 0.025},
                                      {1.1, 1.4, 0},
                                      {1, -0.01, 0.025}}});
    separates(grown);
    CHECK(grown.cut.alongEdges.empty());
    // Straight from the front to the back, twice.
    const Grown across = draw(
        plate, {{{1, 0.5, 0.05}, {1.2, 0.3, 0}, {1.5, 2.5, 0}, {1.3, 2.6, 0.05}, {1, 0.5, 0.05}}});
    separates(across);
    CHECK(across.cut.alongEdges.empty());
}

TEST_CASE("an open sheet: lines from border to border part it, along the border they do not") {
    const SurfaceMesh sheet = flatSquare(4);
    separates(draw(sheet, {{{0, 0.3, 0}, {1, 0.6, 0}}}));
    separates(draw(sheet, {{{0, 0, 0}, {1, 1, 0}}}));
    separates(draw(sheet, {{{0, 0, 0}, {1, 0, 0}}}), 1);
    separates(draw(sheet, {{{0.3, 0.3, 0}, {0.6, 0.6, 0}}}), 1);
    // A place beyond the border lands on it.
    separates(draw(sheet, {{{-0.01, 0.3, 0}, {1.01, 0.6, 0}}}, 0.1));
}

TEST_CASE("lines over needles and degenerate triangles crash nothing") {
    MeshMaker maker;
    maker.triangle({{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{2, 0, 0}, {0, 1}});
    maker.triangle({{0, 0, 0}, {0, 0}}, {{2, 0, 0}, {1, 0}}, {{1, 1, 0}, {0, 1}});
    maker.triangle({{0, 0, 0}, {0, 0}}, {{0, 0, 0}, {1, 0}}, {{1, 1, 0}, {0, 1}});
    const SurfaceMesh mesh = maker.mesh();
    CHECK(draw(mesh, {{{0.5, 0, 0}, {1, 0.5, 0}}, {{0, 0, 0}, {1, 1, 0}}, {{2, 0, 0}, {1, 0, 0}}})
              .count() >= 1);
    SurfaceMesh flat = chartedCube();
    for (auto& t : flat.triangles) t[1] = t[0];
    CHECK(draw(flat, {{{0, 0, 0}, {1, 1, 1}}}).cut.offSurface.size() == 2);
    CHECK(draw(chartedCube(), {{}, {{1, 0.5, 0.5}}}).count() == 1);
}

TEST_CASE("paths are the same at any power of two of the size") {
    const auto at = [](double scale) {
        Places places = circle(scale, 0.1 * scale, 7, 0.3);
        return draw(moved(ball(8, 12), glm::vec3(0.0F), static_cast<float>(scale)), {places});
    };
    const Grown one = at(1);
    for (const double scale : {0x1p-20, 1024.0}) {
        const Grown other = at(scale);
        CHECK(vertexTriangles(one.cut.surface) == vertexTriangles(other.cut.surface));
    }
    for (const double scale : {1e-6, 1e6}) separates(at(scale));
}

TEST_CASE("random closed curves on closed meshes keep the surface, simple ones part it") {
    const int cases = propertyCases(250);
    const std::vector<SurfaceMesh> meshes{chartedCube(1, 3), ball(6, 8), torus(12, 6), genusTwo(),
                                          thinPlate()};
    for (int i = 0; i < cases; ++i) {
        const auto seed = static_cast<uint32_t>(4000 + i);
        CAPTURE(seed);
        Random random(seed);
        const SurfaceMesh& mesh = meshes[random.below(5)];
        std::vector<Places> lines;
        for (uint32_t l = 1 + random.below(3); l > 0; --l) {
            Places& places = lines.emplace_back();
            for (uint32_t n = 2 + random.below(4); n > 0; --n) {
                const auto& v =
                    mesh.triangles[random.below(static_cast<uint32_t>(mesh.triangles.size()))];
                // In faces, on edges, at vertices.
                glm::dvec3 w(random.below(3) == 0 ? 0 : random.unit(),
                             random.below(3) == 0 ? 0 : random.unit(), 0.01 + random.unit());
                w /= w.x + w.y + w.z;
                places.push_back(glm::dvec3(mesh.positions[v[0]]) * w.x +
                                 glm::dvec3(mesh.positions[v[1]]) * w.y +
                                 glm::dvec3(mesh.positions[v[2]]) * w.z);
            }
            places.push_back(places[0]);
        }
        const Grown grown = draw(mesh, lines);
        CHECK(grown.cut.gaps.empty());
        CHECK(grown.cut.offSurface.empty());
        CHECK(grown.count() >= 1);
        // Planes lead on differently every time; along edges a line may go back as it came.
        const bool turnsBack =
            std::any_of(lines.begin(), lines.end(), [](const Places& p) { return p.size() < 4; });
        if (!turnsBack && grown.cut.alongEdges.empty()) CHECK(grown.cut.deadEnds.empty());
    }
}
