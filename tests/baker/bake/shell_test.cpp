// SPDX-License-Identifier: MIT
// Shells: as thick as asked, never past the middle, and what open surfaces get.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "bake_findings.h"
#include "sherd/baker/bake.h"
#include "support/models.h"
#include "support/pattern_plans.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

Recipe shellOf(double thickness) {
    Recipe recipe;
    recipe.interior.type = InteriorType::shell;
    recipe.interior.shell.thickness = thickness;
    return recipe;
}

BakedObject baked(const SurfaceMesh& mesh, const Recipe& recipe, const char* text = "voronoi:9:3") {
    Result<BakedObject> result = bakeObject(mesh, patterns({text}), recipe, -1);
    INFO((result ? "" : result.error().message));
    REQUIRE(result.has_value());
    for (const BakedLevelReport& level : result->report.levels) {
        if (&level != &result->report.levels[0]) CHECK(level.closed == level.fragments);
    }
    return std::move(*result);
}

double volumeOf(const BakedObject& object) {
    double volume = 0;
    for (const Fragment& f : object.set.fragments)
        if (f.level == 1) volume += f.volume;
    return volume;
}

/// A square in the plane z = 0, n x n quads, seen from above.
SurfaceMesh sail(int n) {
    SurfaceMesh mesh = chartedCube(1, n);
    std::vector<std::array<uint32_t, 3>> triangles, corners;
    std::vector<uint32_t> materials;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        if (mesh.positions[a].z < 1 || mesh.positions[b].z < 1 || mesh.positions[c].z < 1) continue;
        triangles.push_back(mesh.triangles[t]);
        corners.push_back(mesh.corners[t]);
        materials.push_back(mesh.triangleMaterials[t]);
    }
    mesh.triangles = triangles;
    mesh.corners = corners;
    mesh.triangleMaterials = materials;
    return mesh;
}

}  // namespace

TEST_CASE("a shell of a cube holds what lies within its thickness of the skin") {
    for (const double t : {0.05, 0.1, 0.2}) {
        const BakedObject object = baked(chartedCube(1, 1), shellOf(t));
        const double hollow = std::pow(1 - 2 * t, 3);
        CHECK(volumeOf(object) == doctest::Approx(1 - hollow).epsilon(0.01));
    }
}

TEST_CASE("a shell thicker than the solid ends at the medial surface") {
    Recipe medial;
    const BakedObject whole = baked(chartedCube(1, 3), medial);
    const BakedObject shell = baked(chartedCube(1, 3), shellOf(100));
    // Near points of medial sheets are put together, those of shells are not.
    CHECK(volumeOf(shell) == doctest::Approx(volumeOf(whole)).epsilon(1e-3));
}

TEST_CASE("a hollow shell is no finding, hollow medial pieces and overfull shells are") {
    const auto speaks = [](const BakedObjectReport& report) {
        return std::any_of(report.findings.begin(), report.findings.end(),
                           [](const BakeFinding& f) { return f.code == "volume"; });
    };
    const BakedObject shell = baked(chartedCube(1, 1), shellOf(0.05));
    CHECK(shell.report.levels[1].volumeShare < 0.5);
    CHECK_FALSE(speaks(shell.report));
    const auto judged = [&](double objectVolume, bool shells) {
        BakedObjectReport report;
        report.volume = objectVolume;
        report.levels.resize(2);
        reportFragments(shell.set, shells, report);
        return speaks(report);
    };
    CHECK(judged(1, false));
    CHECK_FALSE(judged(1, true));
    CHECK(judged(0.9 * volumeOf(shell), true));
}

TEST_CASE("an attribute scales a shell's thickness, and one that is not there is an error") {
    SurfaceMesh mesh = chartedCube(1, 4);
    const size_t count = mesh.attributes[0].values.size() / mesh.attributes[0].components;
    Attribute thickness;
    thickness.semantic = "_THICK";
    thickness.components = 2;
    for (size_t v = 0; v < count; ++v) {
        thickness.values.push_back(0);
        thickness.values.push_back(0.5F);
    }
    mesh.attributes.push_back(thickness);
    Recipe recipe = shellOf(0.2);
    recipe.interior.shell.attribute = "_THICK";
    recipe.interior.shell.channel = 1;
    CHECK(volumeOf(baked(mesh, recipe)) ==
          doctest::Approx(volumeOf(baked(mesh, shellOf(0.1)))).epsilon(1e-6));

    recipe.interior.shell.channel = 3;
    Result<BakedObject> result = bakeObject(mesh, patterns({"voronoi:4"}), recipe, -1);
    REQUIRE_FALSE(result.has_value());
    CHECK(result.error().message.find("2 channels") != std::string::npos);
    recipe.interior.shell.attribute = "_NO";
    result = bakeObject(mesh, patterns({"voronoi:4"}), recipe, -1);
    REQUIRE_FALSE(result.has_value());
    CHECK(result.error().message.find("NORMAL") != std::string::npos);
}

TEST_CASE("a picture scales a shell's thickness, white as said and black nothing") {
    const SurfaceMesh mesh = chartedCube(1, 4);
    Recipe recipe = shellOf(0.2);
    recipe.interior.shell.texture = "thick.png";
    recipe.interior.shell.picture =
        std::make_shared<const GreyImage>(GreyImage{1, 1, std::vector<uint8_t>{51}});
    CHECK(volumeOf(baked(mesh, recipe)) ==
          doctest::Approx(volumeOf(baked(mesh, shellOf(0.04)))).epsilon(1e-6));
    recipe.interior.shell.picture = nullptr;
    const Result<BakedObject> unread = bakeObject(mesh, patterns({"voronoi:4"}), recipe, -1);
    REQUIRE_FALSE(unread.has_value());
    CHECK(unread.error().code == ErrorCode::badArgument);
}

TEST_CASE("an open sail becomes closed pieces of a shell of even thickness") {
    Recipe recipe;
    recipe.allowOpen = true;
    recipe.interior.shell.thickness = 0.05;
    for (const int n : {1, 6}) {
        const BakedObject object = baked(sail(n), recipe);
        CHECK(volumeOf(object) == doctest::Approx(0.05).epsilon(0.001));
        for (const Fragment& f : object.set.fragments)
            if (f.level == 1) CHECK(f.volume > 0);
    }
}

TEST_CASE("open models of real life become closed pieces that hold something") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no shared models");
        return;
    }
    for (const char* name : {"Avocado.glb", "WaterBottle.glb", "kaykit_pillar_decorated.glb",
                             "kaykit_wall_window_closed.glb", "Lantern.glb", "SciFiHelmet.glb"}) {
        INFO(name);
        const Result<Model> model = importModel(sharedDir() / "models" / "dev" / name, {});
        REQUIRE(model.has_value());
        Recipe recipe;
        recipe.allowOpen = true;
        for (const SurfaceMesh& mesh : model->meshes) {
            const BakedObject object = baked(mesh, recipe, "voronoi:13:1");
            for (const Fragment& f : object.set.fragments)
                if (f.level == 1) CHECK(f.volume > 0);
        }
    }
}
