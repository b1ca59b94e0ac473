// SPDX-License-Identifier: MIT
// What a recipe says of strength, material and hold, in the fracture set.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sherd/baker/bake.h"
#include "support/baked_set.h"
#include "support/plans.h"
#include "support/property.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

RecipeAnchor below(const glm::dvec3& point, const glm::dvec3& normal = {0, 1, 0}) {
    RecipeAnchor anchor;
    anchor.point = point;
    anchor.normal = normal;
    anchor.where = "r.json#/anchors/0";
    return anchor;
}

RecipeAnchor box(const glm::dvec3& low, const glm::dvec3& high) {
    RecipeAnchor anchor;
    anchor.kind = RecipeAnchor::Kind::box;
    anchor.low = low;
    anchor.high = high;
    anchor.where = "r.json#/anchors/1";
    return anchor;
}

RecipeAnchor named(const std::string& label) {
    RecipeAnchor anchor;
    anchor.kind = RecipeAnchor::Kind::label;
    anchor.label = label;
    anchor.where = "r.json#/anchors/2";
    return anchor;
}

std::vector<Bond> anchorsOf(const FractureSet& set) {
    std::vector<Bond> anchors;
    for (const Bond& bond : set.bonds)
        if (bond.b == -1) anchors.push_back(bond);
    return anchors;
}

double areaOf(const std::vector<Bond>& bonds) {
    double area = 0;
    for (const Bond& bond : bonds) area += bond.area;
    return area;
}

/// A level each.
FracturePlan cutsOf(const std::vector<std::string>& cuts) {
    FracturePlan plan;
    for (const std::string& cut : cuts) plan.cuts.push_back(parseVolumeCut(cut).value());
    return plan;
}

FractureSet cutCube(const std::vector<std::string>& cuts, const Recipe& recipe) {
    return writtenSet(modelAround(chartedCube(1, 2)), cutsOf(cuts), recipe);
}

/// A recipe whose levels are these cuts.
Recipe recipeOf(const std::vector<std::string>& cuts) {
    Recipe recipe;
    for (const std::string& cut : cuts)
        recipe.levels.emplace_back().cut = parseVolumeCut(cut).value();
    return recipe;
}

}  // namespace

TEST_CASE("what stands below a plane is held by the surface there, clipped at the plane") {
    Recipe recipe;
    recipe.anchors = {below({0, 0.1, 0})};
    recipe.anchors[0].strength = 3e5;
    const std::vector<Bond> held = anchorsOf(cutCube({"slices:1x4x1"}, recipe));
    REQUIRE(held.size() == 1);
    CHECK(held[0].area == doctest::Approx(1 + 4 * 0.1));
    CHECK(held[0].centroid.y == doctest::Approx(0.4 * 0.05 / 1.4));
    CHECK(held[0].normal.y == doctest::Approx(-1));
    CHECK(held[0].strength == 3e5F);
    CHECK(held[0].toughness == 50.0F);
    // Of two slices the upper one is held by its part of the sides alone.
    recipe.anchors = {below({0, 0.4, 0})};
    const std::vector<Bond> two = anchorsOf(cutCube({"slices:1x4x1"}, recipe));
    REQUIRE(two.size() == 2);
    CHECK(std::max(two[0].area, two[1].area) == doctest::Approx(2));
    CHECK(std::min(two[0].area, two[1].area) == doctest::Approx(0.6));
}

TEST_CASE("a plane in which the object stands holds it, and touching from above is no hold") {
    Recipe recipe;
    recipe.anchors = {below({0, 0, 0})};
    const std::vector<Bond> ground = anchorsOf(cutCube({"slices:1x4x1"}, recipe));
    REQUIRE(ground.size() == 1);
    CHECK(ground[0].area == doctest::Approx(1));
    // A cut right at the plane: only what is below it is held.
    recipe.anchors = {below({7, 0.25, 7})};
    CHECK(anchorsOf(cutCube({"slices:1x4x1"}, recipe)).size() == 1);
    recipe.anchors = {below({0, 0.75, 0}, {0, -2, 0})};
    const std::vector<Bond> top = anchorsOf(cutCube({"slices:1x4x1"}, recipe));
    REQUIRE(top.size() == 1);
    CHECK(top[0].area == doctest::Approx(2));
    CHECK(top[0].normal.y == doctest::Approx(1));
}

