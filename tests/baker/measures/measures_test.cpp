// SPDX-License-Identifier: MIT
// Each measure on pieces whose value is known, and on pieces broken on purpose.
#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "geometry/triangle_crossing.h"
#include "interior/shapes.h"
#include "measures/hidden_area.h"
#include "measures/level_coverage.h"
#include "measures/measures.h"
#include "measures/self_intersections.h"
#include "measures/thickness.h"
#include "support/coverage.h"
#include "support/fractured_cube.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FracturedCubeOptions threeLevels() {
    FracturedCubeOptions options;
    options.size = {1.0F, 2.0F, 0.7F};
    options.splits = {{2, 1, 1}, {1, 2, 2}, {2, 2, 2}};
    return options;
}

/// The set's own object as the solid it is measured against.
struct Solid {
    explicit Solid(const FractureSet& set)
        : positions(set.geometry.positions),
          triangles(fragmentTriangles(set, 0)),
          test(positions, triangles),
          cells(test, positions, triangles) {}
    OriginalSolid view() const { return {positions, triangles, cells}; }

    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
    InsideTest test;
    InsideCells cells;
};

BoxTree treeOf(const ShownTriangles& shown) {
    return BoxTree(boxesOf(shown.set().geometry.positions, shown.corners()));
}

uint64_t crossingsOf(const FractureSet& set) {
    const ShownTriangles shown(set);
    return selfIntersections(shown, treeOf(shown)).ofFragment[0];
}

uint32_t lastFragment(const FractureSet& set) {
    return static_cast<uint32_t>(set.fragments.size()) - 1;
}

/// Every vertex belongs to one leaf alone, so moving it moves nothing else.
template <class Visit>
void forEachVertexOf(FractureSet& set, uint32_t leaf, Visit visit) {
    std::set<uint32_t> vertices;
    for (const auto& triangle : fragmentTriangles(set, leaf))
        vertices.insert(triangle.begin(), triangle.end());
    for (const uint32_t v : vertices) visit(set.geometry.positions[v]);
}

/// A set of one fragment, the object, which is the shape.
FractureSet setOf(const Shape& shape) {
    FractureSet set;
    set.geometry.positions = shape.positions;
    for (const auto& t : shape.triangles)
        set.geometry.indices.insert(set.geometry.indices.end(), t.begin(), t.end());
    const auto count = static_cast<uint32_t>(set.geometry.indices.size());
    set.geometry.primitives.push_back({0, 0, {0, count}});
    set.fragments.resize(1);
    set.fragmentRanges = {{0, count}};
    set.levels = {{{0, 1}, ""}};
    return set;
}

BakedObjectReport measured(const FractureSet& set, bool all, unsigned threads = 2) {
    BakedObjectReport report;
    report.diagonal = 1;
    report.levels.resize(set.levels.size());
    report.fragments.resize(set.fragments.size());
    report.fragments[0].closed = true;
    const Solid solid(makeFracturedCube(threeLevels()));
    const OriginalSolid view = solid.view();
    measureSet(set, all ? &view : nullptr, threads, report);
    return report;
}

}  // namespace

TEST_CASE("boxes cut from a box fill it, hide the area of the cuts and are as thick as they are") {
    const BakedObjectReport report = measured(makeFracturedCube(threeLevels()), true);
    REQUIRE(report.levels.size() == 4);
    for (const BakedLevelReport& level : report.levels) {
        CHECK(level.coverageNone == 0);
        CHECK(level.coverageDouble == 0);
        CHECK(level.selfIntersections == 0);
        CHECK(level.protrusion.value() < 1e-7);
    }
    const double whole = 2 * (1 * 2 + 2 * 0.7 + 0.7 * 1);
    CHECK(report.levels[0].hiddenShare == 0);
    CHECK(report.levels[1].hiddenShare == doctest::Approx(2 * 1.4 / (whole + 2 * 1.4)));
    CHECK(report.levels[0].thinnest.value() == doctest::Approx(0.7));
    CHECK(report.levels[1].thinnest.value() == doctest::Approx(0.5));
    CHECK(report.levels[2].thinnest.value() == doctest::Approx(0.35));
    CHECK(report.levels[3].thinnest.value() == doctest::Approx(0.175));
    CHECK(report.fragments.back().thinnest.value() == doctest::Approx(0.175));
    CHECK(report.fragments.back().overlap.value() == 0);
    CHECK(report.findings.empty());
}

TEST_CASE("without being asked only what costs nothing is measured") {
    const BakedObjectReport report = measured(makeFracturedCube(threeLevels()), false);
    CHECK(report.levels[1].hiddenShare > 0);
    CHECK(report.fragments[1].hiddenShare > 0);
    CHECK_FALSE(report.levels[1].coverageNone.has_value());
    CHECK_FALSE(report.levels[1].protrusion.has_value());
    CHECK_FALSE(report.levels[1].selfIntersections.has_value());
    CHECK_FALSE(report.levels[1].thinnest.has_value());
}

