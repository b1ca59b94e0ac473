// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "sherd/baker/bake.h"
#include "sherd/baker/recipe.h"

#include "support/plans.h"

using namespace sherd;
using namespace sherd::test;

namespace {

Error errorOf(std::string_view text) {
    const Result<Recipe> recipe = parseRecipe(text, "r.json");
    REQUIRE_FALSE(recipe.has_value());
    return recipe.error();
}

}  // namespace

TEST_CASE("a recipe may hold comments and sets what it names") {
    const Result<Recipe> recipe = parseRecipe(
        R"({ // a wall
            "levels": [{"map": "a.svg", "name": "chunks"}, {"map": "b.svg"}],
            "physics": {"density": 2400, "hullVertices": 24},
            "interior": {"type": "medial", "thesis": true, "material": "stone",
                         "materials": {"paint": "brick"}, "normals": "flat",
                         "creaseAngle": 30, "depthColor": true,
                         "roughness": {"amplitude": 0.002, "size": 0.05, "seed": 4}},
            "measure": true, "capHoles": true, "allowOpen": true })",
        "r.json");
    REQUIRE(recipe.has_value());
    CHECK(recipe->levels.size() == 2);
    CHECK(recipe->levels[0].name == "chunks");
    CHECK(recipe->physics.density == 2400);
    CHECK(recipe->physics.hullVertices == 24);
    CHECK(recipe->interior.thesis);
    CHECK(recipe->interior.material == "stone");
    CHECK(recipe->interior.materials.at("paint") == "brick");
    CHECK(recipe->interior.normals == InteriorNormals::flat);
    CHECK(recipe->interior.creaseAngle == 30);
    CHECK(recipe->interior.depthColor == "COLOR_0");
    CHECK(recipe->interior.roughness.amplitude == 0.002);
    CHECK(recipe->interior.roughness.size == 0.05);
    CHECK(recipe->interior.roughness.seed == 4);
    CHECK(parseRecipe(R"({"interior": {"depthColor": false}})", "")->interior.depthColor.empty());
    CHECK(parseRecipe(R"({"interior": {"depthColor": "_DEEP"}})", "")->interior.depthColor ==
          "_DEEP");
    CHECK(recipe->file == "r.json");
    CHECK(recipe->allowOpen);
    CHECK(recipe->capHoles);
    CHECK(recipe->measure == true);
    CHECK_FALSE(parseRecipe("{}", "r.json")->measure.has_value());
}

