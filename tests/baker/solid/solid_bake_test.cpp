// SPDX-License-Identifier: MIT
// Whole bakes with a solid interior, judged by coverage and by the file check.
#include "solid/solid_bakes.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("a plate of twelve triangles breaks into full pieces by a pattern") {
    SolidJudge{meshOf(box({0, 0, 0}, {1, 1, 0.1F})), pattern("voronoi:13:1")}.check(13);
    SolidJudge{meshOf(box({0, 0, 0}, {1, 1, 0.1F})), pattern("voronoi:58:1")}.check(58);
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

TEST_CASE("a ring, whose cells meet in many places inside, breaks into full pieces") {
    SolidJudge{meshOf(torusShape(1, 0.35F, 40, 16)), pattern("voronoi:40:1")}.check(40);
}

TEST_CASE("cells of a deeper level meet those of a shallower one inside") {
    FracturePlan plan = pattern("voronoi:8:1");
    plan.patterns.push_back({*parsePattern("voronoi:40:2"), 2, nullptr});
    SolidJudge{meshOf(box({0, 0, 0}, {1, 1, 1}, 3)), plan}.check(40);
}

TEST_CASE("what cannot be cut through keeps its sheet, and the report says so") {
    // An open box has no inside that cells could divide.
    Shape open = box({0, 0, 0}, {1, 1, 1}, 4);
    open.triangles.pop_back();
    const SurfaceMesh mesh = meshOf(open);
    Recipe recipe = solidRecipe();
    recipe.allowOpen = true;
    const Result<BakedObject> baked = bakeObject(mesh, pattern("voronoi:13:1"), recipe, {});
    if (!baked) FAIL(baked.error().message);
    REQUIRE(fellBack(*baked));
    CHECK(hasSheet(baked->set));
    CHECK(baked->report.levels[1].closed == 13);
    CHECK(checkBaked(mesh, pattern("voronoi:13:1"), recipe).passed());
}
