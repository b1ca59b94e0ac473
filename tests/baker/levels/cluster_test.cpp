// SPDX-License-Identifier: MIT
// Levels of groups, above cuts and above lines; judged by the file check and by what the written
// set holds.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sherd/baker/bake.h"
#include "sherd/baker/import.h"
#include "sherd/baker/recipe.h"
#include "support/baked_set.h"
#include "support/cube_ring.h"
#include "support/models.h"
#include "support/property.h"
#include "support/random_solids.h"
#include "support/solid_meshes.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// "cluster 4", "cut voronoi:9", "pattern voronoi:5".
FracturePlan planOf(const std::vector<std::string>& texts) {
    std::vector<FracturePlan> levels;
    for (const std::string& text : texts) {
        const std::string kind = text.substr(0, text.find(' '));
        const std::string what = text.substr(kind.size() + 1);
        FracturePlan& plan = levels.emplace_back();
        if (kind == "cluster") plan.clusters.push_back({parseCluster(what).value()});
        if (kind == "cut") plan.cuts.push_back(parseVolumeCut(what).value());
        if (kind == "pattern") plan.patterns.push_back({parsePattern(what).value(), 1, nullptr});
    }
    return stackLevels(std::move(levels));
}

std::vector<uint32_t> leavesOf(const FractureSet& set, uint32_t fragment) {
    const Range children = set.fragments[fragment].children;
    if (children.count == 0) return {fragment};
    std::vector<uint32_t> leaves;
    for (uint32_t c = children.first; c < children.first + children.count; ++c)
        for (const uint32_t leaf : leavesOf(set, c)) leaves.push_back(leaf);
    return leaves;
}

/// Whether bonds join all leaves of a fragment without leaving it.
bool holdsTogether(const FractureSet& set, uint32_t fragment) {
    const std::vector<uint32_t> leaves = leavesOf(set, fragment);
    const std::set<uint32_t> own(leaves.begin(), leaves.end());
    std::set<uint32_t> met{leaves[0]};
    for (size_t before = 0; before != met.size();) {
        before = met.size();
        for (const Bond& bond : set.bonds) {
            const auto a = static_cast<uint32_t>(bond.a), b = static_cast<uint32_t>(bond.b);
            if (bond.b < 0 || own.count(a) == 0 || own.count(b) == 0) continue;
            if (met.count(a) + met.count(b) == 1) met.insert({a, b});
        }
    }
    return met.size() == own.size();
}

bool hasFinding(const BakedObjectReport& report, const std::string& code) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [&](const BakeFinding& finding) { return finding.code == code; });
}

Error errorOf(const std::vector<std::string>& levels) {
    const Result<BakedObject> baked = bakeObject(chartedCube(1, 2), planOf(levels), {}, 0);
    REQUIRE_FALSE(baked.has_value());
    return baked.error();
}

}  // namespace

TEST_CASE("clusters are read with their keys, and refused with what could be") {
    const Cluster cluster =
        parseCluster("12:evenness=0.8:larger=0.1:near=0,1,0:within=2:name=head").value();
    CHECK(cluster.count == 12);
    CHECK(cluster.evenness == 0.8);
    CHECK(cluster.only.larger == 0.1);
    CHECK(cluster.only.near == std::vector<glm::dvec3>{{0, 1, 0}});
    CHECK(cluster.only.within == 2);
    CHECK(cluster.only.name == "head");
    for (const auto& [text, says] :
         std::vector<std::pair<const char*, const char*>>{{"", "from 1 to 10000"},
                                                          {"0", "from 1 to 10000"},
                                                          {"10001", "from 1 to 10000"},
                                                          {"8x", "from 1 to 10000"},
                                                          {"8:7", "known are evenness"},
                                                          {"8:evenness=2", "from 0 to 1"},
                                                          {"8:evenness=nan", "from 0 to 1"},
                                                          {"8:larger=-1", "from 0 to 1"},
                                                          {"8:near=1,2", "X,Y,Z"},
                                                          {"8:name=", "name"}}) {
        const std::string asked = text;
        CAPTURE(asked);
        const Result<Cluster> wrong = parseCluster(asked);
        REQUIRE_FALSE(wrong.has_value());
        CHECK(wrong.error().message.find(says) != std::string::npos);
    }
}

