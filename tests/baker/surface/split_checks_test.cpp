// SPDX-License-Identifier: MIT
// The checkers of the property tests find what they are there to find.
#include <doctest/doctest.h>

#include "cutting.h"
#include "split_checks.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// A torus with a line through many triangles, a loop inside one and a line of a second level.
struct Checked {
    SurfaceMesh mesh = torus(5, 5);
    FractureMap map = linesOf({{{-0.01, 0.31}, {0.4, 0.33}, {1.01, 0.31}},
                               {{0.05, 0.02}, {0.08, 0.02}, {0.08, 0.04}, {0.05, 0.02}}});
    CutSurface cut;
    Components components;

    Checked() {
        map.lines.push_back({{{0.03, -0.01}, {0.03, 1.01}}, 2, "test"});
        const MeshTopology before = buildTopology(mesh.positions, mesh.triangles);
        cut = *cutSurface(mesh, before, planOf(map), exactOptions());
        fill();
    }
    void fill() { components = floodFill(cut.surface, cut.topology, cut.lines, 2); }
    CutOracle oracle() const {
        CutOracle result(mesh, map);
        result.findComponents();
        return result;
    }
    std::string geometry() const {
        uint32_t undecided = 0;
        return brokenGeometry(mesh, cut, oracle(), undecided);
    }
    std::string partition() const {
        uint32_t samples = 0;
        return brokenPartition(mesh, cut, components, oracle(), samples);
    }
    /// A triangle and its edge on the loop.
    std::pair<uint32_t, uint32_t> markedEdge() const {
        for (uint32_t t = 0; t < cut.surface.triangles.size(); ++t) {
            for (uint32_t k = 0; k < 3; ++k) {
                if (cut.surface.triangles[t].line[k] == 2) return {t, k};
            }
        }
        return {0, 0};
    }
    void setMark(uint32_t t, uint32_t k, uint32_t mark) {
        const uint32_t o = cut.topology.opposite[3 * t + k];
        cut.surface.triangles[t].line[k] = mark;
        cut.surface.triangles[o / 3].line[o % 3] = mark;
    }
};

uint32_t firstEdgePoint(const CutSurface& cut) {
    return cut.surface.meshVertices;
}

}  // namespace

TEST_CASE("an unspoilt cut passes every check") {
    const Checked c;
    CHECK(brokenConformity(c.mesh, c.cut) == "");
    CHECK(brokenArea(c.mesh, c.cut) == "");
    CHECK(brokenPlaces(c.mesh, c.cut) == "");
    CHECK(brokenMarks(c.cut) == "");
    CHECK(brokenComponents(c.cut, c.components) == "");
    CHECK(c.geometry() == "");
    CHECK(c.partition() == "");
    CHECK(c.components.count == std::vector<uint32_t>{2, 2});
}

TEST_CASE("a T-junction and a lost triangle are found") {
    Checked c;
    SUBCASE("one side of a split edge has a vertex of its own there") {
        const uint32_t v = firstEdgePoint(c.cut);
        const auto copy = static_cast<uint32_t>(c.cut.surface.positions.size());
        c.cut.surface.positions.push_back(glm::vec3(c.cut.surface.positions[v]));
        c.cut.surface.origins.push_back(VertexOrigin(c.cut.surface.origins[v]));
        uint32_t source = 0xFFFFFFFFU;
        for (SplitTriangle& t : c.cut.surface.triangles) {
            for (uint32_t& corner : t.v) {
                if (corner != v || (source != 0xFFFFFFFFU && t.source != source)) continue;
                source = t.source;
                corner = copy;
            }
        }
    }
    SUBCASE("a piece is missing") {
        c.cut.surface.triangles.erase(c.cut.surface.triangles.begin() + 3);
        CHECK(brokenArea(c.mesh, c.cut) != "");
    }
    c.cut.topology = buildTopology(c.cut.surface.positions, vertexTriangles(c.cut.surface));
    CHECK(brokenConformity(c.mesh, c.cut) != "");
}

TEST_CASE("a topology that is not the surface's is found") {
    Checked c;
    ++c.cut.topology.boundaryEdges;
    CHECK(brokenConformity(c.mesh, c.cut) != "");
}

TEST_CASE("vertices out of place are found") {
    Checked c;
    const uint32_t v = firstEdgePoint(c.cut);
    VertexOrigin& origin = c.cut.surface.origins[v];
    SUBCASE("moved") {
        c.cut.surface.positions[v] += 1e-4F;
        CHECK(brokenPlaces(c.mesh, c.cut) != "");
        CHECK(brokenArea(c.mesh, c.cut) != "");
    }
    SUBCASE("a vertex of the mesh moved by one bit") {
        float& x = c.cut.surface.positions[0].x;
        x = std::nextafter(x, 10.0F);
        CHECK(brokenPlaces(c.mesh, c.cut) != "");
    }
    SUBCASE("a negative weight") {
        origin.weights = {-0.1, 1.1, 0};
        CHECK(brokenPlaces(c.mesh, c.cut) != "");
    }
    SUBCASE("in another triangle") {
        origin.vertices = {0, 12, 12};
        origin.weights = {0.5, 0.5, 0};
        const glm::dvec3 a = c.mesh.positions[0];
        const glm::dvec3 b = c.mesh.positions[12];
        c.cut.surface.positions[v] = 0.5 * (a + b);
        CHECK(brokenPlaces(c.mesh, c.cut) != "");
    }
    SUBCASE("a little further along its edge") {
        origin.weights += glm::dvec3(1e-9, -1e-9, 0);
        CHECK(c.geometry() != "");
    }
}

