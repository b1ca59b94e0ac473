// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "import/gltf_import.h"
#include "import/level_name.h"
#include "import/line_chains.h"
#include "import/obj_import.h"
#include "mesh_facts.h"
#include "support/property.h"
#include "tiny_import.h"
#include "tiny_model.h"

using namespace sherd;
using sherd::test::addNode;
using sherd::test::import;
using sherd::test::importAll;
using sherd::test::Json;
using sherd::test::mentions;
using sherd::test::propertyCases;
using sherd::test::Random;
using sherd::test::tetrahedron;
using sherd::test::TinyModel;

namespace {

/// Adds a mesh of one primitive of lines; returns its index.
int lineMesh(TinyModel& model, const std::vector<float>& points, int mode = 1) {
    model.json["meshes"].push_back(
        {{"primitives",
          Json::array({{{"attributes", {{"POSITION", model.vec3(points)}}}, {"mode", mode}}})}});
    return static_cast<int>(model.json["meshes"].size()) - 1;
}

std::vector<glm::dvec3> pointsOf(const FractureMap::SurfaceLine& line) {
    std::vector<glm::dvec3> points;
    for (const SurfacePlace& place : line.places) {
        CHECK(place.in3d);
        points.push_back(place.point);
    }
    return points;
}

using Points = std::vector<glm::dvec3>;

}  // namespace

TEST_CASE("a name says its level anywhere, and Blender's duplicates do not count") {
    for (const char* name :
         {"Cracks level 2", "level_2.001", "fracture-Level2", "LEVEL2", "level:2",
          "my level levels level 2", "crackLevel2", "level  2 left", "Level #2", "level 02"}) {
        CAPTURE(name);
        CHECK(levelInName(name) == 2U);
    }
    for (const char* name :
         {"", "level", "level ", "levels 2", "sublevel 2", "level two", "level.2", "level 0",
          "level 65", "level 99999999999999999999", "2 level", "leve", "\xC3\xA9level2"}) {
        CAPTURE(name);
        CHECK_FALSE(levelInName(name));
    }
    CHECK(levelInName("level 64") == 64U);
}

TEST_CASE("no segments make no lines, segments without length and repeated ones are counted") {
    CHECK(chainSegments({}).lines.empty());
    const LineChains chains = chainSegments(
        {{{0, 0, 0}, {1, 0, 0}, {0, -0.0F, 0}}, {{0, 2}, {0, 1}, {1, 0}, {1, 2}, {1, 1}}});
    CHECK(chains.lines == std::vector<std::vector<glm::vec3>>{{{0, 0, 0}, {1, 0, 0}}});
    CHECK(chains.withoutLength == 2);
    CHECK(chains.repeated == 2);
}

TEST_CASE("segments chain over bit-equal points, split at branches and close as loops") {
    // A T of three arms of two segments each, and a triangle of its own.
    LineSegments segments;
    const auto add = [&](glm::vec3 a, glm::vec3 b) {
        const auto first = static_cast<uint32_t>(segments.points.size());
        segments.points.insert(segments.points.end(), {a, b});
        segments.ends.push_back({first, first + 1});
    };
    add({2, 0, 0}, {1, 0, 0});
    add({0, 0, 0}, {1, 0, 0});
    add({0, 0, 0}, {0, 1, 0});
    add({0, 2, 0}, {0, 1, 0});
    add({0, 0, 0}, {-1, 0, 0});
    add({-1, 0, 0}, {-2, 0, 0});
    add({5, 0, 0}, {6, 0, 0});
    add({6, 1, 0}, {6, 0, 0});
    add({6, 1, 0}, {5, 0, 0});
    const LineChains chains = chainSegments(segments);
    REQUIRE(chains.lines.size() == 4);
    for (size_t i = 0; i < 3; ++i) CHECK(chains.lines[i].size() == 3);
    CHECK(chains.lines[0] == std::vector<glm::vec3>{{2, 0, 0}, {1, 0, 0}, {0, 0, 0}});
    CHECK(chains.lines[3].size() == 4);
    CHECK(chains.lines[3].front() == chains.lines[3].back());
}

TEST_CASE("a loop that passes a branch starts and ends there") {
    const LineChains chains = chainSegments(
        {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, -1, 0}}, {{0, 1}, {1, 2}, {2, 0}, {0, 3}}});
    REQUIRE(chains.lines.size() == 2);
    CHECK(chains.lines[0].front() == glm::vec3(0, 0, 0));
    CHECK(chains.lines[0].back() == glm::vec3(0, 0, 0));
}