TEST_CASE("clusters group the pieces of a cut, groups in groups") {
    const FractureSet set = writtenSet(modelAround(chartedCube(1, 2)),
                                       planOf({"cluster 4", "cluster 12", "cut voronoi:60"}));
    REQUIRE(set.levels.size() == 4);
    CHECK(fragmentsAtLevel(set, 1).size() == 4);
    CHECK(fragmentsAtLevel(set, 2).size() == 12);
    CHECK(fragmentsAtLevel(set, 3).size() == 60);
    for (uint32_t level = 1; level <= 3; ++level)
        CHECK(volumeAt(set, level) == doctest::Approx(1).epsilon(1e-6));
    for (uint32_t f = 1; f < set.fragments.size(); ++f) {
        CHECK(holdsTogether(set, f));
        if (set.fragments[f].level != 1) continue;
        CHECK(set.fragments[f].volume > 0.15F);
        CHECK(set.fragments[f].volume < 0.35F);
    }
}

TEST_CASE("what leaves of a group share is not shown before it breaks") {
    const FractureSet set =
        writtenSet(modelAround(chartedCube(1, 1)), planOf({"cluster 3", "cut voronoi:30"}));
    std::map<uint32_t, double> bonds, hidden;  // area by level of exposure
    const size_t primitives = set.geometry.primitives.size();
    for (const Bond& bond : set.bonds) {
        const int32_t a = set.fragments[static_cast<size_t>(bond.a)].parent;
        const int32_t b = set.fragments[static_cast<size_t>(bond.b)].parent;
        bonds[a == b ? 2 : 1] += bond.area;
    }
    for (size_t p = 0; p < primitives; ++p) {
        const Primitive& primitive = set.geometry.primitives[p];
        for (uint32_t i = primitive.indices.first;
             i < primitive.indices.first + primitive.indices.count && primitive.exposedFrom > 0;
             i += 3) {
            const auto at = [&](uint32_t k) {
                return glm::dvec3(set.geometry.positions[set.geometry.indices[i + k]]);
            };
            hidden[primitive.exposedFrom] +=
                0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
        }
    }
    for (const uint32_t level : {1U, 2U}) {
        CHECK(bonds[level] > 0);
        CHECK(hidden[level] == doctest::Approx(2 * bonds[level]).epsilon(1e-5));
    }
}

TEST_CASE("groups stay within the pieces of the level before") {
    const FractureSet set = writtenSet(
        modelAround(chartedCube(1, 2)),
        planOf({"cut voronoi:3", "cluster 4", "cut voronoi:12", "cluster 2", "cut slices:2x2x2"}));
    REQUIRE(set.levels.size() == 6);
    for (uint32_t f = 1; f <= 3; ++f) CHECK(set.fragments[f].children.count == 4);
    for (uint32_t f = 1; f < set.fragments.size(); ++f) {
        if (set.fragments[f].level == 3) CHECK(set.fragments[f].children.count == 2);
        CHECK(holdsTogether(set, f));
    }
}

TEST_CASE("clusters above drawn levels group their components") {
    for (const InteriorType type : {InteriorType::medial, InteriorType::solid}) {
        CAPTURE(static_cast<int>(type));
        Recipe recipe;
        recipe.interior.type = type;
        const FractureSet set = writtenSet(
            modelAround(torus(12, 8)),
            planOf({"cluster 2", "pattern voronoi:6", "cluster 2", "pattern voronoi:24"}), recipe);
        REQUIRE(set.levels.size() == 5);
        CHECK(fragmentsAtLevel(set, 1).size() == 2);
        CHECK(fragmentsAtLevel(set, 2).size() == 6);
        for (uint32_t f = 1; f < set.fragments.size(); ++f) CHECK(holdsTogether(set, f));
        for (uint32_t level = 1; level <= 4; ++level)
            CHECK(volumeAt(set, level) == doctest::Approx(volumeAt(set, 4)).epsilon(1e-5));
    }
}