TEST_CASE("a bad recipe is refused with the pointer of the culprit and what would be right") {
    CHECK(errorOf("{").code == ErrorCode::malformed);
    CHECK(errorOf("[]").where == "r.json#");
    CHECK(errorOf(R"({"physics": {}, "interior": {}, "physics": {}})").where == "r.json#/physics");
    const Error twice = errorOf(R"({"levels": [{"cut": "voronoi:2"}, [{}, 3],
                                    {"cut": "voronoi:2", "name": "a", "cut": "voronoi:3"}]})");
    CHECK(twice.where == "r.json#/levels/2/cut");
    CHECK(twice.message.find("twice") != std::string::npos);
    // The same key in objects beside or below each other is none.
    CHECK(parseRecipe(R"({"levels": [{"cut": "voronoi:2"}, {"cut": "voronoi:2"}],
                          "interior": {"material": "a", "materials": {"material": "b"}}})",
                      "r.json")
              .has_value());
    const Error unknown = errorOf(R"({"physics": {"weight": 1}})");
    CHECK(unknown.where == "r.json#/physics/weight");
    CHECK(unknown.message.find("density") != std::string::npos);
    CHECK(errorOf(R"({"physics": {"density": -1}})").where == "r.json#/physics/density");
    CHECK(errorOf(R"({"physics": {"density": "heavy"}})").where == "r.json#/physics/density");
    CHECK(errorOf(R"({"physics": {"hullVertices": 3.5}})").where == "r.json#/physics/hullVertices");
    CHECK(errorOf(R"({"measure": "all"})").where == "r.json#/measure");
    CHECK(errorOf(R"({"levels": []})").where == "r.json#/levels");
    CHECK(errorOf(R"({"levels": [{"name": "x"}]})").where == "r.json#/levels/0");
    CHECK(errorOf(R"({"levels": [{"cut": "voronoi:5", "map": "a.svg"}]})").where ==
          "r.json#/levels/0");
    const Error noCut = errorOf(R"({"levels": [{"map": "a.svg"}, {"cut": "voronoy:5"}]})");
    CHECK(noCut.where == "r.json#/levels/1/cut");
    CHECK(noCut.message.find("voronoi:N") != std::string::npos);
    const auto whereOnly = [](const std::string& level) {
        return errorOf(R"({"levels": [{"cut": "voronoi:2"}, )" + level + "]}").where;
    };
    CHECK(whereOnly(R"({"map": "a.svg", "only": {}})") == "r.json#/levels/1/only");
    CHECK(whereOnly(R"({"map": "a.svg", "only": {"biggest": 1}})") ==
          "r.json#/levels/1/only/biggest");
    CHECK(whereOnly(R"({"pattern": "grid:2x2", "only": {"larger": 2}})") ==
          "r.json#/levels/1/only/larger");
    CHECK(whereOnly(R"({"map": "a.svg", "only": {"near": [1, 2]}})") ==
          "r.json#/levels/1/only/near");
    CHECK(whereOnly(R"({"map": "a.svg", "only": {"larger": 0.1, "within": 1}})") ==
          "r.json#/levels/1/only/within");
    CHECK(whereOnly(R"({"cut": "voronoi:3:larger=0.1", "only": {"larger": 0.2}})") ==
          "r.json#/levels/1/only");
    CHECK(whereOnly(R"({"cluster": "3:larger=0.1", "only": {"larger": 0.2}},
                       {"cut": "voronoi:3"})") == "r.json#/levels/1/only");
    CHECK(errorOf(R"({"interior": {"type": "jelly"}})").where == "r.json#/interior/type");
    CHECK(errorOf(R"({"interior": {"materials": {"paint": 1}}})").where ==
          "r.json#/interior/materials/paint");
    CHECK(errorOf(R"({"interior": {"normals": "round"}})").where == "r.json#/interior/normals");
    for (const char* bad :
         {"3", R"("COLOR_10")", R"("COLOR_x")", R"("DEPTH")", R"("_")", R"("_a b")"})
        CHECK(errorOf(R"({"interior": {"depthColor": )" + std::string(bad) + "}}").where ==
              "r.json#/interior/depthColor");
    CHECK(errorOf(R"({"interior": {"roughness": {"depth": 1}}})").where ==
          "r.json#/interior/roughness/depth");
    CHECK(errorOf(R"({"interior": {"roughness": {"amplitude": -1}}})").where ==
          "r.json#/interior/roughness/amplitude");
    CHECK(errorOf(R"({"interior": {"roughness": 1}})").where == "r.json#/interior/roughness");
    CHECK(errorOf(R"({"interior": {"materials": []}})").where == "r.json#/interior/materials");
}

TEST_CASE("a recipe that is not there is said to be missing") {
    const Result<Recipe> recipe = readRecipe("no/such/recipe.json");
    REQUIRE_FALSE(recipe.has_value());
    CHECK(recipe.error().code == ErrorCode::fileNotFound);
}

TEST_CASE("with several maps the order of files is the order of levels, with one its layers are") {
    FractureMap a;
    a.lines.push_back({{{0, 0}, {1, 1}}, 3, "a"});
    a.lines.push_back({{{0, 0}, {1, 0}}, 5, "a"});
    const FracturePlan alone = stack({a});
    CHECK(alone.drawings[0].map.lines[0].level == 3);
    CHECK(alone.drawings[0].map.lines[1].level == 5);
    const FracturePlan both = stack({a, a});
    CHECK(both.drawings[0].map.lines[1].level == 1);
    CHECK(both.drawings[1].map.lines[1].level == 2);
}