TEST_CASE("measures are the same for any number of threads") {
    FractureSet set = makeFracturedCube(threeLevels());
    const uint32_t last = lastFragment(set);
    forEachVertexOf(set, last, [](glm::vec3& p) { p = p * 1.3F + glm::vec3(0.01F, 0.02F, 0.03F); });
    const std::string one = toJson({"", {measured(set, true, 1)}, 0});
    CHECK(toJson({"", {measured(set, true, 5)}, 0}) == one);
}

TEST_CASE("a leaf that takes its neighbour's place leaves a hollow and an overlap on every level") {
    FractureSet set = makeFracturedCube(threeLevels());
    const uint32_t last = lastFragment(set);
    const size_t primitives = set.geometry.primitives.size();
    for (size_t p = 0; p < primitives; ++p)
        set.fragmentRanges[(last - 1) * primitives + p] = set.fragmentRanges[last * primitives + p];
    const BakedObjectReport report = measured(set, true);
    CHECK(report.levels[3].coverageNone.value() == doctest::Approx(1.0 / 64).epsilon(0.2));
    CHECK(report.levels[3].coverageDouble.value() == doctest::Approx(1.0 / 64).epsilon(0.2));
    CHECK(report.fragments[last].overlap == 1);
    CHECK(report.fragments[1].overlap == 0);
    // Its own collider is where it was.
    std::set<std::string> codes;
    for (const BakeFinding& finding : report.findings) codes.insert(finding.code);
    CHECK(codes == std::set<std::string>{"coverage", "collider-coverage", "collider-uncovered"});
}

TEST_CASE("the share of points skipped near faces does not count") {
    FractureSet set = makeFracturedCube(threeLevels());
    forEachVertexOf(set, lastFragment(set), [](glm::vec3& p) { p += glm::vec3(5e-3F, 0, 0); });
    const Solid solid(makeFracturedCube(threeLevels()));
    const ShownTriangles shown(set);
    const LevelCoverage strict = levelCoverage(shown, treeOf(shown), solid.view(), {.skin = 0});
    const LevelCoverage lax = levelCoverage(shown, treeOf(shown), solid.view(), {.skin = 3e-3});
    CHECK(strict.levels[3].none + strict.levels[3].several > 0);
    CHECK(lax.levels[3].none + lax.levels[3].several == 0);
    CHECK(lax.levels[3].points < strict.levels[3].points);
}

TEST_CASE("coverage of all levels at once agrees with each fragment's own inside test") {
    FractureSet set = makeFracturedCube(threeLevels());
    // A leaf grown over its neighbours, one shrunk from them.
    const uint32_t last = lastFragment(set);
    forEachVertexOf(set, last, [](glm::vec3& p) { p *= 1.2F; });
    forEachVertexOf(set, last - 20, [](glm::vec3& p) { p *= 0.8F; });
    const Solid solid(makeFracturedCube(threeLevels()));
    const ShownTriangles shown(set);
    const LevelCoverage coverage = levelCoverage(shown, treeOf(shown), solid.view());
    for (uint32_t level = 0; level < 4; ++level) {
        CAPTURE(level);
        std::vector<std::vector<std::array<uint32_t, 3>>> triangles;
        for (const uint32_t f : fragmentsAtLevel(set, level))
            triangles.push_back(fragmentTriangles(set, f));
        std::vector<TriangleSoup> fragments;
        fragments.reserve(triangles.size());
        for (const auto& t : triangles) fragments.push_back({set.geometry.positions, t});
        const Coverage each = measureCoverage({solid.positions, solid.triangles}, fragments);
        const LevelCoverage::Level& all = coverage.levels[level];
        CHECK(static_cast<double>(all.none) / all.points ==
              doctest::Approx(each.noneShare()).epsilon(0.1));
        CHECK(static_cast<double>(all.several) / all.points ==
              doctest::Approx(each.severalShare()).epsilon(0.1));
    }
}

TEST_CASE("how far a hidden corner sticks out is measured, and which fragments it belongs to") {
    FractureSet set = makeFracturedCube(threeLevels());
    const uint32_t last = lastFragment(set);
    // A corner of the object, which hidden faces do not have, and the hidden one opposite to it.
    forEachVertexOf(set, last, [](glm::vec3& p) {
        if (p.x < 0.4F && p.y < 0.8F && p.z < 0.3F) p.x = 0.75F;
    });
    const BakedObjectReport report = measured(set, true);
    CHECK(report.fragments[last].protrusion.value() == doctest::Approx(0.25));
    CHECK(report.levels[3].protrusion.value() == doctest::Approx(0.25));
    CHECK(report.levels[0].protrusion.value() == 0);
    CHECK(report.fragments[1].protrusion.value() < 1e-7);
    const auto found = std::find_if(report.findings.begin(), report.findings.end(),
                                    [](const BakeFinding& f) { return f.code == "protrusion"; });
    CHECK(found != report.findings.end());
}

