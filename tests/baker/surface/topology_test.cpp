// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>

#include "support/surface_meshes.h"
#include "surface/mesh_topology.h"
#include "surface/vertex_fans.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

void addTetrahedron(std::vector<glm::vec3>& positions, Triangles& triangles,
                    std::array<uint32_t, 4> v) {
    (void)positions;
    triangles.push_back({v[0], v[2], v[1]});
    triangles.push_back({v[0], v[1], v[3]});
    triangles.push_back({v[1], v[2], v[3]});
    triangles.push_back({v[2], v[0], v[3]});
}

}  // namespace

TEST_CASE("a triangle with a repeated vertex takes no part, so its neighbours meet each other") {
    const std::vector<glm::vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Triangles t;
    std::vector<glm::vec3> positions = p;
    addTetrahedron(positions, t, {0, 1, 2, 3});
    t.push_back({0, 1, 1});
    const MeshTopology topology = buildTopology(positions, t);
    CHECK(topology.degenerate[4] == 1);
    CHECK(topology.boundaryEdges == 0);
    CHECK(topology.nonManifoldEdges == 0);
    CHECK(topology.edges.size() == 6);
}

TEST_CASE("a cube's half edges all have opposites, an open square's border has none") {
    const SurfaceMesh cube = chartedCube(1, 2);
    const MeshTopology closed = buildTopology(cube.positions, cube.triangles);
    CHECK(closed.boundaryEdges == 0);
    for (uint32_t h = 0; h < closed.opposite.size(); ++h) {
        REQUIRE(closed.opposite[h] != kNone);
        CHECK(closed.opposite[closed.opposite[h]] == h);
    }
    const SurfaceMesh square = flatSquare(2);
    CHECK(buildTopology(square.positions, square.triangles).boundaryEdges == 8);
}

TEST_CASE("two solids that touch along an edge stay apart there") {
    // Both tetrahedra use the edge 0-1 once in each direction; they lie on opposite sides of it.
    const std::vector<glm::vec3> positions{{0, 0, 0},       {1, 0, 0},     {0.5F, 1, 0},
                                           {0.5F, 0.5F, 1}, {0.5F, -1, 0}, {0.5F, -0.5F, 1}};
    std::vector<glm::vec3> p = positions;
    Triangles t;
    addTetrahedron(p, t, {0, 1, 2, 3});
    addTetrahedron(p, t, {1, 0, 4, 5});
    const MeshTopology topology = buildTopology(positions, t);
    CHECK(topology.pinchedEdges == 1);
    CHECK(topology.boundaryEdges == 0);
    for (uint32_t h = 0; h < topology.opposite.size(); ++h) {
        REQUIRE(topology.opposite[h] != kNone);
        CHECK(h / 3 / 4 == topology.opposite[h] / 3 / 4);  // glued within its own tetrahedron
    }
}

TEST_CASE("solids that touch at a vertex get one each, a single solid keeps its own") {
    SurfaceMesh mesh = chartedCube();
    const uint32_t vertices = static_cast<uint32_t>(mesh.positions.size());
    CHECK(separateFans(buildTopology(mesh.positions, mesh.triangles), mesh) == 0);
    // A second cube from (1, 1, 1) on: it shares that corner with the first.
    for (size_t t = 0; t < 12; ++t) {
        std::array<uint32_t, 3> moved{};
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec3 p = mesh.positions[mesh.triangles[t][k]] + glm::vec3(1);
            const auto known = std::find(mesh.positions.begin(), mesh.positions.end(), p);
            moved[k] = static_cast<uint32_t>(known - mesh.positions.begin());
            if (known == mesh.positions.end()) mesh.positions.push_back(p);
        }
        mesh.triangles.push_back(moved);
    }
    REQUIRE(mesh.positions.size() == 2 * vertices - 1);
    CHECK(separateFans(buildTopology(mesh.positions, mesh.triangles), mesh) == 1);
    CHECK(mesh.positions.size() == 2 * vertices);
    CHECK(buildTopology(mesh.positions, mesh.triangles).boundaryEdges == 0);
}

TEST_CASE("an edge with three triangles is not manifold: two are glued, the third has a border") {
    const std::vector<glm::vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
    const Triangles t{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    const MeshTopology topology = buildTopology(p, t);
    CHECK(topology.nonManifoldEdges == 1);
    CHECK(topology.firstNonManifoldHalfEdge != kNone);
    uint32_t glued = 0;
    for (const uint32_t o : topology.opposite) glued += o != kNone ? 1 : 0;
    CHECK(glued == 2);
}
