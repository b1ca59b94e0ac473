// SPDX-License-Identifier: MIT
// Hidden points that are put together: which, how far, and what it is for.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "interior/point_merging.h"
#include "shapes.h"
#include "sherd/baker/bake.h"
#include "support/pattern_plans.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// A flat square of n x n places with sides of 1, `height` above z = 0; its points lie below at
/// z = 0, as far off as `noise` has it.
HiddenSheet flatSheet(int n, float height, float noise, uint32_t seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> off(-noise, noise);
    HiddenSheet sheet;
    const auto at = [&](int x, int y) { return static_cast<uint32_t>(y * n + x); };
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            sheet.feet.emplace_back(x, y, height);
            const float dx = off(engine), dy = off(engine), dz = off(engine);
            sheet.points.emplace_back(static_cast<float>(x) + dx, static_cast<float>(y) + dy, dz);
            if (x + 1 == n || y + 1 == n) continue;
            HiddenSheet::Triangle t{};
            t.v = {at(x, y), at(x + 1, y), at(x, y + 1)};
            sheet.triangles.push_back(t);
            t.v = {at(x + 1, y + 1), at(x, y + 1), at(x + 1, y)};
            sheet.triangles.push_back(t);
        }
    }
    sheet.origins.resize(sheet.feet.size());
    return sheet;
}

HiddenSheet together(HiddenSheet a, const HiddenSheet& b) {
    const auto count = static_cast<uint32_t>(a.feet.size());
    a.feet.insert(a.feet.end(), b.feet.begin(), b.feet.end());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    a.origins.resize(a.feet.size());
    for (HiddenSheet::Triangle t : b.triangles) {
        for (uint32_t& v : t.v) v += count;
        a.triangles.push_back(t);
    }
    return a;
}

/// The nearest of the first `count` points to point v, all looked at, nearer than `within`.
std::optional<float> nearestOf(const HiddenSheet& sheet, size_t count, size_t v, float within) {
    std::optional<float> best;
    for (size_t u = 0; u < count; ++u) {
        const float d = glm::distance(sheet.points[u], sheet.points[v]);
        if (u != v && d < best.value_or(within)) best = d;
    }
    return best;
}

}  // namespace

TEST_CASE("an empty sheet, points on the surface and points far apart stay as they are") {
    HiddenSheet empty;
    mergeNearPoints(1, {}, empty);
    CHECK(empty.points.empty());

    HiddenSheet onSurface = flatSheet(4, 0, 0, 1);
    onSurface.points[1] = onSurface.feet[1] = onSurface.points[0];
    const std::vector<glm::vec3> before = onSurface.points;
    mergeNearPoints(5, {}, onSurface);
    CHECK(onSurface.points == before);

    HiddenSheet apart = flatSheet(4, 3, 0, 1);
    const std::vector<glm::vec3> points = apart.points;
    mergeNearPoints(0.9, {}, apart);
    CHECK(apart.points == points);
    mergeNearPoints(0, {}, apart);
    CHECK(apart.points == points);
}

TEST_CASE("points of facing sheets meet, and none moves farther than it may") {
    for (uint32_t seed = 1; seed <= 5; ++seed) {
        CAPTURE(seed);
        constexpr float kReach = 0.7F;
        const HiddenSheet upper = flatSheet(12, 2, 0.1F, seed);
        HiddenSheet sheet = together(upper, flatSheet(12, -2, 0.1F, seed + 100));
        const HiddenSheet before = sheet;
        mergeNearPoints(kReach, {}, sheet);
        size_t met = 0;
        for (size_t v = 0; v < sheet.points.size(); ++v) {
            const float way = glm::distance(sheet.points[v], before.points[v]);
            CHECK(way < kReach);
            CHECK(way < glm::distance(before.points[v], before.feet[v]));
            if (v < upper.points.size()) continue;
            if (nearestOf(before, v, v, kReach)) CHECK(nearestOf(sheet, v, v, kReach) == 0.0F);
            met += sheet.points[v] == sheet.points[v - upper.points.size()] ? 1 : 0;
        }
        CHECK(met == upper.points.size());
    }
}

TEST_CASE("points that go first do not leave their line for others beside it") {
    HiddenSheet sheet = flatSheet(9, 2, 0.3F, 6);
    std::vector<uint8_t> first(sheet.points.size(), 0);
    std::vector<glm::vec3> line;
    for (size_t i = 0; i < 9; ++i) {
        const size_t v = 9 * i + 4;
        first[v] = 1;
        sheet.points[v] = glm::vec3(4, 0.4F * static_cast<float>(i), 0);
        line.push_back(sheet.points[v]);
        sheet.points[v - 1] = line.back() - glm::vec3(0.2F, 0.1F, 0);
    }
    HiddenSheet without = sheet;
    mergeNearPoints(0.5, first, sheet);
    mergeNearPoints(0.5, {}, without);
    size_t left = 0;
    for (size_t v = 0; v < first.size(); ++v) {
        if (first[v] == 0) continue;
        CHECK(std::find(line.begin(), line.end(), sheet.points[v]) != line.end());
        left += std::find(line.begin(), line.end(), without.points[v]) == line.end() ? 1 : 0;
    }
    CHECK(left > 0);
}

TEST_CASE("hubs are nobody's point to meet") {
    HiddenSheet sheet = flatSheet(3, 2, 0, 1);
    const std::vector<glm::vec3> hubs{sheet.points[4] + glm::vec3(0.1F, 0, 0)};
    setHubs(sheet, hubs);
    mergeNearPoints(0.5, {}, sheet);
    CHECK(sheet.points.back() == hubs[0]);
}

TEST_CASE("the scale of an object by a power of two changes no choice") {
    HiddenSheet sheet = together(flatSheet(9, 2, 0.2F, 3), flatSheet(9, -2, 0.2F, 4));
    HiddenSheet large = sheet;
    for (auto* places : {&large.feet, &large.points})
        for (glm::vec3& p : *places) p *= 1024.0F;
    mergeNearPoints(0.6, {}, sheet);
    mergeNearPoints(0.6 * 1024, {}, large);
    for (size_t v = 0; v < sheet.points.size(); ++v)
        CHECK(large.points[v] == 1024.0F * sheet.points[v]);
}

// Without merging: 23,756 pairs.
TEST_CASE("the sheets of a wavy plate's two sides seldom cross") {
    SurfaceMesh mesh = chartedCube(1, 48);
    for (glm::vec3& p : mesh.positions)
        p.z = 0.1F * p.z + 0.02F * std::sin(9 * p.x + p.z) * std::cos(7 * p.y);
    Recipe recipe;
    recipe.measure = true;
    const Result<BakedObject> baked = bakeObject(mesh, patterns({"voronoi:4:1"}), recipe, -1);
    REQUIRE(baked.has_value());
    const BakedLevelReport& level = baked->report.levels[1];
    CHECK(*level.selfIntersections < 6000);
    CHECK(*level.coverageNone < 0.02);
    CHECK(*level.coverageDouble < 0.01);
}
