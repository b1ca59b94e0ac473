// SPDX-License-Identifier: MIT
// Whole bakes with a solid interior, judged by coverage and by the file check.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "interior/coverage.h"
#include "interior/shapes.h"
#include "sherd/baker/bake.h"
#include "sherd/formats/fracture_set.h"
#include "support/baked_file.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FracturePlan pattern(const std::string& text) {
    FracturePlan plan;
    plan.patterns.push_back({*parsePattern(text), 1, nullptr});
    return plan;
}

SurfaceMesh meshOf(const Shape& shape) {
    SurfaceMesh mesh = shape.mesh();
    mesh.name = "made";
    mesh.materials = {-1};
    mesh.triangleMaterials.assign(mesh.triangles.size(), 0);
    std::vector<float> normals;
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        normals.insert(normals.end(), {0.0F, 0.0F, 1.0F});
    mesh.attributes = {{"NORMAL", 3, normals}};
    mesh.corners = mesh.triangles;
    return mesh;
}

Recipe solidRecipe() {
    Recipe recipe;
    recipe.interior.type = InteriorType::solid;
    return recipe;
}

bool fellBack(const BakedObject& baked) {
    return std::any_of(baked.report.findings.begin(), baked.report.findings.end(),
                       [](const BakeFinding& f) { return f.code == "solid-fallback"; });
}

Coverage coverageOf(const SurfaceMesh& mesh, const FractureSet& set, uint32_t level) {
    std::vector<std::vector<std::array<uint32_t, 3>>> triangles;
    for (const uint32_t f : fragmentsAtLevel(set, level))
        triangles.push_back(fragmentTriangles(set, f));
    std::vector<TriangleSoup> soups;
    for (const auto& t : triangles) soups.push_back({set.geometry.positions, t});
    return measureCoverage({mesh.positions, mesh.triangles}, soups);
}

bool hasSheet(const FractureSet& set) {
    return std::any_of(set.geometry.primitives.begin(), set.geometry.primitives.end(),
                       [](const Primitive& p) { return p.sheet; });
}

/// All pieces full, at every level, without a sheet; and the file check agrees.
void checkSolid(const SurfaceMesh& mesh, const FracturePlan& plan, size_t pieces) {
    const Result<BakedObject> baked = bakeObject(mesh, plan, solidRecipe(), {});
    if (!baked) FAIL(baked.error().message);
    CHECK_FALSE(fellBack(*baked));
    CHECK_FALSE(hasSheet(baked->set));
    CHECK(
        fragmentsAtLevel(baked->set, static_cast<uint32_t>(baked->set.levels.size()) - 1).size() ==
        pieces);
    for (uint32_t level = 1; level < baked->set.levels.size(); ++level) {
        const Coverage coverage = coverageOf(mesh, baked->set, level);
        CHECK(coverage.none == 0);
        CHECK(coverage.several == 0);
        CHECK(baked->report.levels[level].volumeShare == doctest::Approx(1).epsilon(1e-5));
    }
    CHECK(checkBaked(mesh, plan, solidRecipe()).passed());
}

}  // namespace

TEST_CASE("a plate of twelve triangles breaks into full pieces by a pattern") {
    checkSolid(meshOf(box({0, 0, 0}, {1, 1, 0.1F})), pattern("voronoi:13:1"), 13);
}

TEST_CASE("a fine plate breaks into full pieces on two levels") {
    FracturePlan plan = pattern("voronoi:5:1");
    plan.patterns.push_back({*parsePattern("voronoi:14:2"), 2, nullptr});
    checkSolid(meshOf(box({0, 0, 0}, {2, 1, 0.05F}, 6)), plan, 14);
}

TEST_CASE("a box breaks into full pieces that meet in its middle") {
    checkSolid(meshOf(box({0, 0, 0}, {1, 1, 1})), pattern("voronoi:13:1"), 13);
    checkSolid(meshOf(box({0, 0, 0}, {1, 2, 1}, 5)), pattern("voronoi:40:3"), 40);
}

TEST_CASE("a hollow box, whose two skins do not touch, breaks into full pieces") {
    Shape hollow = box({0, 0, 0}, {1, 1, 1}, 4);
    Shape inner = box({0.1F, 0.1F, 0.1F}, {0.9F, 0.9F, 0.9F}, 4);
    for (auto& t : inner.triangles) std::swap(t[0], t[1]);
    hollow.append(inner);
    checkSolid(meshOf(hollow), pattern("voronoi:13:1"), 13);
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
