// SPDX-License-Identifier: MIT
// Levels of lines below cuts through the volume, and levels of lines that choose their pieces;
// judged by the file check and by what the written set holds.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sherd/baker/bake.h"
#include "sherd/formats/fracture_set.h"
#include "sherd/formats/validate.h"
#include "support/baked_set.h"
#include "support/cube_ring.h"
#include "support/hidden_looks.h"
#include "support/level_coverage.h"
#include "support/solid_meshes.h"
#include "support/surface_meshes.h"
#include "support/wall_sides.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// One level: "cut voronoi:5", or "grid:2x2", a pattern.
FracturePlan levelOf(const std::string& text, const PieceChoice& only = {}) {
    FracturePlan level;
    if (text.starts_with("cut "))
        level.cuts.push_back(parseVolumeCut(text.substr(4)).value());
    else
        level.patterns.push_back({parsePattern(text).value(), 1, nullptr, only});
    return level;
}

FracturePlan stackOf(const std::vector<std::string>& texts) {
    std::vector<FracturePlan> levels;
    levels.reserve(texts.size());
    for (const std::string& text : texts) levels.push_back(levelOf(text));
    return stackLevels(std::move(levels));
}

Recipe solidRecipe() {
    Recipe recipe;
    recipe.interior.type = InteriorType::solid;
    return recipe;
}

void checkVolumes(const FractureSet& set, uint32_t level, std::vector<double> expected) {
    CAPTURE(level);
    std::sort(expected.begin(), expected.end());
    const std::vector<double> volumes = volumesAt(set, level);
    REQUIRE(volumes.size() == expected.size());
    for (size_t i = 0; i < volumes.size(); ++i)
        CHECK(volumes[i] == doctest::Approx(expected[i]).epsilon(1e-5));
}

size_t divided(const FractureSet& set, uint32_t level) {
    size_t count = 0;
    for (const uint32_t f : fragmentsAtLevel(set, level))
        count += set.fragments[f].children.count > 0 ? 1 : 0;
    return count;
}

}  // namespace

TEST_CASE("a box cut in slices and then along a grid has just the products as pieces") {
    const SurfaceMesh cube = chartedCube(1, 2);
    // The planes of the grid are off those of the slices, or just in one of them.
    for (const char* grid : {"grid:3x1:on=planar/z", "grid:2x2:on=planar/z"}) {
        CAPTURE(grid);
        const FractureSet set =
            writtenSet(modelAround(cube), stackOf({"cut slices:2x1x1", grid}), solidRecipe());
        REQUIRE(set.levels.size() == 3);
        checkVolumes(set, 1, {0.5, 0.5});
        if (std::string(grid).starts_with("grid:3"))
            checkVolumes(set, 2, {1.0 / 3, 1.0 / 6, 1.0 / 6, 1.0 / 3});
        else
            checkVolumes(set, 2, {0.25, 0.25, 0.25, 0.25});
        CHECK(unpairedFaces(set) == 0);
        for (uint32_t f = 0; f < set.fragments.size(); ++f)
            if (set.fragments[f].children.count > 0) CHECK(childrenAddUp(set, f));
        checkCovered(set, cube, 4000);
    }
}

TEST_CASE("where every cut is by planes of its own, the order of the levels does not matter") {
    const std::string points = "cut points:0.2,0.5,0.5;0.75,0.4,0.3;0.5,0.9,0.7";
    const SurfaceMesh cube = chartedCube(1, 2);
    const FractureSet below =
        writtenSet(modelAround(cube), stackOf({points, "grid:3x2:on=planar/z"}), solidRecipe());
    const FractureSet above =
        writtenSet(modelAround(cube), stackOf({"grid:3x2:on=planar/z", points}), solidRecipe());
    checkVolumes(below, 2, volumesAt(above, 2));
    CHECK(below.levels[1].fragments.count == 3);
    CHECK(above.levels[1].fragments.count == 6);
    CHECK(unpairedFaces(below) == 0);
    checkCovered(below, cube, 4000);
}

