// SPDX-License-Identifier: MIT
// Levels that cut straight through along a drawing; judged by the file check and by what the
// written set holds.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "levels/lines_off_faces.h"
#include "sherd/baker/bake.h"
#include "sherd/baker/import.h"
#include "support/baked_set.h"
#include "support/models.h"
#include "support/random_solids.h"
#include "support/solid_meshes.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Line = std::vector<glm::dvec2>;

VolumeCut mapCut(const std::vector<Line>& lines, const std::string& keys) {
    VolumeCut cut = parseVolumeCut("map:drawn.svg" + keys).value();
    FractureMap map;
    for (const Line& line : lines) map.lines.push_back({line, 1, "drawn.svg"});
    cut.drawing = std::make_shared<FractureMap>(std::move(map));
    return cut;
}

FracturePlan planOf(std::vector<VolumeCut> cuts) {
    std::vector<FracturePlan> levels;
    for (VolumeCut& cut : cuts) levels.emplace_back().cuts.push_back(std::move(cut));
    return stackLevels(std::move(levels));
}

Line box(const glm::dvec2& low, const glm::dvec2& high) {
    return {low, {high.x, low.y}, high, {low.x, high.y}, low};
}

uint32_t countOf(const BakedObjectReport& report, const std::string& code) {
    uint32_t count = 0;
    for (const BakeFinding& finding : report.findings)
        if (finding.code == code) count += finding.count;
    return count;
}

}  // namespace

TEST_CASE("the page covers the object as it is seen along the axis, upright") {
    SurfaceMesh mesh = chartedCube(1, 2);
    for (glm::vec3& p : mesh.positions) p *= glm::vec3(2, 4, 8);
    // A corner of the page, its upper left one: 1/4 of the width, 1/2 of the height.
    const std::vector<Line> corner{box({-1, -1}, {0.25, 0.5})};
    struct Case {
        const char* axis;
        glm::vec3 inside;  ///< of the middle of the small piece, in shares of the object
    };
    for (const Case& c : {Case{"-z", {0.125, 0.75, 0.5}}, Case{"z", {0.875, 0.75, 0.5}},
                          Case{"-x", {0.5, 0.75, 0.875}}, Case{"-y", {0.125, 0.5, 0.25}}}) {
        CAPTURE(c.axis);
        const FractureSet set =
            writtenSet(modelAround(mesh), planOf({mapCut(corner, std::string(":axis=") + c.axis)}));
        REQUIRE(set.fragments.size() == 3);
        const Fragment& small =
            set.fragments[1].volume < set.fragments[2].volume ? set.fragments[1] : set.fragments[2];
        CHECK(small.volume == doctest::Approx(8));
        CHECK(glm::length(small.centerOfMass - c.inside * glm::vec3(2, 4, 8)) < 1e-4);
    }
}

TEST_CASE("each piece of the level before is cut along the same drawing, and walls fit") {
    const std::vector<Line> cross{
        {{-0.1, 0.3}, {1.1, 0.6}}, {{0.5, -0.1}, {0.4, 1.1}}, box({-0.1, -0.1}, {1.1, 1.1})};
    std::vector<VolumeCut> cuts{parseVolumeCut("voronoi:5:2").value(), mapCut(cross, ":axis=z"),
                                mapCut(cross, ":axis=x"), parseVolumeCut("voronoi:3").value()};
    const FractureSet set = writtenSet(modelAround(chartedCube(1, 2)), planOf(std::move(cuts)));
    for (uint32_t level = 1; level <= 4; ++level) {
        double sum = 0;
        for (const double volume : volumesAt(set, level)) sum += volume;
        CHECK(sum == doctest::Approx(1).epsilon(1e-5));
    }
    CHECK(volumesAt(set, 2).size() > 12);
}

