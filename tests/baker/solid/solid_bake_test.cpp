// SPDX-License-Identifier: MIT
// Whole bakes with a solid interior, judged by coverage and by the file check.
#include "solid/solid_bakes.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("a plate of twelve triangles breaks into full pieces by a pattern") {
    SolidJudge{meshOf(box({0, 0, 0}, {1, 1, 0.1F})), pattern("voronoi:13:1")}.check(13);
}

TEST_CASE("a fine plate breaks into full pieces on two levels") {
    FracturePlan plan = pattern("voronoi:5:1");
    plan.patterns.push_back({*parsePattern("voronoi:14:2"), 2, nullptr});
    SolidJudge{meshOf(box({0, 0, 0}, {2, 1, 0.05F}, 6)), plan}.check(14);
}

TEST_CASE("a box breaks into full pieces that meet in its middle") {
    SolidJudge{meshOf(box({0, 0, 0}, {1, 1, 1})), pattern("voronoi:13:1")}.check(13);
    SolidJudge{meshOf(box({0, 0, 0}, {1, 2, 1}, 5)), pattern("voronoi:40:3")}.check(40);
}

TEST_CASE("a hollow box, whose two skins do not touch, breaks into full pieces") {
    Shape hollow = box({0, 0, 0}, {1, 1, 1}, 4);
    Shape inner = box({0.1F, 0.1F, 0.1F}, {0.9F, 0.9F, 0.9F}, 4);
    for (auto& t : inner.triangles) std::swap(t[0], t[1]);
    hollow.append(inner);
    SolidJudge{meshOf(hollow), pattern("voronoi:13:1")}.check(13);
}

TEST_CASE("what cannot be cut through keeps its sheet, and the report says so") {
    // A bar bent around nearly once: the middle of all its nodes lies outside of it.
    Shape bent = torus(1, 0.35F, 40, 16);
    const SurfaceMesh mesh = meshOf(bent);
    const Result<BakedObject> baked = bakeObject(mesh, pattern("voronoi:40:1"), solidRecipe(), {});
    if (!baked) FAIL(baked.error().message);
    REQUIRE(fellBack(*baked));
    CHECK(hasSheet(baked->set));
    CHECK(checkBaked(mesh, pattern("voronoi:40:1"), solidRecipe()).passed());
}
