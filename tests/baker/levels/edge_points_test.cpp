// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "levels/edge_points.h"

using namespace sherd;

namespace {

std::vector<uint32_t> between(const EdgePoints& edges, uint32_t from, uint32_t to) {
    std::vector<uint32_t> vertices;
    for (const EdgePoints::Point& p : edges.between(from, to).points) vertices.push_back(p.vertex);
    return vertices;
}

/// Vertex v lies at v on the x axis.
glm::dvec3 onAxis(uint32_t v) {
    return {v, 0, 0};
}

}  // namespace

TEST_CASE("what two pieces found on one edge lies on it in order, whichever way it is walked") {
    EdgePoints edges;
    const uint32_t edge = edges.findOrAdd(9, 4);
    CHECK(edges.findOrAdd(4, 9) == edge);
    for (const auto& [share, vertex] : {std::pair(0.75, 20U), {0.25, 21U}, {0.5, 22U}})
        edges.add(edge, share, vertex);
    edges.add(edge, 0.9, 22);  // already there
    edges.add(edge, 0, 4);     // an end
    edges.join(onAxis);
    CHECK(between(edges, 4, 9) == std::vector<uint32_t>{21, 22, 20});
    CHECK(between(edges, 9, 4) == std::vector<uint32_t>{20, 22, 21});
    CHECK(between(edges, 4, 20) == std::vector<uint32_t>{21, 22});
    CHECK(between(edges, 20, 21) == std::vector<uint32_t>{22});
    CHECK(between(edges, 21, 22).empty());
    CHECK(edges.between(4, 20).to == 0.75);
}

TEST_CASE("vertices that share no edge have nothing between them") {
    EdgePoints edges;
    edges.add(edges.findOrAdd(1, 2), 0.5, 10);
    edges.add(edges.findOrAdd(2, 3), 0.5, 11);
    edges.join(onAxis);
    CHECK(between(edges, 1, 3).empty());
    CHECK(between(edges, 10, 11).empty());
    CHECK(between(edges, 7, 7).empty());
    CHECK(between(edges, 1, 2) == std::vector<uint32_t>{10});
}

TEST_CASE("edges that lie on each other are one line, so that ways along them add up") {
    EdgePoints edges;
    edges.add(edges.findOrAdd(0, 60), 0.5, 30);
    edges.add(edges.findOrAdd(0, 60), 1.0 / 3, 20);
    edges.add(edges.findOrAdd(20, 90), 1.0 / 7, 30);
    edges.add(edges.findOrAdd(20, 90), 5.0 / 7, 70);
    edges.add(edges.findOrAdd(70, 80), 0.5, 75);  // shares one vertex: a line of its own
    edges.join(onAxis);
    CHECK(between(edges, 0, 90) == std::vector<uint32_t>{20, 30, 60, 70});
    CHECK(between(edges, 0, 60) == std::vector<uint32_t>{20, 30});
    CHECK(between(edges, 90, 20) == std::vector<uint32_t>{70, 60, 30});
    CHECK(between(edges, 70, 80) == std::vector<uint32_t>{75});
}