TEST_CASE("chains hold every segment exactly once, and end nowhere inside a run") {
    for (int seed = 0; seed < propertyCases(200); ++seed) {
        CAPTURE(seed);
        Random random(static_cast<uint32_t>(seed));
        const uint32_t points = 2 + random.below(12);
        LineSegments segments;
        for (uint32_t p = 0; p < points; ++p) segments.points.emplace_back(p, 0, 0);
        const uint32_t count = random.below(3 * points);
        for (uint32_t i = 0; i < count; ++i) {
            segments.ends.push_back({random.below(points), random.below(points)});
        }
        using Edge = std::array<float, 2>;
        std::vector<Edge> want;
        std::vector<int> degree(points, 0);
        for (const auto& e : segments.ends) {
            if (e[0] == e[1]) continue;
            want.push_back({float(std::min(e[0], e[1])), float(std::max(e[0], e[1]))});
        }
        std::sort(want.begin(), want.end());
        want.erase(std::unique(want.begin(), want.end()), want.end());
        for (const Edge& e : want) {
            ++degree[size_t(e[0])];
            ++degree[size_t(e[1])];
        }
        std::vector<Edge> got;
        for (const auto& line : chainSegments(segments).lines) {
            REQUIRE(line.size() >= 2);
            for (size_t i = 1; i < line.size(); ++i) {
                got.push_back(
                    {std::min(line[i - 1].x, line[i].x), std::max(line[i - 1].x, line[i].x)});
                if (i + 1 < line.size()) CHECK(degree[size_t(line[i].x)] == 2);
            }
            const bool loop = line.front() == line.back();
            if (!loop) {
                CHECK(degree[size_t(line.front().x)] != 2);
                CHECK(degree[size_t(line.back().x)] != 2);
            }
        }
        std::sort(got.begin(), got.end());
        CHECK(got == want);
    }
}

TEST_CASE("loose edges of the object's own mesh are its lines, where the scene shows them") {
    TinyModel model = tetrahedron();
    model.json["nodes"][0]["translation"] = {10, 0, 0};
    model.json["nodes"][0]["scale"] = {2, 3, 4};
    model.json["nodes"][0]["rotation"] = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};
    model.primitive({{"POSITION", model.vec3({0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0})}})["mode"] = 1;
    const SurfaceMesh mesh = importAll(model).front();
    CHECK(mesh.triangles.size() == 4);
    REQUIRE(mesh.lines.size() == 1);
    CHECK(mesh.lines[0].source == "node \"thing\": line 1");
    CHECK(mesh.lines[0].level == 1);
    const Points points = pointsOf(mesh.lines[0]);
    REQUIRE(points.size() == 3);
    CHECK(glm::length(points[0] - glm::dvec3(10, 0, 0)) < 1e-12);
    CHECK(glm::length(points[1] - glm::dvec3(10, 2, 0)) < 1e-7);  // x turned to y, scaled by 2
    CHECK(glm::length(points[2] - glm::dvec3(7, 2, 0)) < 1e-7);
    CHECK(mesh.warnings.empty());
}

TEST_CASE("loops, strips and indexed lines come in as they are meant") {
    const std::vector<float> square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    TinyModel loop = tetrahedron();
    loop.primitive({{"POSITION", loop.vec3(square)}})["mode"] = 2;
    CHECK(pointsOf(importAll(loop)[0].lines.at(0)).size() == 5);
    TinyModel strip = tetrahedron();
    strip.primitive({{"POSITION", strip.vec3(square)}})["mode"] = 3;
    CHECK(pointsOf(importAll(strip)[0].lines.at(0)).size() == 4);
    TinyModel indexed = tetrahedron();
    const int position = indexed.vec3(square);
    indexed.primitive({{"POSITION", position}}, indexed.indices({3, 2, 2, 0, 1, 1, 0}))["mode"] = 1;
    const SurfaceMesh mesh = importAll(indexed)[0];
    REQUIRE(mesh.lines.size() == 1);
    CHECK(pointsOf(mesh.lines[0]).size() == 3);
    CHECK(mesh.warnings.size() == 2);
    CHECK(mentions(mesh.warnings, "one end only"));
    CHECK(mentions(mesh.warnings, "1 line segments without length"));
}

