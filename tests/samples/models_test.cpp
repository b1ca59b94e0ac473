// SPDX-License-Identifier: MIT
// What the statue is made with: shape functions meshed by a net, charts, packing.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "flat_chart.h"
#include "signed_distance.h"
#include "surface_nets.h"
#include "unwrap.h"

using namespace sherd::samples;

namespace {

BentGrid evenGrid(uint32_t cells) {
    BentGrid grid;
    for (std::vector<double>& planes : grid.planes) {
        for (uint32_t i = 0; i <= cells; ++i) planes.push_back(2.0 * i / cells - 1);
    }
    grid.bend = [](const glm::dvec3& p) { return p; };
    return grid;
}

double sphere(const glm::dvec3& p, const glm::dvec3& center, double radius) {
    return glm::distance(p, center) - radius;
}

/// Every edge is used once in each direction.
bool isClosed(const Mesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, int> balance;
    for (const Triangle& t : mesh.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = t[k].position;
            const uint32_t b = t[(k + 1) % 3].position;
            balance[std::minmax(a, b)] += a < b ? 1 : 1000;
        }
    }
    return std::all_of(balance.begin(), balance.end(),
                       [](const auto& edge) { return edge.second == 1001; });
}

double volumeOf(const Mesh& mesh) {
    double six = 0;
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t[0].position];
        six += glm::dot(a, glm::cross(glm::dvec3(mesh.positions[t[1].position]),
                                      glm::dvec3(mesh.positions[t[2].position])));
    }
    return six / 6;
}

/// The most triangles that cover one of `grid` x `grid` places of the texture.
uint32_t mostLayers(const Mesh& mesh, uint32_t grid) {
    std::vector<uint32_t> layers(size_t{grid} * grid, 0);
    for (const Triangle& t : mesh.triangles) {
        std::array<glm::dvec2, 3> p;
        // Off the corners of the grid, so that no place lies on an edge by design.
        for (size_t k = 0; k < 3; ++k) p[k] = glm::dvec2(t[k].uv) * double(grid) - 0.4567;
        const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) {
            return a.x * b.y - a.y * b.x;
        };
        const glm::dvec2 low = glm::floor(glm::min(p[0], glm::min(p[1], p[2])));
        const glm::dvec2 high = glm::ceil(glm::max(p[0], glm::max(p[1], p[2])));
        for (auto y = std::max(0, int32_t(low.y));
             y <= std::min(int32_t(grid) - 1, int32_t(high.y)); ++y) {
            for (auto x = std::max(0, int32_t(low.x));
                 x <= std::min(int32_t(grid) - 1, int32_t(high.x)); ++x) {
                const glm::dvec2 at(x, y);
                const double a = cross(p[1] - p[0], at - p[0]);
                const double b = cross(p[2] - p[1], at - p[1]);
                const double c = cross(p[0] - p[2], at - p[2]);
                if ((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0))
                    ++layers[size_t(y) * grid + size_t(x)];
            }
        }
    }
    return *std::max_element(layers.begin(), layers.end());
}

}  // namespace

TEST_CASE("a meshed sphere is closed, faces outwards and has a sphere's volume") {
    const Mesh mesh =
        meshShape([](const glm::dvec3& p) { return sphere(p, {}, 0.7); }, evenGrid(24));
    CHECK(isClosed(mesh));
    CHECK(isClosedManifold(mesh));
    const double exact = 4.0 / 3 * std::numbers::pi * std::pow(0.7, 3);
    CHECK(std::abs(volumeOf(mesh) / exact - 1) < 0.01);
    for (const glm::vec3& p : mesh.positions) CHECK(std::abs(glm::length(p) - 0.7F) < 1e-4F);
}

TEST_CASE("a shape that misses the grid's corners gives no triangles") {
    const Mesh mesh =
        meshShape([](const glm::dvec3& p) { return sphere(p, {}, 0.01); }, evenGrid(3));
    CHECK(mesh.triangles.empty());
}

TEST_CASE("two sheets in one cell stay apart") {
    // Two corners of the middle cell are inside, on opposite ends of its diagonal.
    const auto shape = [](const glm::dvec3& p) {
        return std::min(sphere(p, {-0.45, -0.45, -0.45}, 0.5), sphere(p, {0.45, 0.45, 0.45}, 0.5));
    };
    const Mesh mesh = meshShape(shape, evenGrid(5));
    CHECK(isClosedManifold(mesh));
    CHECK(volumeOf(mesh) > 0);
}

TEST_CASE("every sign pattern of a cell's corners gives a closed surface") {
    for (uint32_t pattern = 1; pattern < 256; ++pattern) {
        // Corner values of one cell amid cells that are all outside, on a grid of 0 to 3.
        BentGrid grid;
        grid.planes = {{{0, 1, 2, 3}, {0, 1, 2, 3}, {0, 1, 2, 3}}};
        grid.bend = [](const glm::dvec3& p) { return p; };
        const auto shape = [pattern](const glm::dvec3& p) {
            double value = 1e9;
            for (uint32_t c = 0; c < 8; ++c) {
                if ((pattern >> c & 1) == 0) continue;
                value =
                    std::min(value, sphere(p, {1 + (c & 1), 1 + (c >> 1 & 1), 1 + (c >> 2)}, 0.3));
            }
            return value;
        };
        INFO("pattern " << pattern);
        CHECK(isClosed(meshShape(shape, grid)));
    }
}

