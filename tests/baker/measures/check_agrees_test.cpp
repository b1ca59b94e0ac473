// SPDX-License-Identifier: MIT
// The baker's measures and those of `check`, which share no code: two ways to the same numbers.
#include <doctest/doctest.h>

#include <cmath>

#include "sherd/baker/bake.h"
#include "sherd/formats/validate.h"
#include "support/models.h"
#include "support/plans.h"
#include "support/surface_meshes.h"

#include "measures/measures.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Lines around a torus or across a cube's charts: enough to have several pieces on two levels.
FracturePlan grid() {
    FractureMap map;
    for (const double at : {0.21, 0.74}) map.lines.push_back({{{at, -0.01}, {at, 1.01}}, 1, "u"});
    for (const double at : {0.33, 0.81}) map.lines.push_back({{{-0.01, at}, {1.01, at}}, 2, "v"});
    return planOf(map);
}

void compare(const FractureSet& set, const BakedObjectReport& report) {
    CheckOptions options;
    options.coverage = options.shapes = true;
    CheckReport check;
    checkFractureSet(set, options, 0, check);
    const ObjectReport& object = check.objects[0];
    CHECK(object.diagonal == doctest::Approx(report.diagonal).epsilon(1e-5));
    REQUIRE(object.levels.size() == report.levels.size());
    double protrusion = 0;
    for (size_t k = 0; k < report.levels.size(); ++k) {
        CAPTURE(k);
        const BakedLevelReport& ours = report.levels[k];
        const LevelReport& theirs = object.levels[k];
        CHECK(theirs.hiddenShare == doctest::Approx(ours.hiddenShare).epsilon(1e-6));
        CHECK(static_cast<uint64_t>(theirs.selfIntersections) == ours.selfIntersections);
        CHECK(std::abs(theirs.coverageNone - ours.coverageNone.value()) < 0.005);
        CHECK(std::abs(theirs.coverageDouble - ours.coverageDouble.value()) < 0.005);
        // Two samplings of a tail; measured: within a third on real pieces, mostly. Pieces that
        // taper to an edge have a steep one.
        const double most = std::max(2 * ours.thinnest.value(), 0.01 * report.diagonal);
        CHECK(std::abs(theirs.thinnest - ours.thinnest.value()) < most);
        protrusion = std::max(protrusion, ours.protrusion.value());
    }
    CHECK(std::abs(object.protrusion - protrusion) < 1e-6 * report.diagonal);
}

void bakeAndCompare(const SurfaceMesh& mesh, const FracturePlan& plan) {
    Recipe recipe;
    recipe.measure = true;
    const Result<BakedObject> baked = bakeObject(mesh, plan, recipe, 0);
    if (!baked) FAIL(baked.error().message);
    compare(baked->set, baked->report);
}

}  // namespace

TEST_CASE("check measures a baked torus as the baker does") {
    bakeAndCompare(torus(24, 12), grid());
}

TEST_CASE("check measures a baked cube as the baker does") {
    FracturePlan plan;
    plan.patterns.push_back({parsePattern("voronoi:5").value()});
    bakeAndCompare(chartedCube(1, 3), plan);
}

TEST_CASE("they agree on pieces that were broken on purpose") {
    const SurfaceMesh mesh = torus(24, 12);
    Result<BakedObject> baked = bakeObject(mesh, grid(), {}, 0);
    REQUIRE(baked.has_value());
    FractureSet& set = baked->set;
    // Pull every hidden vertex of the last leaf outwards and past the surface.
    const uint32_t last = static_cast<uint32_t>(set.fragments.size()) - 1;
    const size_t primitives = set.geometry.primitives.size();
    for (size_t p = 0; p < primitives; ++p) {
        if (!set.geometry.primitives[p].sheet) continue;
        const Range range = set.fragmentRanges[last * primitives + p];
        for (uint32_t i = range.first; i < range.first + range.count; ++i) {
            glm::vec3& at = set.geometry.positions[set.geometry.indices[i]];
            at.z += 0.6F;
        }
    }
    const InsideTest test(mesh.positions, mesh.triangles);
    const InsideCells cells(test, mesh.positions, mesh.triangles);
    BakedObjectReport report;
    report.diagonal = baked->report.diagonal;
    report.levels.resize(set.levels.size());
    report.fragments.resize(set.fragments.size());
    report.fragments[0].closed = true;
    const OriginalSolid solid{mesh.positions, mesh.triangles, cells};
    measureSet(set, &solid, 2, report);
    CHECK(report.levels.back().selfIntersections.value() > 0);
    CHECK(report.levels.back().protrusion.value() > 0.01);
    compare(set, report);
}

TEST_CASE("check measures real models as the baker does") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    for (const char* name : {"barrel", "kaykit_box_large", "egyptian_cat_statue"}) {
        CAPTURE(name);
        const Result<Model> model =
            importModel(sharedDir() / "models/dev" / (std::string(name) + ".glb"), {});
        REQUIRE(model.has_value());
        FracturePlan plan;
        plan.patterns.push_back({parsePattern("voronoi:13").value()});
        bakeAndCompare(model->meshes[0], plan);
    }
}