TEST_CASE("anchors stand in the scene, wherever the object does") {
    SurfaceMesh mesh = chartedCube(1, 2);
    mesh.restPose.translation = {5, -3, 2};
    mesh.restPose.rotation = glm::angleAxis(static_cast<float>(M_PI / 2), glm::vec3(0, 0, 1));
    // The object's x is up now: it reaches from y = -3 to -2.
    Recipe recipe;
    recipe.anchors = {below({0, -2.9, 0})};
    const Result<BakedObject> baked = bakeObject(mesh, cutsOf({"slices:4x1x1"}), recipe, 0);
    REQUIRE(baked.has_value());
    const std::vector<Bond> held = anchorsOf(baked->set);
    REQUIRE(held.size() == 1);
    CHECK(held[0].area == doctest::Approx(1.4));
    CHECK(held[0].normal.x == doctest::Approx(-1));
}

TEST_CASE("a box holds the surface in it, a place that two hold belongs to the first") {
    Recipe recipe;
    recipe.anchors = {box({-1, -1, -1}, {0.2, 0.2, 0.2})};
    CHECK(areaOf(anchorsOf(cutCube({"slices:2x2x2"}, recipe))) == doctest::Approx(3 * 0.04));
    recipe.anchors = {box({-1, -1, -1}, {0.2, 0.2, 0.2}), below({0, 0.1, 0})};
    recipe.anchors[0].strength = 1;
    recipe.anchors[1].strength = 2;
    const std::vector<Bond> both = anchorsOf(cutCube({"slices:2x2x2"}, recipe));
    double first = 0;
    double second = 0;
    for (const Bond& bond : both) (bond.strength == 1 ? first : second) += bond.area;
    CHECK(first == doctest::Approx(0.12));
    CHECK(second == doctest::Approx(1.4 - 0.04 - 2 * 0.02));
    // One that is left nothing is no mistake, but told.
    recipe.anchors = {below({0, 0.1, 0}), below({0, 0.1, 0})};
    recipe.anchors[1].where = "second";
    CHECK(areaOf(anchorsOf(cutCube({"slices:2x2x2"}, recipe))) == doctest::Approx(1.4));
    const Result<BakedObject> baked =
        bakeObject(chartedCube(1, 2), cutsOf({"slices:2x2x2"}), recipe, 0);
    REQUIRE(baked.has_value());
    CHECK(std::any_of(
        baked->report.findings.begin(), baked->report.findings.end(),
        [](const BakeFinding& f) { return f.code == "anchor-hidden" && f.where == "second"; }));
}

TEST_CASE("a piece is held by its name, by half the surface that no place holds") {
    FractureMap map;
    FractureMap::Label label;
    label.place = {true, glm::dvec3(0.5, 0.5, 1)};
    label.name = "block";
    map.labels = {label};
    FracturePlan plan = cutsOf({"slices:1x1x2"});
    plan.drawings.push_back({map, {}});
    Recipe recipe;
    recipe.anchors = {named("block"), below({0, 0, 0})};
    // Without lines the label is the whole object's.
    const FractureSet set = writtenSet(modelAround(chartedCube(1, 2)), plan, recipe);
    REQUIRE(set.fragments[0].name == "block");
    CHECK(areaOf(anchorsOf(set)) == doctest::Approx(1 + 0.5 * 5));
}

