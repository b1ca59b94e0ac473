// SPDX-License-Identifier: MIT
// Massive bodies with lines drawn around them, which straight walls alone do not close.
#include <cmath>

#include "geometry/dice.h"
#include "solid/solid_bakes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Turned around y; the profile (radius, y) leads from axis to axis, upwards on the outside.
Shape turned(const std::vector<glm::vec2>& profile, uint32_t around) {
    Shape shape;
    const auto rings = static_cast<uint32_t>(profile.size()) - 2;
    shape.positions.emplace_back(0, profile.front().y, 0);
    for (uint32_t r = 1; r <= rings; ++r) {
        for (uint32_t i = 0; i < around; ++i) {
            const double angle = 2 * M_PI * (i + 0.25) / around;
            shape.positions.emplace_back(profile[r].x * std::cos(angle), profile[r].y,
                                         -profile[r].x * std::sin(angle));
        }
    }
    shape.positions.emplace_back(0, profile.back().y, 0);
    const auto last = static_cast<uint32_t>(shape.positions.size()) - 1;
    for (uint32_t i = 0; i < around; ++i) {
        const uint32_t n = (i + 1) % around;
        shape.triangles.push_back({0, 1 + n, 1 + i});
        for (uint32_t r = 0; r + 1 < rings; ++r) {
            const uint32_t low = 1 + r * around, high = low + around;
            shape.triangles.push_back({low + i, low + n, high + n});
            shape.triangles.push_back({low + i, high + n, high + i});
        }
        const uint32_t top = 1 + (rings - 1) * around;
        shape.triangles.push_back({top + i, top + n, last});
    }
    return shape;
}

/// A barrel: lids sunk below its rims, hoops that stand out.
Shape barrel() {
    return turned({{0, -0.9F},
                   {0.6F, -0.9F},
                   {0.6F, -1},
                   {0.7F, -1},
                   {0.78F, -0.7F},
                   {0.84F, -0.7F},
                   {0.88F, -0.5F},
                   {0.83F, -0.5F},
                   {0.9F, 0},
                   {0.83F, 0.5F},
                   {0.88F, 0.5F},
                   {0.84F, 0.7F},
                   {0.78F, 0.7F},
                   {0.7F, 1},
                   {0.6F, 1},
                   {0.6F, 0.9F},
                   {0, 0.9F}},
                  20);
}

/// A fluted column with a wide foot and head.
Shape column() {
    Shape shape = turned({{0, 0},
                          {0.5F, 0},
                          {0.5F, 0.2F},
                          {0.3F, 0.3F},
                          {0.28F, 1},
                          {0.26F, 2},
                          {0.25F, 2.7F},
                          {0.45F, 2.85F},
                          {0.45F, 3},
                          {0, 3}},
                         48);
    for (glm::vec3& p : shape.positions) {
        if (p.y < 0.25F || p.y > 2.75F) continue;
        const double angle = std::atan2(p.z, p.x);
        const auto flute = static_cast<float>(1 - 0.12 * std::abs(std::sin(6 * angle)));
        p.x *= flute;
        p.z *= flute;
    }
    return shape;
}

FracturePlan drawn(FractureMap map, const char* projection) {
    FracturePlan plan;
    plan.drawings.push_back({std::move(map), *parseProjection(projection)});
    return plan;
}

/// Rings at these heights of the page, and uprights over its whole height; all of them jagged.
FractureMap cracks(const std::vector<double>& rings, int uprights, uint64_t seed) {
    Dice dice(seed);
    FractureMap map;
    constexpr int kSteps = 40;
    for (const double height : rings) {
        FractureMap::Line line{{}, 1, "ring"};
        double first = 0;
        for (int i = 0; i <= kSteps; ++i) {
            const double v = height + 0.02 * dice.signedUnit();
            if (i == 0) first = v;
            line.points.emplace_back(double(i) / kSteps, i == kSteps ? first : v);
        }
        map.lines.push_back(line);
    }
    for (int k = 0; k < uprights; ++k) {
        FractureMap::Line line{{}, 1, "upright"};
        for (int i = 0; i <= kSteps; ++i)
            line.points.emplace_back((k + 0.4) / uprights + 0.01 * dice.signedUnit(),
                                     double(i) / kSteps);
        map.lines.push_back(line);
    }
    return map;
}

}  // namespace

TEST_CASE("a barrel with sunk lids, cut by a grid, breaks into full pieces") {
    FractureMap map;
    for (const double x : {0.27, 0.52, 0.77}) {
        map.lines.push_back({{{x, 0}, {x, 1}}, 1, "upright"});
        map.lines.push_back({{{0, x}, {1, x}}, 1, "level"});
    }
    const FractureSet set = SolidJudge{meshOf(barrel()), drawn(map, "box")}.check();
    CHECK(set.bonds.size() > 60);
}

TEST_CASE("a fluted column breaks into full pieces along cracks around it") {
    constexpr uint64_t kSeed = 5;
    CAPTURE(kSeed);
    SolidJudge{meshOf(column()), drawn(cracks({0.3, 0.5, 0.7}, 3, kSeed), "cylindrical:y")}.check();
}