TEST_CASE("a triangle turned over in UV is found, however well its edges match") {
    // Two pieces with a common inner edge take the other diagonal of a quad that is not convex.
    Checked c;
    const auto& triangles = c.cut.surface.triangles;
    bool found = false;
    for (uint32_t h = 0; h < 3 * triangles.size() && !found; ++h) {
        const uint32_t o = c.cut.topology.opposite[h];
        SplitTriangle s = triangles[h / 3];
        SplitTriangle t = triangles[o / 3];
        if (s.source != t.source || s.line[h % 3] != 0) continue;
        const uint32_t a = s.v[h % 3], b = s.v[(h % 3 + 1) % 3];
        const uint32_t p = s.v[(h % 3 + 2) % 3], q = t.v[(o % 3 + 2) % 3];
        Checked other = c;
        other.cut.surface.triangles[h / 3] = {
            {p, a, q}, s.source, {s.line[(h % 3 + 2) % 3], t.line[(o % 3 + 1) % 3], 0}};
        other.cut.surface.triangles[o / 3] = {
            {q, b, p}, s.source, {t.line[(o % 3 + 2) % 3], s.line[(h % 3 + 1) % 3], 0}};
        found = other.geometry().find("turned over") != std::string::npos;
        if (found) CHECK(brokenConformity(other.mesh, other.cut) == "");
    }
    CHECK(found);
}

TEST_CASE("marks that are missing, wrong, too many or on one side only are found") {
    Checked c;
    const auto [t, k] = c.markedEdge();
    SUBCASE("on one side only") {
        c.cut.surface.triangles[t].line[k] = 0;
        CHECK(brokenMarks(c.cut) != "");
    }
    SUBCASE("missing") {
        c.setMark(t, k, 0);
        CHECK(brokenMarks(c.cut) == "");
        CHECK(c.geometry() != "");
    }
    SUBCASE("of another level") {
        c.setMark(t, k, c.cut.lines.size());
        CHECK(c.geometry() != "");
    }
    SUBCASE("where no line lies") {
        c.setMark(t, (k + 1) % 3, 1);
        CHECK(c.geometry() != "");
    }
    SUBCASE("of no line") {
        c.setMark(t, k, 99);
        CHECK(brokenMarks(c.cut) != "");
    }
}

TEST_CASE("components that leak, split or do not nest are found") {
    Checked c;
    SUBCASE("a leak") {
        const auto [t, k] = c.markedEdge();
        c.setMark(t, k, 0);
        CHECK(brokenComponents(c.cut, c.components) != "");
        c.fill();
        CHECK(brokenComponents(c.cut, c.components) == "");
        CHECK(c.partition() == "another number of components");
    }
    SUBCASE("one triangle in another component") {
        uint32_t& leaf = c.components.leaf[5];
        leaf = leaf == 0 ? 1 : 0;
        CHECK(brokenComponents(c.cut, c.components) != "");
        CHECK(c.partition() != "");
    }
    SUBCASE("the right number of the wrong components") {
        c.components.leaf.assign(c.components.leaf.size(), 0);
        CHECK(c.partition() != "");
    }
    SUBCASE("levels that cross") {
        std::swap(c.components.ofLeaf[0][0], c.components.ofLeaf[0][1]);
        std::reverse(c.components.ofLeaf[1].begin(), c.components.ofLeaf[1].end());
        c.components.ofLeaf[1][0] = c.components.ofLeaf[1][1];
        CHECK(brokenComponents(c.cut, c.components) != "");
    }
}

TEST_CASE("the exact reference counts what can be counted by hand") {
    const SurfaceMesh square = flatSquare(2);
    const auto counts = [&](const FractureMap& map) {
        CutOracle oracle(square, map);
        oracle.findComponents();
        return oracle.counts;
    };
    CHECK(counts(linesOf({{{-0.1, 0.41}, {1.1, 0.47}}})) == std::vector<uint32_t>{2});
    CHECK(counts(linesOf({{{-0.1, 0.41}, {0.7, 0.47}}})) == std::vector<uint32_t>{1});
    CHECK(counts(linesOf({{{0.5, -0.1}, {0.5, 1.1}}, {{0, 0.5}, {1, 0.5}}})) ==
          std::vector<uint32_t>{4});
    CHECK(counts(linesOf({{{0.6, 0.2}, {0.7, 0.2}, {0.7, 0.3}, {0.6, 0.2}},
                          {{0.65, 0.21}, {0.66, 0.21}, {0.66, 0.22}, {0.65, 0.21}}})) ==
          std::vector<uint32_t>{3});
    CHECK(counts(linesOf({{{0, 0.3}, {1, 0.7}}, {{0.3, 0}, {0.7, 1}}, {{0, 0.9}, {1, 0.1}}})) ==
          std::vector<uint32_t>{6});
    FractureMap map = linesOf({{{-0.1, 0.41}, {1.1, 0.43}}});
    map.lines.push_back({{{0.52, -0.1}, {0.57, 1.1}}, 7, "test"});
    CHECK(counts(map) == std::vector<uint32_t>{2, 4});
}