TEST_CASE("a middle of an edge that leaves the solid sticks out although its ends do not") {
    // A hidden face between two solids.
    Shape shape = box({0, 0, 0}, {2, 1, 1});
    FractureSet set = setOf(shape);
    set.fragments[0].children = {1, 1};
    set.fragments.emplace_back();
    set.fragments[1].parent = 0;
    set.fragments[1].level = 1;
    set.levels.push_back({{1, 1}, ""});
    const auto base = static_cast<uint32_t>(set.geometry.positions.size());
    for (const glm::vec3& p : {glm::vec3(0.1F, 0.5F, 0.5F), {1.9F, 0.5F, 0.5F}, {1, 0.6F, 0.5F}})
        set.geometry.positions.push_back(p);
    const auto first = static_cast<uint32_t>(set.geometry.indices.size());
    for (uint32_t k = 0; k < 3; ++k) set.geometry.indices.push_back(base + k);
    set.geometry.primitives.push_back({0, 1, {first, 3}});
    set.fragmentRanges = {{0, first}, {first, 3}, {0, first}, {first, 3}};
    // The solid has a slot where the middle of the edge lies.
    Shape two = box({0, 0, 0}, {0.8F, 1, 1});
    two.append(box({1.2F, 0, 0}, {2, 1, 1}));
    const InsideTest test(two.positions, two.triangles);
    const InsideCells cells(test, two.positions, two.triangles);
    const ShownTriangles shown(set);
    const auto protrusion = protrusions(shown, {two.positions, two.triangles, cells}, 2);
    CHECK(protrusion[1] == doctest::Approx(0.2));
    CHECK(protrusion[0] == 0);
}

TEST_CASE("pieces that pass through themselves are counted pair by pair") {
    Shape shape = box({0, 0, 0}, {1, 1, 1});
    CHECK(crossingsOf(setOf(shape)) == 0);
    // A rod through two faces, off their diagonals: each of its 8 sides crosses both.
    shape.append(box({0.6F, 0.2F, -1}, {0.7F, 0.3F, 2}));
    const FractureSet rod = setOf(shape);
    const ShownTriangles shown(rod);
    uint64_t expected = 0;
    for (uint32_t a = 0; a < shown.triangles().size(); ++a)
        for (uint32_t b = a + 1; b < shown.triangles().size(); ++b)
            expected += CrossingTest(shown.places(a)).crosses(shown.places(b)) ? 1 : 0;
    const SelfIntersections found = selfIntersections(shown, treeOf(shown));
    CHECK(found.ofFragment[0] == expected);
    CHECK(expected == 16);
    CHECK(found.complete);
}

TEST_CASE("crossings between pieces belong to the coarser piece that shows both, if any does") {
    FractureSet set = makeFracturedCube(threeLevels());
    const uint32_t last = lastFragment(set);
    // The last leaf moves through its neighbour's outer face.
    forEachVertexOf(set, last, [](glm::vec3& p) { p += glm::vec3(-0.3F, 0.01F, 0.02F); });
    const ShownTriangles shown(set);
    const SelfIntersections found = selfIntersections(shown, treeOf(shown));
    CHECK(found.ofFragment[last] == 0);
    const auto parent = static_cast<uint32_t>(set.fragments[last].parent);
    CHECK(found.ofFragment[parent] > 0);
    CHECK(found.ofFragment[0] > 0);
    CHECK(found.ofFragment[1] == 0);
}

TEST_CASE("triangles piled in one place end the search, whatever the threads") {
    Shape pile;
    for (int i = 0; i < 3000; ++i) pile.append({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    const FractureSet set = setOf(pile);
    const ShownTriangles shown(set);
    const SelfIntersections one =
        selfIntersections(shown, treeOf(shown), {.pairsPerTriangle = 10, .threads = 1});
    const SelfIntersections four =
        selfIntersections(shown, treeOf(shown), {.pairsPerTriangle = 10, .threads = 4});
    CHECK_FALSE(one.complete);
    CHECK(one.ofFragment[0] >= 30'000);
    CHECK(one.ofFragment[0] == four.ofFragment[0]);
}

TEST_CASE("the thickness of a plate is the plate's, whatever else it has") {
    Shape plate = box({0, 0, 0}, {1, 1, 0.02F}, 4);
    plate.append(box({3, 0, 0}, {4, 1, 1}));
    CHECK(thinnestParts(setOf(plate))[0] == doctest::Approx(0.02));
    // A wedge is thin at its edge only: a tenth of it lies within 0.11 of the edge.
    Shape wedge = box({0, 0, 0}, {1, 1, 0.1F});
    for (glm::vec3& p : wedge.positions)
        if (p.x == 0) p.z = 0;
    const double share = thinnestParts(setOf(wedge), {.samples = 4096})[0];
    CHECK(share == doctest::Approx(0.011).epsilon(0.05));
}

TEST_CASE("nothing without a surface has a thickness") {
    CHECK(thinnestParts(setOf({}))[0] == 0);
    CHECK(thinnestParts(setOf({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}))[0] == 0);
    CHECK(fragmentAreas(ShownTriangles(setOf({})))[0].whole == 0);
}
