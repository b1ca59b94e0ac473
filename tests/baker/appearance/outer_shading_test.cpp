// SPDX-License-Identifier: MIT
// How far cutting turns the normals that a renderer sees.
#include "appearance/outer_shading.h"

#include <doctest/doctest.h>

#include <cmath>

#include "sherd/baker/bake.h"
#include "support/pattern_plans.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// One triangle with these normals at its corners.
SurfaceMesh oneTriangle(const std::vector<float>& normals) {
    SurfaceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = mesh.corners = {{0, 1, 2}};
    mesh.triangleMaterials = {0};
    mesh.attributes.push_back({"NORMAL", 3, normals});
    return mesh;
}

/// The triangle cut from its last corner to the middle of the side before.
SplitSurface halved(const SurfaceMesh& mesh) {
    SplitSurface surface = uncutSurface(mesh);
    surface.positions.emplace_back(0.5F, 0, 0);
    surface.origins.push_back({{0, 1, 0}, {0.5, 0.5, 0}});
    surface.triangles = {{{0, 3, 2}, 0, {}}, {{3, 1, 2}, 0, {}}};
    return surface;
}

bool saysShading(const SurfaceMesh& mesh) {
    const Result<BakedObject> baked = bakeObject(mesh, patterns({"voronoi:6"}), {}, -1);
    REQUIRE(baked.has_value());
    for (const BakeFinding& finding : baked->report.findings)
        if (finding.code == "shading") return true;
    return false;
}

}  // namespace

TEST_CASE("without normals, without cuts and on flat triangles the light stays as it was") {
    SurfaceMesh bare = oneTriangle({});
    bare.attributes.clear();
    CHECK(shadingShift(bare, halved(bare), 0).triangles == 0);
    const SurfaceMesh flat = oneTriangle({0, 0, 1, 0, 0, 1, 0, 0, 1});
    CHECK(shadingShift(flat, halved(flat), 1e-6).triangles == 0);
    const SurfaceMesh bent = oneTriangle({1, 0, 0, 0, 1, 0, 1, 0, 0});
    CHECK(shadingShift(bent, uncutSurface(bent), 0).triangles == 0);
}

TEST_CASE("a quarter turn cut in halves turns normals by what paper and pencil say") {
    const SurfaceMesh bent = oneTriangle({1, 0, 0, 0, 1, 0, 1, 0, 0});
    const ShadingShift shift = shadingShift(bent, halved(bent), 1);
    CHECK(shift.triangles == 1);
    // A quarter of the way: atan(3) in the whole triangle, three quarters of 90 degrees in a half.
    CHECK(shift.degrees == doctest::Approx(std::atan(3) * 180 / M_PI - 67.5));
    CHECK(shadingShift(bent, halved(bent), 5).triangles == 0);
}

TEST_CASE("the report tells of a cube shaded as a ball, and of no cube with flat sides") {
    SurfaceMesh cube = chartedCube(1, 1);
    CHECK_FALSE(saysShading(cube));
    for (size_t t = 0; t < cube.triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec3 p = cube.positions[cube.triangles[t][k]] - glm::vec3(0.5F);
            for (Attribute& a : cube.attributes) {
                if (a.semantic != "NORMAL") continue;
                for (int i = 0; i < 3; ++i)
                    a.values[size_t{3} * cube.corners[t][k] + static_cast<size_t>(i)] =
                        p[i] / std::sqrt(0.75F);
            }
        }
    }
    CHECK(saysShading(cube));
}
