// SPDX-License-Identifier: MIT
// Colliders as geometry asks for them, measured from what is written.
#include "assembly/colliders.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "measures/collider_measures.h"
#include "shapes.h"
#include "sherd/formats/hull_measures.h"
#include "support/piece_set.h"
#include "support/property.h"
#include "support/random_solids.h"

using namespace sherd;
using namespace sherd::test;

namespace {

PieceMesh pieceOf(const test::Shape& shape) {
    return {shape.positions, shape.triangles};
}

PieceMesh pieceOf(const Solid& solid) {
    return {solid.positions, solid.triangles};
}

/// Small margins, so that volumes are those of the parts.
PhysicsSettings settingsWith(uint32_t parts, double margin = 0) {
    PhysicsSettings settings;
    settings.convexParts = parts;
    settings.hullMargin = margin;
    return settings;
}

FractureSet collided(const std::vector<PieceMesh>& pieces, const PhysicsSettings& settings) {
    FractureSet set = setOf(pieces);
    assembleColliders(settings, 1, set);
    return set;
}

double diagonalOf(const FractureSet& set) {
    glm::vec3 low = set.geometry.positions[0], high = low;
    for (const glm::vec3& p : set.geometry.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::distance(low, high);
}

BakedObjectReport measured(const FractureSet& set) {
    BakedObjectReport report;
    report.diagonal = diagonalOf(set);
    report.levels.resize(set.levels.size());
    for (const Fragment& fragment : set.fragments) {
        BakedFragmentReport entry;
        entry.level = fragment.level;
        entry.volume = fragment.volume;
        report.fragments.push_back(entry);
    }
    measureColliders(set, {}, report);
    return report;
}

bool hasFinding(const BakedObjectReport& report, const std::string& code) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [&](const BakeFinding& finding) { return finding.code == code; });
}

const PieceMesh kL = cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 2, 0}});
const PieceMesh kU =
    cubes({{0, 2, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}});
/// Two Ls that fill a block of 4 x 2.
const PieceMesh kLower = cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}});
const PieceMesh kUpper = cubes({{3, 1, 0}, {2, 1, 0}, {1, 1, 0}, {3, 0, 0}});

}  // namespace

TEST_CASE("pieces without a volume get a usable collider") {
    PieceMesh empty;
    PieceMesh plane{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
    PieceMesh line{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}, {0, 2, 1}}};
    PieceMesh point{std::vector<glm::vec3>(4, glm::vec3(5, 5, 5)), {{0, 1, 2}, {0, 2, 3}}};
    PieceMesh needle = pieceOf(test::box({0, 0, 3}, {1e-6F, 1, 3.000001F}));
    const FractureSet set = collided({empty, plane, line, point, needle}, settingsWith(8, 0.01));
    for (const Fragment& fragment : set.fragments) {
        REQUIRE(fragment.hulls.count >= 1);
        for (uint32_t h = 0; h < fragment.hulls.count; ++h) {
            const ConvexHull& hull = set.hulls[fragment.hulls.first + h];
            CHECK(hull.points.count >= 4);
            CHECK(hull.margin >= 0);
            for (uint32_t p = 0; p < hull.points.count; ++p)
                CHECK(std::isfinite(glm::length(set.hullPoints[hull.points.first + p])));
        }
    }
}

TEST_CASE("four points, some of them twice, are a collider of one part") {
    test::Shape shape = test::tetrahedron();
    const size_t count = shape.positions.size();
    for (size_t i = 0; i < count; ++i) shape.positions.push_back(shape.positions[i]);
    shape.triangles[3] = {6, 4, 7};
    const FractureSet set = collided({pieceOf(shape)}, settingsWith(8));
    CHECK(set.fragments[1].hulls.count == 1);
    CHECK(measured(set).fragments[1].collider->coverage > 0.999);
}

TEST_CASE("a convex piece keeps one part, a sphere too, and as many corners as it needs") {
    const FractureSet set = collided(
        {pieceOf(test::box({0, 0, 0}, {1, 2, 3})), pieceOf(test::sphere(24, {5, 0, 0}, 1))},
        settingsWith(8, 0.01));
    const BakedObjectReport report = measured(set);
    for (const uint32_t f : {1U, 2U}) {
        CHECK(set.fragments[f].hulls.count == 1);
        CHECK(report.fragments[f].collider->convex);
        CHECK(report.fragments[f].collider->coverage > 0.9);
    }
    CHECK(report.fragments[2].collider->uncovered < 0.06);
    CHECK(set.hulls[set.fragments[1].hulls.first].points.count == 8);
    CHECK(set.hulls[set.fragments[2].hulls.first].points.count > 16);
    CHECK(report.findings.empty());
}

