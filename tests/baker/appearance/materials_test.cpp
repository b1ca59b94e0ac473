// SPDX-License-Identifier: MIT
// Which material lies under which.
#include <doctest/doctest.h>

#include <set>

#include "support/baked_set.h"
#include "support/hidden_looks.h"
#include "support/pattern_plans.h"
#include "support/plans.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// The cube [0, 1]^3 cut all around at z = 0.4 (level 1) and 0.7 (level 2).
FracturePlan twoRings() {
    FractureMap map;
    for (const auto& [z, level] : {std::pair{0.4, 1U}, std::pair{0.7, 2U}}) {
        for (int face : {0, 1})
            map.lines.push_back({{cubeUv(face, -0.01, z), cubeUv(face, 1.01, z)}, level, "ring"});
        for (int face : {2, 3})
            map.lines.push_back({{cubeUv(face, z, -0.01), cubeUv(face, z, 1.01)}, level, "ring"});
    }
    return planOf(map);
}

/// Faces +x and -x have material 1, the others material 0.
SurfaceMesh twoMaterials(int cells = 4) {
    SurfaceMesh cube = chartedCube(1, cells);
    cube.materials = {0, 1};
    const size_t perFace = cube.triangles.size() / 6;
    for (size_t t = 0; t < 2 * perFace; ++t) cube.triangleMaterials[t] = 1;
    return cube;
}

Recipe withMaterials(std::map<std::string, std::string> below, std::string other = "") {
    Recipe recipe;
    recipe.file = "r.json";
    recipe.wrap = PageWrap::none;
    recipe.interior.materials = std::move(below);
    recipe.interior.material = std::move(other);
    return recipe;
}

const std::vector<std::string> kNames = {"plaster", "paint", "brick", "rust"};

Error errorOf(const Recipe& recipe) {
    const Result<BakedFile> baked =
        bakeModel(modelAround(twoMaterials(), kNames), twoRings(), recipe);
    REQUIRE_FALSE(baked.has_value());
    return baked.error();
}

/// glTF materials of hidden faces, and whether the wall faces of each lie under the paint, judged
/// by place: a wall hangs from a side of the cube.
struct Judged {
    std::set<int32_t> materials;
    uint32_t walls = 0, wrong = 0;
};

Judged judge(const FractureSet& set, int32_t underPaint, int32_t underPlaster) {
    Judged judged;
    for (const Primitive& p : set.geometry.primitives) {
        if (p.exposedFrom == 0) continue;
        const int32_t material = set.materials[p.material];
        judged.materials.insert(material);
        if (p.sheet) continue;
        for (uint32_t i = p.indices.first; i < p.indices.first + p.indices.count; i += 3) {
            // The corners on the skin say which side of the cube the wall hangs from.
            bool onX = true, onY = true;
            for (uint32_t k = 0; k < 3; ++k) {
                const glm::vec3& q = set.geometry.positions[set.geometry.indices[i + k]];
                const auto skin = [](float c) { return c == 0 || c == 1; };
                if (!skin(q.x) && !skin(q.y)) continue;
                onX = onX && skin(q.x);
                onY = onY && skin(q.y);
            }
            if (onX == onY) continue;
            ++judged.walls;
            judged.wrong += material == (onX ? underPaint : underPlaster) ? 0 : 1;
        }
    }
    return judged;
}

}  // namespace

TEST_CASE("hidden faces get the material named for the outer one above them") {
    const FractureSet set = writtenSet(modelAround(twoMaterials(), kNames), twoRings(),
                                       withMaterials({{"paint", "rust"}, {"plaster", "brick"}}));
    CHECK(set.materials == std::vector<int32_t>{0, 1, 2, 3});
    const Judged judged = judge(set, 3, 2);
    CHECK(judged.materials == std::set<int32_t>{2, 3});
    CHECK(judged.walls > 100);
    CHECK(judged.wrong == 0);
    CHECK(judge(set, 2, 3).wrong == judged.walls);  // the judge tells them apart
}

TEST_CASE("materials that are not named share the one for all, or a neutral one") {
    const Model model = modelAround(twoMaterials(), kNames);
    const FractureSet named =
        writtenSet(model, twoRings(), withMaterials({{"paint", "rust"}}, "brick"));
    CHECK(judge(named, 3, 2).wrong == 0);
    const FractureSet neutral = writtenSet(model, twoRings(), withMaterials({{"paint", "rust"}}));
    CHECK(judge(neutral, 3, 4).wrong == 0);
    const FractureSet plain = writtenSet(model, twoRings(), withMaterials({}));
    CHECK(plain.materials == std::vector<int32_t>{0, 1, 4});
    CHECK(judge(plain, 4, 4).wrong == 0);
}

TEST_CASE("one inner material below two outer ones makes no more primitives than one") {
    const Model model = modelAround(twoMaterials(), kNames);
    const FractureSet one = writtenSet(model, twoRings(), withMaterials({}, "brick"));
    const FractureSet two =
        writtenSet(model, twoRings(), withMaterials({{"paint", "brick"}, {"plaster", "brick"}}));
    CHECK(one.geometry.primitives.size() == two.geometry.primitives.size());
    CHECK(one.geometry.indices == two.geometry.indices);
}

TEST_CASE("an unknown material is refused with its place in the recipe and the names there are") {
    const Error inner = errorOf(withMaterials({{"paint", "wool"}}));
    CHECK(inner.code == ErrorCode::badArgument);
    CHECK(inner.where == "r.json#/interior/materials/paint");
    CHECK(inner.message.find("\"wool\"") != std::string::npos);
    CHECK(inner.message.find("\"plaster\", \"paint\", \"brick\", \"rust\"") != std::string::npos);
    const Error outer = errorOf(withMaterials({{"a/b~c", "rust"}}));
    CHECK(outer.where == "r.json#/interior/materials/a~1b~0c");
    CHECK(outer.message.find("a/b~c") != std::string::npos);
    CHECK(errorOf(withMaterials({}, "wool")).where == "r.json#/interior/material");
    CHECK(errorOf(withMaterials({{"", "rust"}})).code == ErrorCode::badArgument);
}

TEST_CASE("a mesh without texture coordinates gets them for a material chosen for its inside") {
    SurfaceMesh mesh = twoMaterials();
    mesh.uvSemantic.clear();
    mesh.attributes.pop_back();
    const FracturePlan plan = patterns({"voronoi:5"});
    const Model model = modelAround(mesh, kNames);
    CHECK(attributeOf(writtenSet(model, plan), "TEXCOORD_0") == nullptr);
    const FractureSet set = writtenSet(model, plan, withMaterials({}, "brick"));
    REQUIRE(attributeOf(set, "TEXCOORD_0") != nullptr);
    CHECK(texelDensity(set, 1e-10).byArea < 1.5);
}