TEST_CASE("only chosen pieces are divided into groups, the others stand for themselves") {
    // 0.2, 0.3 and 0.5 of the cube, along z.
    const FractureSet set = writtenSet(modelAround(chartedCube(1, 1)),
                                       planOf({"cut points:0.5,0.5,0;0.5,0.5,0.4;0.5,0.5,0.6",
                                               "cluster 2:larger=0.25", "cut voronoi:8"}));
    CHECK(set.levels[2].fragments.count == 4);
    CHECK(set.fragments[1].children.count == 8);
    CHECK(set.fragments[2].children.count == 2);
    CHECK(set.fragments[3].children.count == 2);
    const Error none = errorOf({"cut voronoi:3", "cluster 2:larger=0.9", "cut voronoi:8"});
    CHECK(none.code == ErrorCode::badArgument);
    CHECK(none.message.find("3 pieces of") != std::string::npos);
}

TEST_CASE("a label keeps naming its component with a cluster above") {
    FractureMap map = ringAroundCube();
    FractureMap::Label label;
    label.name = "top";
    label.level = 1;
    label.place = {true, glm::dvec3(0.5, 0.5, 1)};
    map.labels.push_back(label);
    std::vector<FracturePlan> levels(4);
    levels[0].drawings.push_back({map, {}});
    levels[1].clusters.push_back({parseCluster("3").value()});
    levels[2].cuts.push_back(parseVolumeCut("voronoi:9").value());
    levels[3].cuts.push_back(parseVolumeCut("voronoi:2:1:name=top").value());
    Recipe recipe;
    recipe.wrap = PageWrap::none;
    const FractureSet set =
        writtenSet(modelAround(chartedCube(1, 2)), stackLevels(std::move(levels)), recipe);
    uint32_t named = 0;
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        if (set.fragments[f].name != "top") continue;
        ++named;
        CHECK(set.fragments[f].level == 1);
        CHECK(leavesOf(set, f).size() == 18);
    }
    CHECK(named == 1);
}

TEST_CASE("names and strengths of a recipe's levels hold for clusters, too") {
    const Recipe recipe = parseRecipe(R"({"levels": [
        {"cluster": "3", "name": "chunks", "strength": 2e6},
        {"cut": "voronoi:20", "name": "rubble", "strength": 3e6},
        {"cluster": "2", "name": "halves", "toughness": 7},
        {"cut": "voronoi:4", "name": "gravel", "strength": 4e6}]})",
                                      "r.json")
                              .value();
    const FractureSet set =
        writtenSet(modelAround(chartedCube(1, 2)),
                   planOf({"cluster 3", "cut voronoi:20", "cluster 2", "cut voronoi:4"}), recipe);
    REQUIRE(set.levels.size() == 5);
    const std::vector<std::string> names{"", "chunks", "rubble", "halves", "gravel"};
    for (size_t k = 0; k < names.size(); ++k) CHECK(set.levels[k].name == names[k]);
    std::map<uint32_t, float> strength, toughness;
    for (const Bond& bond : set.bonds) {
        auto a = static_cast<uint32_t>(bond.a), b = static_cast<uint32_t>(bond.b);
        while (set.fragments[a].parent != set.fragments[b].parent) {
            uint32_t& deeper = set.fragments[a].level >= set.fragments[b].level ? a : b;
            deeper = static_cast<uint32_t>(set.fragments[deeper].parent);
        }
        strength[set.fragments[a].level] = bond.strength;
        toughness[set.fragments[a].level] = bond.toughness;
    }
    CHECK(strength == std::map<uint32_t, float>{{1, 2e6F}, {2, 3e6F}, {3, 1e6F}, {4, 4e6F}});
    CHECK(toughness[3] == 7);
    CHECK(toughness[4] == 50);
}

TEST_CASE("what a cluster cannot do is refused or told") {
    CHECK(errorOf({"cluster 4"}).message.find("no fracture line") != std::string::npos);
    const Error one = errorOf({"cluster 1", "cut voronoi:9"});
    CHECK(one.code == ErrorCode::separatesNothing);
    CHECK(one.where.find("cluster \"1\"") != std::string::npos);
    CHECK(errorOf({"cluster 9", "cut voronoi:9"}).code == ErrorCode::separatesNothing);

    // Pieces of 9 and of 2: the latter have no more.
    const Result<BakedObject> few = bakeObject(
        chartedCube(1, 2),
        planOf({"cut slices:2x1x1", "cluster 3", "cut voronoi:9:near=0.1,0.5,0.5"}), {}, 0);
    REQUIRE(few.has_value());
    CHECK(hasFinding(few->report, "cluster"));
    CHECK(hasFinding(few->report, "cluster-few"));
    CHECK_FALSE(hasFinding(few->report, "cluster-apart"));

    Solid two = boxSolid({0, 0, 0}, {1, 1, 1});
    two.append(boxSolid({3, 0, 0}, {4, 1, 1}));
    const Result<BakedObject> apart =
        bakeObject(meshOf(two), planOf({"cluster 1", "cut grid:16:jitter=0"}), {}, 0);
    REQUIRE(apart.has_value());
    CHECK(hasFinding(apart->report, "cluster-apart"));
    CHECK(apart->report.levels[1].components == 2);
}