// Corners used to be chosen at the object's size, where what a crumb's would add was below what
// counts: it got a tetrahedron.
TEST_CASE("a crumb of a large object has a collider as good as that of the rest") {
    const FractureSet set = collided({pieceOf(test::box({0, 0, 0}, {10, 10, 10})),
                                      pieceOf(test::box({10, 0, 0}, {10.004F, 0.002F, 0.002F}))},
                                     settingsWith(8, 0.01));
    CHECK(set.hulls[set.fragments[2].hulls.first].points.count == 8);
    CHECK(measured(set).fragments[2].collider->coverage > 0.95);
}

// A margin of a tenth of the extent rounds a tetrahedron off to 86 %; of pieces of some millimetres
// no corner loses the millimetre that was the only bound.
TEST_CASE("the margin of a small piece with sharp corners leaves nine tenths of it") {
    PieceMesh piece{{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}},
                    {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
    for (glm::vec3& p : piece.positions) p *= 2e-3F;
    const FractureSet set = collided({piece}, settingsWith(8, 0.01));
    const BakedCollider collider = *measured(set).fragments[1].collider;
    CHECK(collider.convex);
    CHECK(collider.coverage > 0.9);
    CHECK(set.hulls[set.fragments[1].hulls.first].margin > 5e-5F);
}

TEST_CASE("an L is two parts, a U three, and they hold all of it and no air") {
    for (const auto& [piece, parts] : {std::pair(kL, 2U), std::pair(kU, 3U)}) {
        const FractureSet set = collided({piece}, settingsWith(8));
        CHECK(set.fragments[1].hulls.count == parts);
        const BakedObjectReport report = measured(set);
        CHECK(report.fragments[1].collider->coverage > 0.999);
        CHECK(report.fragments[1].collider->outside < 1e-5);
        CHECK_FALSE(report.fragments[1].collider->convex);
        const FractureSet one = collided({piece}, settingsWith(1));
        CHECK(one.fragments[1].hulls.count == 1);
        CHECK(measured(one).fragments[1].collider->outside > 0.3);
    }
}

TEST_CASE("a ring is cut into parts that leave its hole open") {
    const FractureSet set = collided({pieceOf(torusSolid(3, 1, 32, 16))}, settingsWith(8));
    CHECK(set.fragments[1].hulls.count >= 4);
    CHECK(set.fragments[1].hulls.count <= 8);
    CHECK(measured(set).fragments[1].collider->coverage > 0.9);
    const glm::dvec3 middle(0);
    for (const ConvexHull& hull : set.hulls) {
        if (&hull == &set.hulls[set.fragments[0].hulls.first]) continue;
        const auto first = set.hullPoints.begin() + hull.points.first;
        const std::vector<glm::dvec3> points(first, first + hull.points.count);
        CHECK(hullDistance({&middle, 1}, points) > 0.5);
    }
}

TEST_CASE("two Ls that clasp each other do not overlap, however few parts they may have") {
    for (const uint32_t parts : {1U, 2U, 8U}) {
        CAPTURE(parts);
        const FractureSet set = collided({kLower, kUpper}, settingsWith(parts));
        CHECK(colliderOverlaps(set, 1e-5 * diagonalOf(set)).pairs.empty());
        const BakedObjectReport report = measured(set);
        CHECK(report.fragments[1].collider->coverage > (parts == 1 ? 0.7 : 0.999));
        CHECK(report.fragments[2].collider->coverage > (parts == 1 ? 0.7 : 0.999));
    }
}

TEST_CASE("neighbouring cubes touch and are not clipped") {
    std::vector<PieceMesh> pieces;
    pieces.reserve(27);
    for (int i = 0; i < 27; ++i) pieces.push_back(cubes({{i % 3, i / 3 % 3, i / 9}}, 0.1F));
    const FractureSet set = collided(pieces, settingsWith(8, 0.001));
    const BakedObjectReport report = measured(set);
    CHECK(report.levels[1].colliders->overlap < 1e-6);
    CHECK(report.levels[1].colliders->uncovered < 2e-3);
    CHECK(report.levels[1].colliders->leastCoverage > 0.98);
    CHECK(report.levels[1].colliders->hulls == 27);
    CHECK(report.findings.empty());
    for (const ConvexHull& hull : set.hulls) CHECK(hull.points.count == 8);
}

TEST_CASE("a ball in a shell that surrounds it keeps its collider") {
    Solid shell = sphereSolid({0, 0, 0}, {1, 1, 1}, 24, 12);
    Solid hollow = sphereSolid({0, 0, 0}, {0.7F, 0.7F, 0.7F}, 24, 12);
    const PieceMesh ball = pieceOf(hollow);
    hollow.turnInsideOut();
    shell.append(hollow);
    const FractureSet set = collided({pieceOf(shell), ball}, settingsWith(8));
    const BakedObjectReport report = measured(set);
    CHECK(report.levels[1].colliders->overlap < 1e-5 * report.diagonal);
    CHECK(report.fragments[2].collider->coverage > 0.6);
    CHECK(report.fragments[1].collider->coverage > 0.3);
}

TEST_CASE("random pieces side by side never overlap, and the report holds what is asked for") {
    for (const uint32_t seed : propertySeeds(1, 40)) {
        CAPTURE(seed);
        Random random(seed);
        // Blocks of cubes dealt out to pieces at random, as pieces of any shape that clasp.
        const int pieces = 2 + static_cast<int>(random.below(4));
        std::vector<std::vector<std::array<int, 3>>> places(static_cast<size_t>(pieces));
        for (int i = 0; i < 4 * 3 * 2; ++i)
            places[random.below(static_cast<uint32_t>(pieces))].push_back(
                {i % 4, i / 4 % 3, i / 12});
        std::vector<PieceMesh> meshes;
        for (const auto& own : places)
            if (!own.empty()) meshes.push_back(cubes(own));
        const FractureSet set =
            collided(meshes, settingsWith(1 + random.below(8), random.in(0, 0.05)));
        CHECK(colliderOverlaps(set, 1e-5 * diagonalOf(set)).pairs.empty());
        for (const Fragment& fragment : set.fragments) {
            CHECK(fragment.hulls.count >= 1);
            CHECK(fragment.hulls.count <= 8);
        }
        CHECK_FALSE(hasFinding(measured(set), "collider-overlap"));
    }
}

TEST_CASE("the same pieces at any power of two get the same colliders, whatever the threads") {
    std::vector<PieceMesh> pieces = {kLower, kUpper, pieceOf(torusSolid(3, 1, 16, 8))};
    for (glm::vec3& p : pieces[2].positions) p += glm::vec3(1, 2, 1.75F);
    const auto settings = [](double scale) { return settingsWith(8, 0.25 * scale); };
    const FractureSet one = collided(pieces, settings(1));
    for (const float scale : {0x1p-10F, 0x1p10F}) {
        std::vector<PieceMesh> scaled = pieces;
        for (PieceMesh& piece : scaled)
            for (glm::vec3& p : piece.positions) p *= scale;
        FractureSet other = setOf(scaled);
        // Metres that are accepted at any size do not scale: large pieces only are compared.
        assembleColliders(settings(scale), 3, other);
        if (scale < 1) continue;
        REQUIRE(other.hulls.size() == one.hulls.size());
        REQUIRE(other.hullPoints.size() == one.hullPoints.size());
        for (size_t h = 0; h < one.hulls.size(); ++h)
            CHECK(other.hulls[h].margin == one.hulls[h].margin * scale);
        for (size_t p = 0; p < one.hullPoints.size(); ++p)
            CHECK(other.hullPoints[p] == one.hullPoints[p] * scale);
    }
}

TEST_CASE("measures find colliders that overlap, fall short or stick out") {
    const std::vector<PieceMesh> pieces = {cubes({{0, 0, 0}}), cubes({{1, 0, 0}})};
    const FractureSet sound = collided(pieces, settingsWith(8, 0.01));
    CHECK(measured(sound).findings.empty());
    const auto moved = [&](float by) {
        FractureSet set = sound;
        const Range points = set.hulls[set.fragments[1].hulls.first].points;
        for (uint32_t p = points.first; p < points.first + points.count; ++p)
            set.hullPoints[p].x += by;
        return measured(set);
    };
    const BakedObjectReport deep = moved(0.05F);
    CHECK(hasFinding(deep, "collider-overlap"));
    CHECK(deep.fragments[1].collider->overlap == doctest::Approx(0.05).epsilon(1e-3));
    CHECK(deep.fragments[2].collider->overlap == doctest::Approx(0.05).epsilon(1e-3));
    CHECK(deep.fragments[1].collider->outside == doctest::Approx(0.05).epsilon(1e-3));
    const BakedObjectReport apart = moved(-0.2F);
    CHECK_FALSE(hasFinding(apart, "collider-overlap"));
    CHECK(hasFinding(apart, "collider-coverage"));
    CHECK(hasFinding(apart, "collider-uncovered"));
    CHECK(apart.fragments[1].collider->uncovered == doctest::Approx(0.2).epsilon(0.05));
    CHECK(apart.fragments[1].collider->coverage == doctest::Approx(0.8).epsilon(0.1));

    FractureSet shrunk = sound;
    for (glm::vec3& p : shrunk.hullPoints) p = 0.5F * p + glm::vec3(0.5F, 0.25F, 0.25F);
    CHECK(hasFinding(measured(shrunk), "collider-median"));
}