TEST_CASE("deeper cracks divide the full pieces of the level before") {
    constexpr uint64_t kSeed = 6;
    CAPTURE(kSeed);
    FractureMap map = cracks({0.35, 0.6}, 0, kSeed);
    FractureMap deeper = cracks({0.5}, 3, kSeed + 1);
    for (FractureMap::Line& line : deeper.lines) {
        line.level = 2;
        map.lines.push_back(line);
    }
    const FractureSet set = SolidJudge{meshOf(column()), drawn(map, "cylindrical:y")}.check();
    CHECK(fragmentsAtLevel(set, 1).size() == 3);
}

TEST_CASE("a ring breaks into full pieces along a grid that is drawn over it") {
    FractureMap map;
    for (const double x : {0.21, 0.43, 0.64, 0.83}) {
        map.lines.push_back({{{x, 0}, {x, 1}}, 1, "upright"});
        map.lines.push_back({{{0, x}, {1, x}}, 1, "level"});
    }
    SolidJudge{meshOf(torusShape(1, 0.35F, 40, 16)), drawn(map, "box")}.check();
}

TEST_CASE("a lid that nothing but one circle parts from its body lifts off as a full piece") {
    FractureMap map = cracks({0.4}, 0, 3);
    SolidJudge{meshOf(barrel()), drawn(map, "cylindrical:y")}.check(2);
}

TEST_CASE("lines on the outer skin alone part what is around a hollow, too") {
    Shape hollow = barrel();
    Shape inner = sphere({0, 0, 0}, {0.4F, 0.4F, 0.4F}, 6);
    for (auto& t : inner.triangles) std::swap(t[0], t[1]);
    hollow.append(inner);
    Recipe recipe = solidRecipe();
    const FracturePlan plan = drawn(cracks({0.35, 0.6}, 3, 8), "cylindrical:y");
    const SurfaceMesh mesh = meshOf(hollow);
    const Result<BakedObject> baked = bakeObject(mesh, plan, recipe, {});
    if (!baked) FAIL(baked.error().message);
    CHECK(baked->report.levels[1].closed == baked->report.levels[1].fragments);
    const Coverage coverage = coverageOf(mesh, baked->set, 1);
    CHECK(coverage.none == 0);
    CHECK(coverage.several == 0);
    CHECK_FALSE(fellBack(*baked));
}

TEST_CASE("two bodies that touch in an edge stay apart, each in full pieces") {
    Shape both = box({0, 0, 0}, {1, 1, 1}, 3);
    both.append(box({1, 1, 0}, {2, 2, 1}, 3));
    FractureMap map = cracks({0.37, 0.66}, 3, 9);
    const SurfaceMesh mesh = meshOf(both);
    const Result<BakedObject> baked =
        bakeObject(mesh, drawn(map, "cylindrical:z"), solidRecipe(), {});
    if (!baked) FAIL(baked.error().message);
    CHECK(baked->report.levels[1].closed == baked->report.levels[1].fragments);
    const Coverage coverage = coverageOf(mesh, baked->set, 1);
    CHECK(coverage.none == 0);
    CHECK(coverage.several == 0);
    CHECK_FALSE(fellBack(*baked));
}

TEST_CASE("an object of another size, or baked by more threads, breaks into the same pieces") {
    const FracturePlan plan = drawn(cracks({0.3, 0.5, 0.7}, 3, 5), "cylindrical:y");
    const auto bakeAt = [&](float scale, unsigned threads) {
        Shape shape = column();
        for (glm::vec3& p : shape.positions) p *= scale;
        Recipe recipe = solidRecipe();
        recipe.threads = threads;
        Result<BakedObject> baked = bakeObject(meshOf(shape), plan, recipe, {});
        if (!baked) FAIL(baked.error().message);
        CHECK_FALSE(fellBack(*baked));
        return std::move(*baked);
    };
    const BakedObject one = bakeAt(1, 1);
    const BakedObject large = bakeAt(8, 3);
    CHECK(large.set.geometry.indices == one.set.geometry.indices);
    REQUIRE(large.set.geometry.positions.size() == one.set.geometry.positions.size());
    bool same = true;
    for (size_t i = 0; i < one.set.geometry.positions.size(); ++i)
        same = same && large.set.geometry.positions[i] == 8.0F * one.set.geometry.positions[i];
    CHECK(same);
    for (const float scale : {1e-3F, 1e3F}) {
        const BakedObject other = bakeAt(scale, 2);
        CHECK(other.report.levels[1].fragments == one.report.levels[1].fragments);
        CHECK(other.report.levels[1].volumeShare == doctest::Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("pieces of a filled solid can be rough") {
    Recipe recipe = solidRecipe();
    recipe.interior.roughness.amplitude = 0.01;
    recipe.interior.roughness.size = 0.1;
    const SurfaceMesh mesh = meshOf(column());
    const Result<BakedObject> baked =
        bakeObject(mesh, drawn(cracks({0.35, 0.6}, 2, 5), "cylindrical:y"), recipe, {});
    if (!baked) FAIL(baked.error().message);
    CHECK_FALSE(fellBack(*baked));
    CHECK(baked->report.levels[1].closed == baked->report.levels[1].fragments);
    const Coverage coverage = coverageOf(mesh, baked->set, 1);
    CHECK(coverage.none == 0);
    CHECK(coverage.several == 0);
}