TEST_CASE("a cut along a drawing may be an object, which says the same as its text") {
    const auto cutOf = [](const std::string& cut) {
        return *parseRecipe(R"({"levels": [{"cut": )" + cut + R"(, "name": "a"}]})", "r.json")
                    .value()
                    .levels[0]
                    .cut;
    };
    const VolumeCut object = cutOf(
        R"({"map": "C:/a=b/c.svg", "axis": "-y", "larger": 0.1, "smaller": 0.5, "within": 2,
            "near": [[1, 2, 3], [4, 5, 6]], "name": "head"})");
    const VolumeCut text = cutOf(
        R"("map:C:/a=b/c.svg:axis=-y:larger=0.1:smaller=0.5:within=2:near=1,2,3;4,5,6:name=head")");
    CHECK(object.kind == VolumeCut::Kind::map);
    CHECK(object.map == text.map);
    CHECK(object.along == glm::dvec3(0, -1, 0));
    CHECK(object.along == text.along);
    CHECK(object.only.larger == text.only.larger);
    CHECK(object.only.smaller == text.only.smaller);
    CHECK(object.only.near == text.only.near);
    CHECK(object.only.within == text.only.within);
    CHECK(object.only.name == text.only.name);
    CHECK(object.where == "r.json#/levels/0/cut");
    CHECK(object.text == "map:C:/a=b/c.svg:axis=-y");
    const VolumeCut least = cutOf(R"({"map": "a.svg"})");
    CHECK(least.along == glm::dvec3(0));
    CHECK(least.only.all());
    CHECK(cutOf(R"({"map": "a.svg", "near": [1, 2, 3]})").only.near ==
          std::vector<glm::dvec3>{{1, 2, 3}});
}

TEST_CASE("a bad cut along a drawing is refused with its pointer and what is allowed there") {
    struct Bad {
        const char* cut;
        const char* where;  ///< below "cut"
        const char* says;
    };
    for (const Bad& bad : {
             Bad{"3", "", "an object with a \"map\""},
             Bad{"[]", "", "a text like \"voronoi:12\""},
             Bad{R"("")", "", "known are voronoi:N"},
             Bad{"{}", "", "needs a \"map\""},
             Bad{R"({"map": ""})", "", "needs a \"map\""},
             Bad{R"({"map": 1})", "/map", "must be a string"},
             Bad{R"({"axis": "x"})", "", "needs a \"map\""},
             Bad{R"({"map": "a", "axis": "w"})", "/axis", R"("x", "y", "z", "-x", "-y" or "-z")"},
             Bad{R"({"map": "a", "axis": [0, 0, 1]})", "/axis", R"("-y" or "-z")"},
             Bad{R"({"map": "a", "jitter": 1})", "/jitter", "known are axis, larger, map, name"},
             Bad{R"({"map": "a", "pattern": "grid:2x2"})", "/pattern", "known are axis"},
             Bad{R"({"map": "a", "larger": 2})", "/larger", "from 0 to 1"},
             Bad{R"({"map": "a", "smaller": "1"})", "/smaller", "from 0 to 1"},
             Bad{R"({"map": "a", "near": [1, 2]})", "/near", "a point [x, y, z]"},
             Bad{R"({"map": "a", "near": [[1, 2, 3], 4]})", "/near", "a list of such points"},
             Bad{R"({"map": "a", "near": [0, 0, 1e10]})", "/near", "1e+09"},
             Bad{R"({"map": "a", "near": []})", "/near", "a point [x, y, z]"},
             Bad{R"({"map": "a", "within": 1})", "/within", "\"near\""},
             Bad{R"({"map": "a", "near": [0, 0, 0], "within": -1})", "/within", "from 0 to 1e+09"},
             Bad{R"({"map": "a", "name": ""})", "/name", "as a label says it"},
         }) {
        CAPTURE(bad.cut);
        const Error error =
            errorOf(R"({"levels": [{"cut": "voronoi:2"}, {"cut": )" + std::string(bad.cut) + "}]}");
        CHECK(error.where == "r.json#/levels/1/cut" + std::string(bad.where));
        CAPTURE(error.message);
        CHECK(error.message.find(bad.says) != std::string::npos);
    }
}