TEST_CASE("a recipe's cluster without a finer level is refused with its place") {
    const auto wrong = [](const char* text) { return parseRecipe(text, "r.json").error(); };
    const Error last = wrong(R"({"levels": [{"cut": "voronoi:9"}, {"cluster": "4"}]})");
    CHECK(last.where == "r.json#/levels/1/cluster");
    CHECK(wrong(R"({"levels": [{"cluster": "4:x"}, {"cut": "voronoi:9"}]})").where ==
          "r.json#/levels/0/cluster");
    CHECK(wrong(R"({"levels": [{"cluster": "4", "cut": "voronoi:9"}]})").where ==
          "r.json#/levels/0");
    const Recipe recipe =
        parseRecipe(R"({"levels": [{"cluster": "4:evenness=1"}, {"cut": "voronoi:9"}]})", "r.json")
            .value();
    REQUIRE(recipe.levels.size() == 2);
    CHECK(recipe.levels[0].cluster->evenness == 1);
    CHECK(recipe.levels[0].cluster->where == "r.json#/levels/0/cluster");
}

TEST_CASE("the same clusters come of any number of threads") {
    const Model model = modelAround(chartedCube(1, 3));
    const FracturePlan plan =
        planOf({"cluster 3", "cut voronoi:8", "cluster 3:evenness=0.9", "cut voronoi:9"});
    Recipe recipe;
    recipe.threads = 1;
    const std::vector<uint8_t> one = bakeModel(model, plan, recipe).value().glb;
    recipe.threads = 5;
    CHECK(bakeModel(model, plan, recipe).value().glb == one);
}

TEST_CASE("random solids: groups of cut pieces are closed, connected and fill the object") {
    for (const uint32_t seed : propertySeeds(1, 12)) {
        CAPTURE(seed);
        Random random(seed);
        const Solid solid = randomSolid(random);
        if (!solid.simple) continue;
        const std::string cut =
            "cut voronoi:" + std::to_string(8 + random.below(30)) + ":" + std::to_string(seed);
        const std::string groups = std::to_string(2 + random.below(5));
        const Result<BakedFile> baked =
            bakeModel(modelAround(meshOf(solid)), planOf({"cluster " + groups, cut}), {});
        // An object in several parts may have no fewer groups than pieces.
        if (!baked && baked.error().code == ErrorCode::separatesNothing) continue;
        if (!baked) FAIL(baked.error().message << baked.error().where);
        const Result<CheckReport> report = checkFractureSets(baked->glb, {});
        REQUIRE(report.has_value());
        for (const Finding& f : report->findings)
            if (f.severity == Severity::failure) FAIL_CHECK(f.message << " " << f.where);
        const FractureSet set = readFractureSets(baked->glb).value().at(0);
        CHECK(volumeAt(set, 1) == doctest::Approx(volumeAt(set, 2)).epsilon(1e-5));
    }
}

TEST_CASE("a real model's pieces are grouped") {
    if (!haveSharedModels()) return;
    const auto path = sharedDir() / "models/dev/spot_triangulated.obj";
    REQUIRE(std::filesystem::exists(path));
    const Result<Model> model = importModel(path, {});
    REQUIRE(model.has_value());
    const FractureSet set =
        writtenSet(*model, planOf({"cluster 5", "cut voronoi:40", "cut voronoi:3"}));
    CHECK(fragmentsAtLevel(set, 1).size() == 5);
    for (const uint32_t f : fragmentsAtLevel(set, 1)) CHECK(holdsTogether(set, f));
}
