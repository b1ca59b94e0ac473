// SPDX-License-Identifier: MIT
#include "physics/bonds.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "shapes.h"

using namespace sherd;

namespace {

struct Scene {
    std::vector<glm::vec3> positions;
    std::vector<HiddenTriangle> triangles;

    /// Every shape brings positions of its own: what is shared is told by coordinates alone.
    void add(const test::Shape& shape, uint32_t leaf) {
        const auto first = static_cast<uint32_t>(positions.size());
        positions.insert(positions.end(), shape.positions.begin(), shape.positions.end());
        for (const auto& t : shape.triangles) {
            triangles.push_back({{first + t[0], first + t[1], first + t[2]}, leaf});
        }
    }
    std::vector<LeafBond> bonds(double tolerance = 0) const {
        return findBonds(positions, triangles, {tolerance});
    }
};

/// A square of n x n quads in the plane x, facing +x or -x.
test::Shape sheet(float x, int n, bool facesPlus) {
    test::Shape out;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            out.positions.emplace_back(x, static_cast<float>(i) / n, static_cast<float>(j) / n);
        }
    }
    const auto at = [&](int i, int j) { return static_cast<uint32_t>(i * (n + 1) + j); };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            out.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            out.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    if (!facesPlus) {
        for (auto& t : out.triangles) std::swap(t[1], t[2]);
    }
    return out;
}

}  // namespace

TEST_CASE("nothing, one leaf alone and leaves apart have no bond") {
    CHECK(findBonds({}, {}, {}).empty());
    Scene scene;
    scene.add(test::box({0, 0, 0}, {1, 1, 1}), 0);
    CHECK(scene.bonds(1).empty());
    scene.add(test::box({5, 0, 0}, {6, 1, 1}), 1);
    CHECK(scene.bonds(1).empty());
}

TEST_CASE("two boxes that share a face are bonded over its area, once") {
    Scene scene;
    // The two shared triangles alone, so that the diagonals agree.
    scene.add({{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}}, 7);
    scene.add({{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}, {{0, 2, 3}, {0, 1, 2}}}, 3);
    const std::vector<LeafBond> bonds = scene.bonds(0.5);
    REQUIRE(bonds.size() == 1);
    CHECK(bonds[0].a == 3);
    CHECK(bonds[0].b == 7);
    CHECK(bonds[0].area == doctest::Approx(1));
    CHECK(glm::length(bonds[0].centroid - glm::dvec3(1, 0.5, 0.5)) < 1e-12);
    // Leaf 7 looks towards +x, so from 3 to 7 is -x.
    CHECK(bonds[0].normal == glm::dvec3(-1, 0, 0));
}

TEST_CASE("the same triangle in the same orientation, or of one leaf, is no wall") {
    const test::Shape one = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const test::Shape back = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 2, 1}}};
    Scene same;
    same.add(one, 0);
    same.add(one, 1);
    CHECK(same.bonds(1).empty());
    Scene self;
    self.add(one, 0);
    self.add(back, 0);
    CHECK(self.bonds(1).empty());
}

TEST_CASE("degenerate triangles bond nothing") {
    Scene scene;
    scene.add({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 0, 1}}}, 0);
    scene.add({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 2, 1}, {0, 1, 0}}}, 1);
    CHECK(scene.bonds(1).empty());
}

TEST_CASE("sheets facing each other within the tolerance are bonded, beyond it not") {
    Scene scene;
    scene.add(sheet(0, 8, true), 0);
    scene.add(sheet(0.25F, 5, false), 1);
    const std::vector<LeafBond> bonds = scene.bonds(0.3);
    REQUIRE(bonds.size() == 1);
    CHECK(bonds[0].area == doctest::Approx(1));
    CHECK(glm::length(bonds[0].centroid - glm::dvec3(0.125, 0.5, 0.5)) < 1e-6);
    CHECK(glm::length(bonds[0].normal - glm::dvec3(1, 0, 0)) < 1e-9);
    CHECK(scene.bonds(0.2).empty());
    CHECK(scene.bonds(0).empty());
}

TEST_CASE("sheets that look the same way are not bonded") {
    Scene scene;
    scene.add(sheet(0, 4, true), 0);
    scene.add(sheet(0.1F, 4, true), 1);
    CHECK(scene.bonds(1).empty());
}

TEST_CASE("a sheet facing two leaves is shared between them") {
    Scene scene;
    scene.add(sheet(0, 8, true), 0);
    test::Shape half = sheet(0.125F, 8, false);
    test::Shape other = half;
    half.triangles.resize(64);
    other.triangles.erase(other.triangles.begin(), other.triangles.begin() + 64);
    scene.add(half, 1);
    scene.add(other, 2);
    const std::vector<LeafBond> bonds = scene.bonds(0.2);
    REQUIRE(bonds.size() == 2);
    CHECK(bonds[0].b == 1);
    CHECK(bonds[1].b == 2);
    CHECK(bonds[0].area == doctest::Approx(0.5).epsilon(0.02));
    CHECK(bonds[0].area + bonds[1].area == doctest::Approx(1));
}

TEST_CASE("the number of threads changes no bit") {
    Scene scene;
    scene.add(sheet(0, 60, true), 0);
    scene.add(sheet(0.01F, 50, false), 1);
    scene.add(sheet(0.02F, 40, true), 1);
    scene.add(sheet(0.03F, 60, false), 2);
    const std::vector<LeafBond> one = scene.bonds(0.5);
    const std::vector<LeafBond> four = findBonds(scene.positions, scene.triangles, {0.5, 4});
    REQUIRE(one.size() == four.size());
    for (size_t i = 0; i < one.size(); ++i) {
        CHECK(one[i].area == four[i].area);
        CHECK(one[i].centroid == four[i].centroid);
        CHECK(one[i].normal == four[i].normal);
    }
}

TEST_CASE("a wall that closes on itself has an area and some unit normal") {
    Scene scene;
    test::Shape stone = test::sphere(6, {0, 0, 0}, 1);
    scene.add(stone, 0);
    for (auto& t : stone.triangles) std::swap(t[1], t[2]);
    scene.add(stone, 1);
    const std::vector<LeafBond> bonds = scene.bonds();
    REQUIRE(bonds.size() == 1);
    CHECK(bonds[0].area > 10);
    CHECK(glm::length(bonds[0].normal) == doctest::Approx(1));
}