TEST_CASE("lines along the object's sides leave no flap: the skin stays with what is inside") {
    Solid two = boxSolid({0, 0, 0}, {1, 1, 1}, 2);
    two.append(boxSolid({2, 0, 0}, {3, 1, 1}, 2));
    const std::vector<Line> around{box({0, 0}, {1.0 / 3, 1}), {{0, 0.5}, {1.0 / 3, 0.5}}};
    const Result<BakedObject> baked =
        bakeObject(meshOf(two), planOf({mapCut(around, ":axis=-z")}), {}, 0);
    REQUIRE(baked.has_value());
    CHECK(countOf(baked->report, "moved-planes") == 4);
    CHECK(countOf(baked->report, "lumps") == 0);
    CHECK(countOf(baked->report, "slivers") == 0);
    const std::vector<double> volumes = volumesAt(baked->set, 1);
    REQUIRE(volumes.size() == 3);
    CHECK(volumes[0] == doctest::Approx(0.5).epsilon(1e-5));
    CHECK(volumes[2] == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE(
    "lines move off faces outwards, corners with both of theirs, ends with what they are on") {
    constexpr double kBy = 1e-3;
    const std::vector<UprightFace> square{
        {{0, 0}, {1, 0}, 1}, {{1, 0}, {1, 1}, 1}, {{1, 1}, {0, 1}, 1}, {{0, 1}, {0, 0}, 1}};
    FractureMap map;
    map.lines.push_back({box({0, 0}, {1, 1}), 1, "around"});
    map.lines.push_back({{{0.3, 0}, {0.3, 0.6}}, 1, "within"});
    const MovedLines moved = moveOffFaces(square, kBy, map);
    CHECK(moved.moved == 4);
    CHECK(moved.opposed == 0);
    const auto near = [](const glm::dvec2& a, const glm::dvec2& b) {
        return glm::length(a - b) < 1e-12;
    };
    CHECK(near(map.lines[0].points[0], {-kBy, -kBy}));
    CHECK(near(map.lines[0].points[2], {1 + kBy, 1 + kBy}));
    CHECK(near(map.lines[1].points[0], {0.3, -kBy}));
    CHECK(near(map.lines[1].points[1], {0.3, 0.6}));
    // Between two solids the larger area decides.
    FractureMap between;
    between.lines.push_back({{{0, 0}, {1, 0}}, 1, "between"});
    const MovedLines decided = moveOffFaces(
        std::vector<UprightFace>{{{0, 0}, {1, 0}, 1}, {{1, 0}, {0, 0}, 2}}, kBy, between);
    CHECK(decided.opposed == 1);
    CHECK(near(between.lines[0].points[0], {0, kBy}));
}

TEST_CASE("a drawing that parts nothing is refused, a place far off the page too") {
    const auto error = [](const std::vector<Line>& lines) {
        const Result<BakedObject> baked =
            bakeObject(chartedCube(1, 1), planOf({mapCut(lines, "")}), {}, 0);
        REQUIRE_FALSE(baked.has_value());
        return baked.error();
    };
    CHECK(error({{{0.2, 0.2}, {0.6, 0.7}}}).code == ErrorCode::separatesNothing);
    CHECK(error({box({2, 2}, {3, 3})}).code == ErrorCode::separatesNothing);
    CHECK(error({{{0.2, 0.2}, {60, 0.7}}}).code == ErrorCode::limitExceeded);
}

TEST_CASE("a drawing of a real model goes straight through it") {
    if (!haveSharedModels()) return;
    const auto path = sharedDir() / "models/dev/spot_triangulated.obj";
    REQUIRE(std::filesystem::exists(path));
    const Result<Model> model = importModel(path, {});
    REQUIRE(model.has_value());
    VolumeCut cut = parseVolumeCut("map:spot.svg:axis=z").value();
    cut.drawing = std::make_shared<FractureMap>(
        readFractureMap(sharedDir() / "maps/spot_triangulated_50.svg", {}).value());
    Recipe recipe;
    recipe.measure = true;
    const BakedFile baked = bakeModel(*model, planOf({cut}), recipe).value();
    const BakedLevelReport& level = baked.report.objects[0].levels[1];
    CHECK(level.fragments > 10);
    CHECK(level.coverageNone == 0);
    CHECK(level.coverageDouble == 0);
    writtenSet(*model, planOf({cut}));
}