TEST_CASE("an anchor that holds nothing is found, and refused if no object has a use for it") {
    Recipe recipe;
    recipe.anchors = {below({0, -5, 0})};
    const FracturePlan plan = cutsOf({"slices:1x2x1"});
    const Result<BakedObject> baked = bakeObject(chartedCube(1, 1), plan, recipe, 0);
    REQUIRE(baked.has_value());
    const auto found = std::find_if(baked->report.findings.begin(), baked->report.findings.end(),
                                    [](const BakeFinding& f) { return f.code == "anchor-empty"; });
    REQUIRE(found != baked->report.findings.end());
    CHECK(found->where == "r.json#/anchors/0");
    for (const RecipeAnchor& anchor : {below({0, -5, 0}), box({2, 2, 2}, {3, 3, 3})}) {
        recipe.anchors = {anchor};
        const Result<BakedFile> file = bakeModel(modelAround(chartedCube(1, 1)), plan, recipe);
        REQUIRE_FALSE(file.has_value());
        CHECK(file.error().code == ErrorCode::badArgument);
        CHECK(file.error().where == anchor.where);
        CHECK(file.error().message.find("from (0, 0, 0) to (1, 1, 1)") != std::string::npos);
    }
    recipe.anchors = {named("foot")};
    const Result<BakedFile> file = bakeModel(modelAround(chartedCube(1, 1)), plan, recipe);
    REQUIRE_FALSE(file.has_value());
    CHECK(file.error().where == "r.json#/anchors/2");
    CHECK(file.error().message.find("\"foot\"") != std::string::npos);
}

