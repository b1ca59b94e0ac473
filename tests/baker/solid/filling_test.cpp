// SPDX-License-Identifier: MIT
// Solids filled with tetrahedra that fit their surface, and shared out among pieces.
#include <map>
#include <numeric>

#include "geometry/closed_mesh.h"
#include "geometry/triangle.h"
#include "solid/fan_repair.h"
#include "solid/inside_labels.h"
#include "solid/skin_surface.h"
#include "solid/solid_bakes.h"
#include "solid/star_core.h"
#include "solid/tetra_complex.h"
#include "solid/wall_tightening.h"

using namespace sherd;
using namespace sherd::test;

namespace {

std::vector<glm::dvec3> latticeIn(const Shape& shape, int n) {
    Bounds bounds;
    for (const glm::vec3& p : shape.positions) bounds.add(p);
    std::vector<glm::dvec3> sites;
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const glm::dvec3 at(x + 0.31 + 0.1 * ((y + z) % 3), y + 0.47 + 0.1 * (x % 2),
                                    z + 0.53 - 0.1 * (x % 3));
                sites.push_back(bounds.low + bounds.size() * at / double(n));
            }
    return sites;
}

double sixVolumes(const TetraComplex& complex, const TetraComplex::Tetra& tetra) {
    std::array<glm::dvec3, 4> p;
    for (size_t k = 0; k < 4; ++k) p[k] = complex.positions[tetra.v[k]];
    return glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[0] - p[3]);
}

/// Empty if the tetrahedra fill the shape: they add up to it, every face inside is two
/// tetrahedra's, in opposite directions, and every other one is the skin's.
std::string whatIsWrong(const TetraComplex& complex, const Shape& shape) {
    double sum = 0;
    std::map<std::array<uint32_t, 3>, int> faces;  // ascending; their turns added up
    std::map<std::array<uint32_t, 3>, int> uses;
    for (const TetraComplex::Tetra& tetra : complex.tetras) {
        sum += sixVolumes(complex, tetra) / 6;
        for (const auto& face : kTetraFaces) {
            std::array<uint32_t, 3> v{tetra.v[face[0]], tetra.v[face[1]], tetra.v[face[2]]};
            int turn = 1;
            for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
                if (v[size_t(i)] <= v[size_t(j)]) continue;
                std::swap(v[size_t(i)], v[size_t(j)]);
                turn = -turn;
            }
            faces[v] += turn;
            ++uses[v];
        }
    }
    const double volume = signedVolume(shape.positions, shape.triangles, glm::dvec3(0.0));
    if (std::abs(sum - volume) > 1e-6 * volume) return "volume";
    size_t skin = 0;
    for (const auto& [v, turns] : faces) {
        if (turns == 0) continue;
        ++skin;
        for (const uint32_t vertex : v)
            if (!complex.onSkin(vertex)) return "open inside";
    }
    return skin == complex.skin.triangles.size() ? "" : "skin";
}

SplitSurface surfaceOf(const Shape& shape) {
    return uncutSurface(shape.mesh());
}

/// Four tetrahedra around one edge, each a lump of its own, all else skin.
TetraComplex ringOfFour() {
    TetraComplex complex;
    complex.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    for (uint32_t i = 0; i < 4; ++i) {
        TetraComplex::Tetra tetra;
        // Corners: the edge's two ends, and two places around it.
        tetra.v = {0, 1, 2 + i, 2 + (i + 1) % 4};
        tetra.across = {kNone, kNone, (i + 1) % 4, (i + 3) % 4};
        complex.tetras.push_back(tetra);
    }
    complex.star.assign(4, 1);
    return complex;
}

Components twoPieces() {
    Components pieces;
    pieces.levels = 1;
    pieces.leafCount = 2;
    pieces.ofLeaf = {{0, 1}};
    pieces.count = {2};
    return pieces;
}

}  // namespace