TEST_CASE("a bent grid follows the shape and meshes it all the same") {
    BentGrid grid = evenGrid(24);
    grid.bend = [](const glm::dvec3& p) { return p * glm::dvec3(1 - 0.4 * p.y, 1, 1 - 0.4 * p.y); };
    const Mesh mesh = meshShape([](const glm::dvec3& p) { return sphere(p, {}, 0.5); }, grid);
    CHECK(isClosedManifold(mesh));
    const double exact = 4.0 / 3 * std::numbers::pi * std::pow(0.5, 3);
    CHECK(std::abs(volumeOf(mesh) / exact - 1) < 0.02);
}

TEST_CASE("meshing and unwrapping give the same bits again") {
    const auto make = [] {
        Mesh mesh = meshShape([](const glm::dvec3& p) { return sphere(p, {}, 0.7); }, evenGrid(16));
        unwrap(mesh, {});
        return mesh;
    };
    const Mesh first = make();
    const Mesh second = make();
    CHECK(first.positions == second.positions);
    REQUIRE(first.triangles.size() == second.triangles.size());
    for (size_t t = 0; t < first.triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            CHECK(first.triangles[t][k].position == second.triangles[t][k].position);
            CHECK(first.triangles[t][k].uv == second.triangles[t][k].uv);
        }
    }
}

TEST_CASE("a sphere unwraps into its six sides, one layer deep") {
    Mesh mesh = meshShape([](const glm::dvec3& p) { return sphere(p, {}, 0.7); }, evenGrid(24));
    const std::vector<uint32_t> charts = unwrap(mesh, {});
    CHECK(*std::max_element(charts.begin(), charts.end()) == 5);
    CHECK(mostLayers(mesh, 1500) == 1);
    for (const Triangle& t : mesh.triangles) {
        for (const Corner& corner : t) {
            CHECK(std::min(corner.uv.x, corner.uv.y) > 0);
            CHECK(std::max(corner.uv.x, corner.uv.y) < 1);
        }
    }
}

TEST_CASE("what lies over something else gets a chart of its own") {
    // Seen from the front, the bar hides a part of the plate it is joined to at one end only.
    const auto shape = [](const glm::dvec3& p) {
        const double plate = roundBox(p, {0, 0, -0.3}, {0.7, 0.5, 0.12}, 0.08);
        const double bar = roundBox(p, {-0.1, 0, 0.35}, {0.5, 0.18, 0.12}, 0.08);
        const double post = roundBox(p, {-0.5, 0, 0.0}, {0.12, 0.18, 0.40}, 0.08);
        return blendUnion(plate, blendUnion(bar, post, 0.05), 0.05);
    };
    Mesh mesh = meshShape(shape, evenGrid(40));
    REQUIRE(isClosedManifold(mesh));
    unwrap(mesh, {});
    CHECK(mostLayers(mesh, 1500) == 1);
}

TEST_CASE("the check for layers sees two") {
    Mesh mesh = meshShape([](const glm::dvec3& p) { return sphere(p, {}, 0.7); }, evenGrid(12));
    for (Triangle& t : mesh.triangles)
        for (Corner& corner : t)
            corner.uv = glm::vec2(mesh.positions[corner.position]) * 0.5F + 0.5F;
    CHECK(mostLayers(mesh, 500) == 2);
}

TEST_CASE("triangles that share an edge or a corner do not overlap, those that share a place do") {
    FlatChart chart(0.5);
    chart.add({glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)});
    CHECK_FALSE(chart.overlaps({glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}));
    CHECK_FALSE(chart.overlaps({glm::dvec2(1, 0), glm::dvec2(2, 0), glm::dvec2(2, 1)}));
    CHECK_FALSE(chart.overlaps({glm::dvec2(5, 5), glm::dvec2(6, 5), glm::dvec2(5, 6)}));
    CHECK(chart.overlaps({glm::dvec2(0.1, 0.1), glm::dvec2(0.2, 0.1), glm::dvec2(0.1, 0.2)}));
    CHECK(chart.overlaps({glm::dvec2(-1, -1), glm::dvec2(3, -1), glm::dvec2(0, 3)}));
    CHECK(chart.overlaps({glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}));
}

TEST_CASE("packed boxes lie apart within the square") {
    std::vector<glm::dvec2> sizes;
    for (uint32_t i = 0; i < 30; ++i)
        sizes.emplace_back(0.1 + 0.07 * (i % 7), 0.1 + 0.05 * (i % 11));
    constexpr double kGutter = 0.01;
    std::vector<glm::dvec2> corners;
    const double factor = packBoxes(sizes, kGutter, corners);
    CHECK(factor > 0);
    double area = 0;
    for (size_t i = 0; i < sizes.size(); ++i) {
        const glm::dvec2 high = corners[i] + sizes[i] * factor;
        area += sizes[i].x * sizes[i].y * factor * factor;
        CHECK(std::min(corners[i].x, corners[i].y) > kGutter * 0.999);
        CHECK(std::max(high.x, high.y) < 1 - kGutter * 0.999);
        for (size_t j = 0; j < i; ++j) {
            const glm::dvec2 other = corners[j] + sizes[j] * factor;
            const double apart = std::max({corners[i].x - other.x, corners[j].x - high.x,
                                           corners[i].y - other.y, corners[j].y - high.y});
            CHECK(apart > kGutter * 0.999);
        }
    }
    CHECK(area > 0.5);
}