TEST_CASE("what lies on either side of any plane adds up to the surface, and no less is held") {
    for (const uint32_t seed : propertySeeds(1, 20)) {
        CAPTURE(seed);
        Random random(seed);
        const glm::dvec3 point(random.unit(), random.unit(), random.unit());
        const glm::dvec3 normal(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
        const std::string cut =
            "voronoi:" + std::to_string(2 + random.below(8)) + ":" + std::to_string(seed);
        Recipe one;
        Recipe other;
        Recipe both;
        one.anchors = {below(point, normal)};
        other.anchors = {below(point, -normal)};
        both.anchors = {below(point, normal), below(point, -normal)};
        both.anchors[1].where = "second";
        const FractureSet set = cutCube({cut}, both);
        CHECK(areaOf(anchorsOf(set)) == doctest::Approx(6).epsilon(1e-4));
        CHECK(areaOf(anchorsOf(cutCube({cut}, one))) + areaOf(anchorsOf(cutCube({cut}, other))) ==
              doctest::Approx(6).epsilon(1e-4));
        for (const Bond& bond : anchorsOf(cutCube({cut}, one))) {
            CHECK(bond.area > 0);
            CHECK(glm::dot(glm::dvec3(bond.centroid) - point, normal) < 1e-6);
        }
    }
}

TEST_CASE("bonds are as strong as the level says at which their pieces part") {
    const std::vector<std::string> cuts{"slices:1x2x1", "slices:2x1x1"};
    Recipe recipe = recipeOf(cuts);
    recipe.levels[0].strength = 4e6;
    recipe.levels[1].toughness = 9;
    const FractureSet set = cutCube(cuts, recipe);
    int first = 0;
    int second = 0;
    for (const Bond& bond : set.bonds) {
        const bool upright = std::abs(bond.normal.y) > 0.9F;
        (upright ? first : second) += 1;
        CHECK(bond.strength == (upright ? 4e6F : 1e6F));
        CHECK(bond.toughness == (upright ? 50.0F : 9.0F));
    }
    CHECK(first == 2);
    CHECK(second == 2);
}

TEST_CASE(
    "a line says more than a label, a label more than a level, a level more than a material") {
    FractureMap map;
    for (const double z : {0.3, 0.6}) {
        for (const int face : {0, 1})
            map.lines.push_back({{cubeUv(face, -0.01, z), cubeUv(face, 1.01, z)}, 1, "ring", {}});
        for (const int face : {2, 3})
            map.lines.push_back({{cubeUv(face, z, -0.01), cubeUv(face, z, 1.01)}, 1, "ring", {}});
    }
    for (size_t i = 0; i < 4; ++i) map.lines[i].properties.strength = 7.0F;
    FractureMap::Label label;
    label.place = {true, glm::dvec3(0.5, 0.5, 1)};
    label.strength = 5.0F;
    map.labels = {label};
    Recipe recipe;
    recipe.levels.emplace_back().map = "rings.svg";
    recipe.levels[0].strength = 1000;
    recipe.levels[0].toughness = 2000;
    recipe.materials["stone"].strength = 3000;
    recipe.materials["stone"].toughness = 3000;
    SurfaceMesh mesh = chartedCube(1, 3);
    mesh.materials = {0};
    Recipe silent = recipe;
    silent.levels[0] = {};
    for (const bool levelled : {true, false}) {
        const FractureSet set =
            writtenSet(modelAround(mesh, {"stone"}), planOf(map), levelled ? recipe : silent);
        REQUIRE(set.bonds.size() == 2);
        for (const Bond& bond : set.bonds) {
            CHECK(bond.strength == (bond.centroid.z < 0.45F ? 7.0F : 5.0F));
            CHECK(bond.toughness == (levelled ? 2000.0F : 3000.0F));
        }
        for (const Fragment& fragment : set.fragments) CHECK(fragment.material == "stone");
    }
}

TEST_CASE("pieces are of the material that covers most of them, and a label knows better") {
    SurfaceMesh mesh = chartedCube(1, 2);
    mesh.materials = {1, 0};
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        mesh.triangleMaterials[t] = mesh.positions[mesh.triangles[t][0]].z +
                                                mesh.positions[mesh.triangles[t][1]].z +
                                                mesh.positions[mesh.triangles[t][2]].z >
                                            1.5F
                                        ? 1
                                        : 0;
    Recipe recipe;
    recipe.materials["brick"] = {1900, 0.8, 0.1, 2e6, 30};
    recipe.materials["glass"] = {2500, {}, {}, {}, {}};
    const Model model = modelAround(mesh, {"roof", "brick"});
    const FracturePlan cut = cutsOf({"slices:1x1x2"});
    // Nothing here is of glass, and nobody says so.
    const Result<BakedFile> unknown = bakeModel(model, cut, recipe);
    REQUIRE_FALSE(unknown.has_value());
    CHECK(unknown.error().where == "#/materials/glass");
    CHECK(unknown.error().message.find("\"brick\", \"roof\"") != std::string::npos);

    FractureMap map;
    FractureMap::Label label;
    label.place = {true, glm::dvec3(0.5, 0.5, 1)};
    label.material = "glass";
    label.level = 1;
    map.labels = {label};
    for (const int face : {0, 1})
        map.lines.push_back({{cubeUv(face, -0.01, 0.8), cubeUv(face, 1.01, 0.8)}, 1, "ring", {}});
    for (const int face : {2, 3})
        map.lines.push_back({{cubeUv(face, 0.8, -0.01), cubeUv(face, 0.8, 1.01)}, 1, "ring", {}});
    FracturePlan plan = cut;
    plan.drawings.push_back({map, {}});
    const FractureSet set = writtenSet(model, plan, recipe);
    int glass = 0;
    int brick = 0;
    int other = 0;
    for (size_t f = 1; f < set.fragments.size(); ++f) {
        const Fragment& fragment = set.fragments[f];
        if (fragment.children.count > 0) continue;
        if (fragment.material == "glass") {
            ++glass;
            CHECK(fragment.density == 2500.0F);
            CHECK(fragment.friction == 0.5F);
        } else if (fragment.material == "brick") {
            ++brick;
            CHECK(fragment.density == 1900.0F);
            CHECK(fragment.friction == 0.8F);
            CHECK(fragment.restitution == 0.1F);
            CHECK(fragment.strength == 2e6F);
            CHECK(fragment.toughness == 30.0F);
            CHECK(fragment.mass == doctest::Approx(1900 * fragment.volume));
        } else {
            ++other;
            CHECK(fragment.density == 1000.0F);
        }
    }
    CHECK(glass == 2);
    CHECK(brick == 1);
    CHECK(other == 1);
}