TEST_CASE("lines, a cut and lines again: every level fills the object and its parents") {
    for (const InteriorType type : {InteriorType::medial, InteriorType::solid}) {
        Recipe recipe;
        recipe.interior.type = type;
        const SurfaceMesh mesh = torus(10, 6);
        const FracturePlan plan =
            stackOf({"voronoi:3", "cut voronoi:3:2", "voronoi:9:4", "cut slices:2x1x2"});
        const FractureSet set = writtenSet(modelAround(mesh), plan, recipe);
        REQUIRE(set.levels.size() == 5);
        CHECK(fragmentsAtLevel(set, 1).size() == 3);
        CHECK(fragmentsAtLevel(set, 2).size() == 9);
        for (uint32_t level = 2; level <= 4; ++level) {
            CHECK(fragmentsAtLevel(set, level).size() > fragmentsAtLevel(set, level - 1).size());
            CHECK(volumeAt(set, level) == doctest::Approx(volumeAt(set, 1)).epsilon(1e-6));
        }
        for (uint32_t f = 1; f < set.fragments.size(); ++f)
            if (set.fragments[f].children.count > 0) CHECK(childrenAddUp(set, f));
        if (type == InteriorType::solid) checkCovered(set, mesh, 4000);
    }
}

TEST_CASE("a cut above lines with a medial surface is closed, and says that this is inside") {
    const Result<BakedObject> baked =
        bakeObject(torus(10, 6), stackOf({"cut voronoi:4", "voronoi:5"}), {}, 0);
    REQUIRE(baked.has_value());
    for (const BakedLevelReport& level : baked->report.levels)
        CHECK(level.closed == level.fragments);
    const auto isInner = [](const BakeFinding& f) { return f.code == "inner-sheets"; };
    const auto& findings = baked->report.findings;
    const auto found = std::find_if(findings.begin(), findings.end(), isInner);
    REQUIRE(found != findings.end());
    CHECK(found->message.find("solid") != std::string::npos);
    const Result<BakedObject> solid =
        bakeObject(torus(10, 6), stackOf({"cut voronoi:4", "voronoi:5"}), solidRecipe(), 0);
    REQUIRE(solid.has_value());
    CHECK(std::none_of(solid->report.findings.begin(), solid->report.findings.end(), isInner));
    CHECK(solid->report.levels[1].volumeShare == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("lines divide only the pieces that they choose") {
    // 0.2, 0.3 and 0.5 of the cube, along z.
    const std::string slices = "cut points:0.5,0.5,0;0.5,0.5,0.4;0.5,0.5,0.6";
    struct Choice {
        PieceChoice only;
        std::vector<uint32_t> divided;
    };
    std::vector<Choice> choices(4);
    choices[0] = {{}, {1, 2, 3}};
    choices[1].only.larger = 0.25;
    choices[1].divided = {2, 3};
    choices[2].only.smaller = 0.25;
    choices[2].divided = {1};
    choices[3].only.near = {{0.5, 0.5, 0.9}};
    choices[3].divided = {3};
    for (const Choice& choice : choices) {
        const FracturePlan plan =
            stackLevels({levelOf(slices), levelOf("grid:2x1:on=planar/z", choice.only),
                         levelOf("cut slices:1x1x2")});
        const FractureSet set = writtenSet(modelAround(chartedCube(1, 1)), plan, solidRecipe());
        std::vector<uint32_t> parted;
        for (uint32_t f = 1; f < 4; ++f) {
            const Range children = set.fragments[f].children;
            REQUIRE(children.count > 0);
            if (set.fragments[children.first].level == 2) parted.push_back(f);
        }
        CHECK(parted == choice.divided);
        CHECK(fragmentsAtLevel(set, 3).size() == 2 * fragmentsAtLevel(set, 2).size());
        CHECK(volumeAt(set, 3) == doctest::Approx(1));
        CHECK(unpairedFaces(set) == 0);
    }
    PieceChoice none;
    none.larger = 0.9;
    const Result<BakedObject> baked = bakeObject(
        chartedCube(1, 1), stackLevels({levelOf(slices), levelOf("grid:2x1:on=planar/z", none)}),
        solidRecipe(), 0);
    REQUIRE_FALSE(baked.has_value());
    CHECK(baked.error().code == ErrorCode::badArgument);
    CHECK(baked.error().where.find("level 2") != std::string::npos);
}

TEST_CASE("lines that a piece was not chosen for do not cut it with deeper lines either") {
    // Halves, quarters in one of them, and rows.
    PieceChoice right;
    right.near = {{0.9, 0.5, 0.5}};
    for (const InteriorType type : {InteriorType::medial, InteriorType::solid}) {
        Recipe recipe;
        recipe.interior.type = type;
        const FracturePlan plan =
            stackLevels({levelOf("grid:2x1:on=planar/z"), levelOf("grid:4x1:on=planar/z", right),
                         levelOf("grid:1x3:on=planar/z")});
        const FractureSet set = writtenSet(modelAround(chartedCube(1, 2)), plan, recipe);
        REQUIRE(set.levels.size() == 4);
        CHECK(fragmentsAtLevel(set, 2).size() == 3);
        CHECK(fragmentsAtLevel(set, 3).size() == 9);
        CHECK(volumeAt(set, 3) == doctest::Approx(volumeAt(set, 1)).epsilon(1e-6));
        if (type == InteriorType::medial) continue;
        checkVolumes(
            set, 3, {1 / 6., 1 / 6., 1 / 6., 1 / 12., 1 / 12., 1 / 12., 1 / 12., 1 / 12., 1 / 12.});
        CHECK(unpairedFaces(set) == 0);
    }
}

TEST_CASE("a name chooses for lines, too, also one that a drawing below a cut gives") {
    FractureMap map = ringAroundCube();
    FractureMap::Label label;
    label.name = "top";
    label.level = 2;
    label.place = {true, glm::dvec3(0.2, 0.5, 1)};
    map.labels.push_back(label);
    FracturePlan drawn;
    drawn.drawings.push_back({map, {}});
    PieceChoice top;
    top.name = "top";
    Recipe recipe = solidRecipe();
    recipe.wrap = PageWrap::none;
    // Halves along x; in each a top and a bottom; a grid in the top that has the label.
    const FracturePlan plan = stackLevels({levelOf("cut points:0.2,0.5,0.5;0.8,0.5,0.5"), drawn,
                                           levelOf("grid:1x4:on=planar/z", top)});
    const FractureSet set = writtenSet(modelAround(chartedCube(1, 2)), plan, recipe);
    REQUIRE(set.levels.size() == 4);
    CHECK(fragmentsAtLevel(set, 2).size() == 4);
    CHECK(divided(set, 2) == 1);
    for (const uint32_t f : fragmentsAtLevel(set, 2))
        CHECK((set.fragments[f].name == "top") == (set.fragments[f].children.count > 0));
}

TEST_CASE("a label may name a piece that a cut above its lines made") {
    FractureMap map = ringAroundCube();
    FractureMap::Label label;
    label.name = "left";
    label.level = 1;
    label.place = {true, glm::dvec3(0.2, 0.5, 1)};
    map.labels.push_back(label);
    FracturePlan drawn;
    drawn.drawings.push_back({map, {}});
    drawn.drawings.back().only.name = "left";
    Recipe recipe = solidRecipe();
    recipe.wrap = PageWrap::none;
    // Its level counts in the list where several of it have lines.
    const FracturePlan plan = stackLevels(
        {levelOf("cut points:0.2,0.5,0.5;0.8,0.5,0.5"), drawn, levelOf("grid:1x3:on=planar/z")});
    const FractureSet set = writtenSet(modelAround(chartedCube(1, 2)), plan, recipe);
    REQUIRE(set.levels.size() == 4);
    CHECK(set.fragments[1].name == "left");
    CHECK(fragmentsAtLevel(set, 2).size() == 3);
    CHECK(fragmentsAtLevel(set, 3).size() == 9);
}

TEST_CASE("lines below a cut that divide nothing are refused with the reason") {
    // Only the corner at the origin is chosen, and no line runs through it.
    PieceChoice corner;
    corner.near = {{0.01, 0.01, 0.01}};
    const FracturePlan plan =
        stackLevels({levelOf("cut points:0.1,0.1,0.1;0.2,0.2,0.2;0.9,0.9,0.9"),
                     levelOf("grid:2x1:on=planar/z", corner)});
    const Result<BakedObject> baked = bakeObject(chartedCube(1, 2), plan, solidRecipe(), 0);
    REQUIRE_FALSE(baked.has_value());
    CHECK(baked.error().code == ErrorCode::separatesNothing);
    CHECK(baked.error().message.find("level 2") != std::string::npos);
}

TEST_CASE("levels in any order give the same bytes, whatever the number of threads") {
    const FracturePlan plan =
        stackOf({"cut voronoi:3:3", "voronoi:7", "cut grid:4", "voronoi:30:2"});
    std::vector<std::vector<uint8_t>> files;
    for (const unsigned threads : {1U, 2U, 5U}) {
        Recipe recipe = solidRecipe();
        recipe.threads = threads;
        files.push_back(bakeModel(modelAround(torus(10, 6)), plan, recipe).value().glb);
    }
    CHECK(files[0] == files[1]);
    CHECK(files[0] == files[2]);
}

TEST_CASE("an object scaled by a power of two has the same levels, scaled") {
    const FracturePlan plan = stackOf({"cut voronoi:4", "grid:3x2:on=planar/z", "cut voronoi:2"});
    const FractureSet one = bakeObject(chartedCube(1, 2), plan, solidRecipe(), 0).value().set;
    for (const float scale : {0x1p-10F, 0x1p10F}) {
        const FractureSet other =
            bakeObject(chartedCube(scale, 2), plan, solidRecipe(), 0).value().set;
        CHECK(other.geometry.indices == one.geometry.indices);
        std::vector<glm::vec3> scaled;
        for (const glm::vec3& p : one.geometry.positions) scaled.push_back(p * scale);
        CHECK(other.geometry.positions == scaled);
    }
}

TEST_CASE("the layers of one drawing are levels of their own, wherever it stands") {
    FractureMap map;
    for (const auto& [level, at] : {std::pair(1U, 0.4), std::pair(2U, 0.7)}) {
        for (int face : {0, 1})
            map.lines.push_back({{cubeUv(face, -0.01, at), cubeUv(face, 1.01, at)}, level, "ring"});
        for (int face : {2, 3})
            map.lines.push_back({{cubeUv(face, at, -0.01), cubeUv(face, at, 1.01)}, level, "ring"});
    }
    FracturePlan drawn;
    drawn.drawings.push_back({map, {}});
    Recipe recipe = solidRecipe();
    recipe.wrap = PageWrap::none;
    const auto counts = [&](std::vector<FracturePlan> levels) {
        const FractureSet set =
            writtenSet(modelAround(chartedCube(1, 2)), stackLevels(std::move(levels)), recipe);
        std::vector<size_t> result;
        for (uint32_t level = 1; level < set.levels.size(); ++level)
            result.push_back(fragmentsAtLevel(set, level).size());
        return result;
    };
    const FracturePlan halves = levelOf("cut points:0.2,0.5,0.5;0.8,0.5,0.5");
    CHECK(counts({halves, drawn}) == std::vector<size_t>{2, 4, 6});
    CHECK(counts({drawn, halves}) == std::vector<size_t>{2, 3, 6});
    // Of two sources each is one level.
    const std::vector<size_t> two = counts({drawn, halves, levelOf("grid:2x1:on=planar/x")});
    REQUIRE(two.size() == 3);
    CHECK(two[0] == 3);
    CHECK(two[1] == 6);
}

TEST_CASE("the checks of these tests find a wall that shows too late, and one that is moved") {
    FractureSet set =
        writtenSet(modelAround(chartedCube(1, 2)),
                   stackOf({"cut slices:1x1x2", "grid:3x1:on=planar/z"}), solidRecipe());
    CHECK(isClosed(set, 1));
    FractureSet late = set;
    for (Primitive& primitive : late.geometry.primitives)
        if (primitive.exposedFrom == 1) primitive.exposedFrom = 2;
    CHECK_FALSE(isClosed(late, 1));
    const std::vector<SeenFace> faces = hiddenFacesOf(set);
    REQUIRE_FALSE(faces.empty());
    set.geometry.positions[faces[0].v[0]] += glm::vec3(0.02F, 0.01F, 0.015F);
    CHECK(unpairedFaces(set) > 0);
}