TEST_CASE("a tetrahedron has the least of its heights, negative when it is turned over") {
    const glm::dvec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    CHECK(leastHeight(a, b, c, {0, 0, -1}) == doctest::Approx(1 / std::sqrt(3)));
    CHECK(leastHeight(a, b, c, {0.1, 0.1, -0.001}) == doctest::Approx(0.001).epsilon(0.01));
    CHECK(leastHeight(a, b, c, {0.1, 0.1, 0.001}) == doctest::Approx(-0.001).epsilon(0.01));
    CHECK(leastHeight(a, b, c, {0.5, 0.5, 0}) == 0);
    CHECK(leastHeight(a, a, a, a) == 0);
}

TEST_CASE("the core of an L sees all of it, from the square in its corner") {
    // An extruded L: what sees all of it is the square where its legs meet.
    const std::vector<glm::dvec2> outline = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
    std::vector<glm::vec3> positions;
    for (const float z : {0.0F, 1.0F})
        for (const glm::dvec2& p : outline) positions.emplace_back(p.x, p.y, z);
    std::vector<std::array<uint32_t, 3>> triangles;
    for (const auto& [a, b, c] :
         std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
        triangles.push_back({c, b, a});
        triangles.push_back({a + 6, b + 6, c + 6});
    }
    for (uint32_t k = 0; k < 6; ++k) {
        const uint32_t n = (k + 1) % 6;
        triangles.push_back({k, n, n + 6});
        triangles.push_back({k, n + 6, k + 6});
    }
    const glm::dvec3 core = starCore(positions, triangles, 1e-6);
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(core[axis] > 0.2);
        CHECK(core[axis] < 0.8);
    }
}

