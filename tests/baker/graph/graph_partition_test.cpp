// SPDX-License-Identifier: MIT
#include "graph/graph_partition.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Edges = std::vector<WeightedGraph::Edge>;

WeightedGraph gridGraph(uint32_t nx, uint32_t ny, uint32_t nz = 1) {
    std::vector<glm::dvec3> places;
    Edges edges;
    const auto at = [&](uint32_t x, uint32_t y, uint32_t z) { return x + nx * (y + ny * z); };
    for (uint32_t z = 0; z < nz; ++z) {
        for (uint32_t y = 0; y < ny; ++y) {
            for (uint32_t x = 0; x < nx; ++x) {
                places.emplace_back(x, y, z);
                if (x + 1 < nx) edges.push_back({at(x, y, z), at(x + 1, y, z), 1});
                if (y + 1 < ny) edges.push_back({at(x, y, z), at(x, y + 1, z), 1});
                if (z + 1 < nz) edges.push_back({at(x, y, z), at(x, y, z + 1), 1});
            }
        }
    }
    std::vector<double> weights(places.size(), 1);
    return {std::move(weights), std::move(places), edges};
}

WeightedGraph pathGraph(uint32_t n) {
    return gridGraph(n, 1);
}

/// Of the nodes of one part: how many pieces they are in. By a search of its own.
uint32_t piecesOf(const WeightedGraph& graph, const std::vector<uint32_t>& part, uint32_t p) {
    std::vector<uint32_t> open;
    std::vector<bool> met(graph.count(), false);
    uint32_t pieces = 0;
    for (uint32_t first = 0; first < graph.count(); ++first) {
        if (part[first] != p || met[first]) continue;
        ++pieces;
        open.push_back(first);
        met[first] = true;
        while (!open.empty()) {
            const uint32_t n = open.back();
            open.pop_back();
            for (uint32_t m = 0; m < graph.count(); ++m) {
                const auto links = graph.links(n);
                const bool linked = std::any_of(links.begin(), links.end(),
                                                [m](const auto& link) { return link.node == m; });
                if (!linked || met[m] || part[m] != p) continue;
                met[m] = true;
                open.push_back(m);
            }
        }
    }
    return pieces;
}

std::vector<double> weightsOf(const WeightedGraph& graph, const GraphPartition& partition) {
    std::vector<double> sums(partition.parts, 0);
    for (uint32_t n = 0; n < graph.count(); ++n) sums[partition.part[n]] += graph.weight(n);
    return sums;
}

double cutOf(const WeightedGraph& graph, const GraphPartition& partition) {
    double cut = 0;
    for (uint32_t n = 0; n < graph.count(); ++n)
        for (const auto& link : graph.links(n))
            if (link.node > n && partition.part[link.node] != partition.part[n])
                cut += link.strength;
    return cut;
}

/// Every part is connected, none empty, numbered by their first nodes.
void checkParts(const WeightedGraph& graph, const GraphPartition& partition) {
    REQUIRE(partition.part.size() == graph.count());
    uint32_t next = 0;
    for (const uint32_t p : partition.part) {
        REQUIRE(p <= next);
        next = std::max(next, p + 1);
    }
    CHECK(next == partition.parts);
    for (uint32_t p = 0; p < partition.parts; ++p) CHECK(piecesOf(graph, partition.part, p) == 1);
}

}  // namespace

TEST_CASE("a graph without nodes has no parts") {
    const GraphPartition none = partitionGraph({{}, {}, {}}, {3});
    CHECK(none.parts == 0);
    CHECK(none.components == 0);
}

