// SPDX-License-Identifier: MIT
// Bakes with a solid interior, and what there is to say of them.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "interior/shapes.h"
#include "sherd/baker/bake.h"
#include "sherd/formats/fracture_set.h"
#include "support/baked_file.h"
#include "support/coverage.h"

namespace sherd::test {

inline FracturePlan pattern(const std::string& text) {
    FracturePlan plan;
    plan.patterns.push_back({*parsePattern(text), 1, nullptr});
    return plan;
}

inline SurfaceMesh meshOf(const Shape& shape) {
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

inline Recipe solidRecipe() {
    Recipe recipe;
    recipe.interior.type = InteriorType::solid;
    return recipe;
}

inline bool fellBack(const BakedObject& baked) {
    return std::any_of(baked.report.findings.begin(), baked.report.findings.end(),
                       [](const BakeFinding& f) { return f.code == "solid-fallback"; });
}

inline Coverage coverageOf(const SurfaceMesh& mesh, const FractureSet& set, uint32_t level) {
    std::vector<std::vector<std::array<uint32_t, 3>>> triangles;
    const std::vector<uint32_t> fragments = fragmentsAtLevel(set, level);
    triangles.reserve(fragments.size());
    for (const uint32_t f : fragments) triangles.push_back(fragmentTriangles(set, f));
    std::vector<TriangleSoup> soups;
    soups.reserve(triangles.size());
    for (const auto& t : triangles) soups.push_back({set.geometry.positions, t});
    return measureCoverage({mesh.positions, mesh.triangles}, soups);
}

inline bool hasSheet(const FractureSet& set) {
    return std::any_of(set.geometry.primitives.begin(), set.geometry.primitives.end(),
                       [](const Primitive& p) { return p.sheet; });
}

/// A bake that is to be solid throughout.
struct SolidJudge {
    SurfaceMesh mesh;
    FracturePlan plan;
    Recipe recipe = solidRecipe();

    /// All pieces full, at every level, without a sheet; and the file check agrees.
    FractureSet check(size_t pieces) const {
        FractureSet set = check();
        CHECK(fragmentsAtLevel(set, static_cast<uint32_t>(set.levels.size()) - 1).size() == pieces);
        return set;
    }
    FractureSet check() const {
        Result<BakedObject> baked = bakeObject(mesh, plan, recipe, {});
        if (!baked) FAIL(baked.error().message);
        const FractureSet& set = baked->set;
        CHECK_FALSE(fellBack(*baked));
        CHECK_FALSE(hasSheet(set));
        for (uint32_t level = 1; level < set.levels.size(); ++level) {
            const Coverage coverage = coverageOf(mesh, set, level);
            CHECK(coverage.none == 0);
            CHECK(coverage.several == 0);
            CHECK(baked->report.levels[level].volumeShare == doctest::Approx(1).epsilon(1e-5));
        }
        CHECK(checkBaked(mesh, plan, recipe).passed());
        return std::move(baked->set);
    }
};

}  // namespace sherd::test