TEST_CASE("tetrahedra fill solids of every shape exactly, and none is turned over") {
    Shape hollow = box({0, 0, 0}, {1, 1, 1}, 3);
    Shape inner = box({0.2F, 0.2F, 0.2F}, {0.8F, 0.8F, 0.8F}, 2);
    for (auto& t : inner.triangles) std::swap(t[0], t[1]);
    hollow.append(inner);
    for (const Shape& shape : {box({0, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {2, 1, 0.02F}, 3), hollow,
                               torusShape(1, 0.3F, 24, 10), sphere({0, 0, 0}, {1, 1, 1}, 8)}) {
        const auto complex = fillWithTetras(surfaceOf(shape), latticeIn(shape, 5));
        REQUIRE(complex.has_value());
        CHECK(whatIsWrong(*complex, shape) == "");
        for (const TetraComplex::Tetra& tetra : complex->tetras) {
            std::array<glm::dvec3, 4> p;
            for (size_t k = 0; k < 4; ++k) p[k] = complex->positions[tetra.v[k]];
            if (complex->star[tetra.lump] != 0)
                CHECK(leastHeight(p[0], p[1], p[2], p[3]) >= -complex->rounding);
        }
    }
}

TEST_CASE("what checks that they fill it finds one that is missing or out of place") {
    const Shape shape = box({0, 0, 0}, {1, 1, 1}, 2);
    auto complex = fillWithTetras(surfaceOf(shape), latticeIn(shape, 3));
    REQUIRE(complex.has_value());
    const auto inside = std::find_if(complex->tetras.begin(), complex->tetras.end(),
                                     [](const auto& tetra) { return tetra.skin == kNone; });
    REQUIRE(inside != complex->tetras.end());
    TetraComplex broken = *complex;
    std::swap(broken.tetras[size_t(inside - complex->tetras.begin())].v[0],
              broken.tetras[size_t(inside - complex->tetras.begin())].v[1]);
    CHECK(whatIsWrong(broken, shape) != "");
    complex->tetras.erase(inside);
    CHECK(whatIsWrong(*complex, shape) != "");
}

TEST_CASE("an open surface is not filled") {
    Shape open = box({0, 0, 0}, {1, 1, 1}, 2);
    open.triangles.pop_back();
    CHECK_FALSE(fillWithTetras(surfaceOf(open), latticeIn(open, 3)).has_value());
}

TEST_CASE("pieces that meet in a chequered edge are told apart there") {
    const TetraComplex complex = ringOfFour();
    std::vector<uint32_t> piece = {0, 1, 0, 1};
    SUBCASE("by giving a part to a neighbour") {
        const std::vector<uint8_t> fixed = {1, 1, 1, 0};
        CHECK(FanRepair(complex, twoPieces(), fixed, piece).run() == 0);
        CHECK(piece == std::vector<uint32_t>{0, 1, 0, 0});
    }
    SUBCASE("unless all of them lie at the skin: then that is said") {
        const std::vector<uint8_t> fixed(4, 1);
        CHECK(FanRepair(complex, twoPieces(), fixed, piece).run() == 1);
        CHECK(piece == std::vector<uint32_t>{0, 1, 0, 1});
    }
}

TEST_CASE(
    "everything inside goes to a piece it hangs together with, and drawing walls tight "
    "keeps the solid filled") {
    const Shape shape = torusShape(1, 0.35F, 32, 12);
    const SplitSurface surface = surfaceOf(shape);
    auto complex = fillWithTetras(surface, latticeIn(shape, 7));
    REQUIRE(complex.has_value());
    Components halves = twoPieces();
    for (uint32_t t = 0; t < surface.triangles.size(); ++t)
        halves.leaf.push_back(centroidOf(surface, t).x > 0 ? 1 : 0);
    const InsideLabels labels = labelInside(*complex, surface, halves);
    CHECK(labels.pinchedEdges == 0);
    CHECK(std::count(labels.broken.begin(), labels.broken.end(), 1) == 0);
    for (uint32_t t = 0; t < complex->tetras.size(); ++t) {
        REQUIRE(labels.piece[t] < 2);
        const uint32_t skin = complex->tetras[t].skin;
        if (skin != kNone)
            CHECK(labels.piece[t] == halves.leaf[complex->skin.triangles[skin].parent]);
    }
    const auto share = [&] {
        double sum = 0;
        for (uint32_t t = 0; t < complex->tetras.size(); ++t)
            if (labels.piece[t] == 1) sum += sixVolumes(*complex, complex->tetras[t]) / 6;
        return sum / signedVolume(shape.positions, shape.triangles, glm::dvec3(0.0));
    };
    CHECK(share() == doctest::Approx(0.5).epsilon(0.05));
    tightenWalls(labels, *complex);
    CHECK(whatIsWrong(*complex, shape) == "");
    CHECK(share() == doctest::Approx(0.5).epsilon(0.02));
}

TEST_CASE("edges are divided where walls end, alike for both of their triangles") {
    const Shape shape = box({0, 0, 0}, {1, 1, 1}, 1);
    const SplitSurface surface = surfaceOf(shape);
    const auto complex = fillWithTetras(surface, latticeIn(shape, 4));
    REQUIRE(complex.has_value());
    const CutSkin& skin = complex->skin;
    for (const uint8_t all : {0, 1}) {
        const std::vector<uint8_t> wanted(skin.positions.size(), all);
        const DividedSurface divided = divideEdges(surface, skin, wanted);
        CHECK((divided.surface.triangles.size() > 12) == (all == 1));
        const MeshTopology topology =
            buildTopology(divided.surface.positions, vertexTriangles(divided.surface));
        CHECK(topology.boundaryEdges == 0);
        CHECK(topology.nonManifoldEdges + topology.pinchedEdges == 0);
        std::vector<double> area(12, 0);
        for (uint32_t t = 0; t < divided.surface.triangles.size(); ++t) {
            area[divided.parent[t]] +=
                triangleArea(divided.surface.positions, divided.surface.triangles[t].v);
            for (const uint32_t v : divided.surface.triangles[t].v) {
                const VertexOrigin& origin = divided.surface.origins[v];
                glm::dvec3 place(0.0);
                for (int k = 0; k < 3; ++k)
                    place += origin.weights[k] *
                             glm::dvec3(surface.positions[origin.vertices[size_t(k)]]);
                CHECK(glm::distance(place, glm::dvec3(divided.surface.positions[v])) < 1e-6);
            }
        }
        for (const double a : area) CHECK(a == doctest::Approx(0.5));
    }
}
