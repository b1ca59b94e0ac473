// SPDX-License-Identifier: MIT
// Real models with a solid interior: those of one part hardly ever need a sheet.
#include <filesystem>

#include "sherd/baker/import.h"
#include "solid/solid_bakes.h"
#include "support/models.h"
#include "support/plans.h"

using namespace sherd;
using namespace sherd::test;

namespace {

SurfaceMesh load(const char* name) {
    const Result<Model> model = importModel(sharedDir() / "models/dev" / name, {});
    if (!model) FAIL(model.error().message);
    return model->meshes.at(0);
}

}  // namespace

TEST_CASE("the barrel breaks into full pieces by patterns of 13 and 58 cells") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    const SurfaceMesh barrel = load("barrel.glb");
    SolidJudge{barrel, pattern("voronoi:13:1")}.check(13);
    SolidJudge{barrel, pattern("voronoi:58:1")}.check(58);
}

TEST_CASE("scans break into full pieces by a pattern") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    SolidJudge{load("spot_triangulated.obj"), pattern("voronoi:58:1")}.check(58);
    SolidJudge{load("egyptian_cat_statue.glb"), pattern("voronoi:13:1")}.check(13);
}

TEST_CASE("the barrel breaks into full pieces along the lines of its map of 68 components") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    const SurfaceMesh barrel = load("barrel.glb");
    const Result<FractureMap> map = readFractureMap(sharedDir() / "maps/barrel_68.svg", {});
    if (!map) FAIL(map.error().message);
    // Two of the components are slivers that join a neighbour.
    SolidJudge{barrel, planOf(*map)}.check(66);
}