TEST_CASE("one part is all, as many parts as nodes are one each, and more there cannot be") {
    const WeightedGraph graph = gridGraph(3, 2);
    CHECK(partitionGraph(graph, {1}).part == std::vector<uint32_t>(6, 0));
    for (const uint32_t parts : {6U, 7U, 1000U}) {
        const GraphPartition all = partitionGraph(graph, {parts});
        CHECK(all.parts == 6);
        CHECK(all.part == std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
    }
}

TEST_CASE("a path is divided into stretches of equal length, give or take a node") {
    const WeightedGraph graph = pathGraph(24);
    for (const uint32_t parts : {2U, 3U, 4U, 6U, 8U, 12U}) {
        CAPTURE(parts);
        const GraphPartition partition = partitionGraph(graph, {parts});
        checkParts(graph, partition);
        CHECK(partition.parts == parts);
        for (const double weight : weightsOf(graph, partition))
            CHECK(std::abs(weight - 24.0 / parts) <= 1);
    }
}

TEST_CASE("of a star one part has the middle, and what others are is one node each") {
    Edges edges;
    std::vector<glm::dvec3> places{{0, 0, 0}};
    for (uint32_t n = 1; n <= 9; ++n) {
        edges.push_back({0, n, 1});
        places.emplace_back(std::cos(n), std::sin(n), 0);
    }
    const WeightedGraph star(std::vector<double>(10, 1), places, edges);
    const GraphPartition partition = partitionGraph(star, {4});
    checkParts(star, partition);
    CHECK(partition.parts == 4);
    std::vector<double> weights = weightsOf(star, partition);
    std::sort(weights.begin(), weights.end());
    CHECK(weights == std::vector<double>{1, 1, 1, 7});
}

TEST_CASE("components share the parts by weight, each has one at least") {
    Edges edges;
    std::vector<glm::dvec3> places;
    std::vector<double> weights;
    // Paths of 12 and 4 nodes, and two nodes alone.
    for (uint32_t n = 0; n < 18; ++n) {
        places.emplace_back(n, 0, 0);
        weights.push_back(1);
        if (n != 11 && n < 15) edges.push_back({n, n + 1, 1});
    }
    const WeightedGraph graph(weights, places, edges);
    for (const uint32_t asked : {1U, 4U, 6U, 18U}) {
        CAPTURE(asked);
        const GraphPartition partition = partitionGraph(graph, {asked});
        checkParts(graph, partition);
        CHECK(partition.components == 4);
        CHECK(partition.parts == std::max(asked, 4U));
    }
    const GraphPartition six = partitionGraph(graph, {6});
    std::vector<double> sums = weightsOf(graph, six);
    std::sort(sums.begin(), sums.end());
    CHECK(sums == std::vector<double>{1, 1, 4, 4, 4, 4});
}

TEST_CASE("edges without strength, to the node itself and twice between two nodes are understood") {
    const WeightedGraph graph(
        {1, 1, 1, 1}, std::vector<glm::dvec3>(4, glm::dvec3(0)),
        Edges{{0, 1, 1}, {1, 0, 2}, {1, 2, 0}, {2, 3, -1}, {2, 2, 5}, {3, 0, std::nan("")}});
    CHECK(graph.links(0).size() == 1);
    CHECK(graph.links(0)[0].strength == 3);
    CHECK(graph.strength() == 3);
    CHECK(partitionGraph(graph, {1}).part == std::vector<uint32_t>{0, 0, 1, 2});
}

TEST_CASE("nodes of no weight join a part, and where all have none they count alike") {
    Edges edges;
    std::vector<glm::dvec3> places;
    for (uint32_t n = 0; n < 12; ++n) {
        places.emplace_back(n, 0, 0);
        if (n > 0) edges.push_back({n - 1, n, 1});
    }
    const WeightedGraph none(std::vector<double>(12, 0), places, edges);
    const GraphPartition alike = partitionGraph(none, {3});
    checkParts(none, alike);
    std::vector<uint32_t> sizes(3, 0);
    for (const uint32_t p : alike.part) ++sizes[p];
    CHECK(sizes == std::vector<uint32_t>{4, 4, 4});
    std::vector<double> some(12, 0);
    some[1] = some[2] = some[10] = some[11] = 1;
    const WeightedGraph graph(some, places, edges);
    const GraphPartition partition = partitionGraph(graph, {2});
    checkParts(graph, partition);
    CHECK(weightsOf(graph, partition) == std::vector<double>{2, 2});
}

TEST_CASE("a grid falls into even blocks with short borders") {
    const WeightedGraph square = gridGraph(12, 12);
    const GraphPartition four = partitionGraph(square, {4});
    checkParts(square, four);
    for (const double weight : weightsOf(square, four)) CHECK(std::abs(weight - 36) <= 2);
    CHECK(cutOf(square, four) <= 30);  // 24 is the least, by two straight cuts

    const WeightedGraph cube = gridGraph(8, 8, 8);
    const GraphPartition eight = partitionGraph(cube, {8});
    checkParts(cube, eight);
    for (const double weight : weightsOf(cube, eight)) CHECK(std::abs(weight - 64) <= 64 * 0.15);
    CHECK(cutOf(cube, eight) <= 1.35 * 192);  // 192 is the least, by three straight cuts
}

TEST_CASE("the more evenness, the evener the parts; the less, the weaker what is cut") {
    // Two heavy blocks of different size on a weak neck.
    const WeightedGraph left = gridGraph(6, 6);
    std::vector<double> weights(36 + 12, 1);
    std::vector<glm::dvec3> places;
    Edges edges;
    for (uint32_t n = 0; n < 36; ++n) {
        places.push_back(left.place(n));
        for (const auto& link : left.links(n))
            if (link.node > n) edges.push_back({n, link.node, 1});
    }
    for (uint32_t n = 0; n < 12; ++n) {
        places.emplace_back(6 + n % 4, n / 4, 0);
        if (n % 4 > 0) edges.push_back({36 + n - 1, 36 + n, 1});
        if (n >= 4) edges.push_back({36 + n - 4, 36 + n, 1});
    }
    edges.push_back({5, 36, 0.1});
    const WeightedGraph graph(weights, places, edges);
    const GraphPartition even = partitionGraph(graph, {2, 1});
    const GraphPartition weak = partitionGraph(graph, {2, 0.05});
    checkParts(graph, even);
    checkParts(graph, weak);
    CHECK(weightsOf(graph, even) == std::vector<double>{24, 24});
    CHECK(cutOf(graph, weak) == doctest::Approx(0.1));
    CHECK(weightsOf(graph, weak) == std::vector<double>{36, 12});
}

TEST_CASE("random graphs: parts are connected, as many as there can be, and no part is far off") {
    double worst = 0;
    for (const uint32_t seed : propertySeeds(1, 150)) {
        CAPTURE(seed);
        Random random(seed);
        const uint32_t count = 2 + random.below(150);
        std::vector<double> weights;
        std::vector<glm::dvec3> places;
        for (uint32_t n = 0; n < count; ++n) {
            weights.push_back(random.oneIn(8) ? 0 : random.in(0.5, 1.5));
            places.emplace_back(random.unit(), random.unit(), random.unit());
        }
        Edges edges;
        const double reach = random.in(0.15, 0.6);
        for (uint32_t a = 0; a < count; ++a)
            for (uint32_t b = a + 1; b < count; ++b)
                if (glm::distance(places[a], places[b]) < reach)
                    edges.push_back({a, b, random.in(0, 1)});
        const WeightedGraph graph(weights, places, edges);
        const uint32_t asked = 1 + random.below(12);
        const GraphPartition partition = partitionGraph(graph, {asked, random.unit()});
        checkParts(graph, partition);
        const uint32_t most = std::min(std::max(asked, partition.components), count);
        CHECK(partition.parts == most);
        CHECK(partitionGraph(graph, {asked, 0.5}).part == partitionGraph(graph, {asked, 0.5}).part);
        if (partition.components > 1) continue;
        const GraphPartition even = partitionGraph(graph, {asked, 1});
        const std::vector<double> sums = weightsOf(graph, even);
        const double mean = std::accumulate(sums.begin(), sums.end(), 0.0) / sums.size();
        if (count >= 10 * asked)
            worst = std::max(worst, *std::max_element(sums.begin(), sums.end()) / mean);
    }
    MESSAGE("largest part " << worst << " times the mean");
    CHECK(worst < 1.6);
}