TEST_CASE("lines of nodes at any depth below an object are its own, with the level of their name") {
    TinyModel model = tetrahedron();
    model.json["nodes"][0]["translation"] = {0, 0, 5};
    const int lines = lineMesh(model, {0, 0, 0, 1, 0, 0});
    const int group = addNode(model, {{"translation", {0, 2, 0}}}, 0);
    addNode(model, {{"name", "Cracks level 2"}, {"mesh", lines}, {"translation", {1, 0, 0}}},
            group);
    model.json["meshes"].push_back(model.json["meshes"][static_cast<size_t>(lines)]);
    model.json["meshes"].back()["name"] = "level_3.001";
    addNode(model, {{"mesh", lines + 1}}, 0);
    const std::vector<SurfaceMesh> meshes = importAll(model);
    REQUIRE(meshes.size() == 1);
    CHECK(meshes[0].warnings.empty());
    REQUIRE(meshes[0].lines.size() == 2);
    CHECK(meshes[0].lines[0].source == "node \"Cracks level 2\": line 1");
    CHECK(meshes[0].lines[0].level == 2);
    CHECK(pointsOf(meshes[0].lines[0]) == Points{{1, 2, 5}, {2, 2, 5}});
    CHECK(meshes[0].lines[1].source == "node 3: line 1");
    CHECK(meshes[0].lines[1].level == 3);
}

TEST_CASE("lines belong to the nearest object above them") {
    TinyModel model = tetrahedron();
    const int lines = lineMesh(model, {0, 0, 0, 1, 0, 0});
    const int inner = addNode(model, {{"mesh", 0}, {"name", "inner"}, {"scale", {2, 2, 2}}}, 0);
    addNode(model, {{"mesh", lines}}, inner);
    const std::vector<SurfaceMesh> meshes = importAll(model);
    REQUIRE(meshes.size() == 2);
    CHECK(meshes[0].lines.empty());
    CHECK(meshes[1].lines.size() == 1);
    CHECK(importAll(model, {{"thing"}, 0})[0].lines.empty());
}

TEST_CASE("lines below no object are given to the only one, and to none of several") {
    TinyModel model = tetrahedron();
    const int lines = lineMesh(model, {0, 0, 0, 1, 0, 0});
    addNode(model, {{"mesh", lines}, {"name", "Cracks"}});
    const SurfaceMesh only = importAll(model).front();
    CHECK(only.lines.size() == 1);
    CHECK(only.warnings.empty());
    addNode(model, {{"mesh", 0}, {"name", "other"}, {"scale", {2, 2, 2}}});
    const std::vector<SurfaceMesh> two = importAll(model);
    REQUIRE(two.size() == 2);
    CHECK(two[0].lines.empty());
    CHECK(two[1].lines.empty());
    CHECK(mentions(two[0].warnings, "the lines of node \"Cracks\" were left out"));
    CHECK(mentions(two[0].warnings, "parent them"));
    CHECK(importAll(model, {{"other"}, 0})[0].lines.size() == 1);
    ImportOptions join;
    join.join = true;
    CHECK(importAll(model, join)[0].lines.size() == 1);
}

TEST_CASE("line nodes of another scene are not taken") {
    TinyModel model = tetrahedron();
    const int lines = lineMesh(model, {0, 0, 0, 1, 0, 0});
    model.json["nodes"].push_back({{"mesh", lines}});
    CHECK(importAll(model)[0].lines.empty());
}

TEST_CASE("a node of nothing but points is still left out and said so") {
    TinyModel model = tetrahedron();
    addNode(model, {{"mesh", lineMesh(model, {0, 0, 0}, 0)}});
    const std::vector<SurfaceMesh> meshes = importAll(model);
    REQUIRE(meshes.size() == 1);
    CHECK(mentions(meshes[0].warnings, "node 1 has no triangles; left out"));
}

TEST_CASE("a line node asked for by name is no object") {
    TinyModel model = tetrahedron();
    addNode(model, {{"mesh", lineMesh(model, {0, 0, 0, 1, 0, 0})}, {"name", "Cracks"}});
    const auto meshes = import(model, {{"Cracks"}, 0});
    REQUIRE_FALSE(meshes);
    CHECK(meshes.error().code == ErrorCode::noTriangles);
}

TEST_CASE("bad accessors of lines are refused where they stand") {
    struct Breakage {
        const char* pointer;
        Json value;
        const char* where;
    };
    for (const Breakage& breakage : {Breakage{"/accessors/3/bufferView", 99, "/accessors/3"},
                                     Breakage{"/accessors/3/type", "VEC2", "/accessors/3"},
                                     Breakage{"/accessors/4/componentType", 5126, "/accessors/4"},
                                     Breakage{"/meshes/1/primitives/0/attributes/POSITION", 99,
                                              "/meshes/1/primitives/0/attributes/POSITION"},
                                     Breakage{"/accessors/3/count", 1, "/accessors/4"}}) {
        CAPTURE(breakage.pointer);
        TinyModel model = tetrahedron();
        const int lines = lineMesh(model, {0, 0, 0, 1, 0, 0});
        model.json["meshes"][1]["primitives"][0]["indices"] = model.indices({0, 1});
        addNode(model, {{"mesh", lines}}, 0);
        CHECK(importAll(model)[0].lines.size() == 1);
        model.json[Json::json_pointer(breakage.pointer)] = breakage.value;
        const auto meshes = import(model);
        REQUIRE_FALSE(meshes);
        CHECK(meshes.error().where == std::string("t.glb#") + breakage.where);
    }
    TinyModel infinite = tetrahedron();
    addNode(infinite, {{"mesh", lineMesh(infinite, {0, 0, 0, INFINITY, 0, 0})}}, 0);
    CHECK(import(infinite).error().code == ErrorCode::invalidData);
    TinyModel skinned = tetrahedron();
    addNode(skinned, {{"mesh", lineMesh(skinned, {0, 0, 0, 1, 0, 0})}, {"skin", 0}}, 0);
    CHECK(import(skinned).error().code == ErrorCode::skinnedMesh);
}

TEST_CASE("lines without POSITION are left out and said so") {
    TinyModel model = tetrahedron();
    model.primitive(Json::object())["mode"] = 1;
    const SurfaceMesh mesh = importAll(model).front();
    CHECK(mesh.lines.empty());
    CHECK(mentions(mesh.warnings, "without POSITION"));
}

TEST_CASE("an OBJ's l elements are lines, their object's or group's name gives the level") {
    const std::string text =
        "o Vase\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1 2 3\n"
        "l 1 2 3\nl 3/1 4/1\n"
        "o Cracks level 2\nl -1 -2\ng level 3\nl 1 3 1\n"
        "o Plain\nl 2 2\n";
    const auto model = importObj(text, "t.obj", {});
    REQUIRE_MESSAGE(model, (model ? "" : model.error().message + model.error().where));
    const SurfaceMesh& mesh = model->meshes.front();
    REQUIRE(mesh.lines.size() == 3);
    CHECK(pointsOf(mesh.lines[0]) == Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(mesh.lines[0].source == "object \"Vase\": line 1");
    CHECK(mesh.lines[0].level == 1);
    CHECK(mesh.lines[1].source == "object \"Cracks level 2\": line 1");
    CHECK(mesh.lines[1].level == 2);
    CHECK(mesh.lines[2].source == "group \"level 3\": line 1");
    CHECK(mesh.lines[2].level == 3);
    CHECK(mentions(mesh.warnings, "group \"level 3\": 1 line segments that were there twice"));
    CHECK(mentions(mesh.warnings, "object \"Plain\": 1 line segments without length"));
}

TEST_CASE("an OBJ without names calls its lines by the file") {
    const auto model = importObj("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nl 1 2\n", "t.obj", {});
    REQUIRE(model);
    CHECK(model->meshes[0].lines.at(0).source == "t.obj: line 1");
}

TEST_CASE("malformed OBJ lines are refused where they stand") {
    const std::string start = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
    for (const char* line : {"l", "l 1", "l 1 x", "l 1 0", "l 1//1 2"}) {
        CAPTURE(line);
        const auto model = importObj(start + line, "t.obj", {});
        REQUIRE_FALSE(model);
        CHECK(model.error().code == ErrorCode::malformed);
        CHECK(model.error().where == "t.obj:5");
    }
    for (const char* line : {"l 1 4", "l 1 -9", "l 1/1 2", "l 1 99999999999"}) {
        CAPTURE(line);
        const auto model = importObj(start + line, "t.obj", {});
        REQUIRE_FALSE(model);
        CHECK(model.error().code == ErrorCode::invalidData);
        CHECK(model.error().where == "t.obj:5");
    }
    CHECK(importObj("v 0 0 0\nv 1 0 0\nl 1 2\n", "t.obj", {}).error().code ==
          ErrorCode::noTriangles);
}
