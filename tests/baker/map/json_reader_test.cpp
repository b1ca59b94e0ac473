// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>

#include "map/planar_map.h"
#include "sherd/baker/fracture_map.h"

using namespace sherd;

namespace {

/// The code and place of the error a text gives.
std::pair<ErrorCode, std::string> errorOf(const std::string& text) {
    const Result<FractureMap> map = readJsonMap(text, "m.json", {});
    INFO(text);
    REQUIRE_FALSE(map);
    CHECK_FALSE(map.error().message.empty());
    return {map.error().code, map.error().where};
}

std::string withLine(const std::string& line) {
    return R"({"sherdMap": 1, "lines": [{"points": [[0,0],[1,1]]}, )" + line + "]}";
}

}  // namespace

TEST_CASE("what is no JSON or no map is malformed") {
    for (const char* text : {"", "{", "nonsense", "{\"sherdMap\": 1, \"lines\": [NaN]}", "\x01\xff",
                             "{\"sherdMap\": 1} trailing", "{\"sherdMap\": 1, \"lines\": [1e999]}"})
        CHECK(errorOf(text).first == ErrorCode::malformed);
    CHECK(errorOf("[]").first == ErrorCode::malformed);
    CHECK(errorOf("{}").first == ErrorCode::malformed);
    CHECK(errorOf(std::string(100000, '[')).first == ErrorCode::malformed);
    CHECK(errorOf(std::string(100000, '[') + std::string(100000, ']')).first ==
          ErrorCode::malformed);
}

TEST_CASE("another version of the map format is unsupported") {
    CHECK(errorOf(R"({"sherdMap": 2})") ==
          std::pair(ErrorCode::unsupported, std::string("m.json#/sherdMap")));
    CHECK(errorOf(R"({"sherdMap": "1"})").first == ErrorCode::unsupported);
}

TEST_CASE("a map without lines is empty") {
    for (const char* text : {R"({"sherdMap": 1})", R"({"sherdMap": 1, "lines": []})",
                             R"({"sherdMap": 1, "nodes": [[0,0]], "edges": []})"})
        CHECK(errorOf(text).first == ErrorCode::emptyMap);
}

TEST_CASE("every mistake carries the pointer of the culprit") {
    const std::pair<std::string, std::string> cases[] = {
        {R"({"sherdMap": 1, "lines": {}})", "/lines"},
        {withLine("3"), "/lines/1"},
        {withLine("{}"), "/lines/1"},
        {withLine(R"({"points": 3})"), "/lines/1/points"},
        {withLine(R"({"points": []})"), "/lines/1/points"},
        {withLine(R"({"points": [[0,0]]})"), "/lines/1/points"},
        {withLine(R"({"points": [[0,0],[1]]})"), "/lines/1/points/1"},
        {withLine(R"({"points": [[0,0],[1,"x"]]})"), "/lines/1/points/1"},
        {withLine(R"({"points": [[0,0],[1,null]]})"), "/lines/1/points/1"},
        {withLine(R"({"points": [[0,0],[1,1]], "closed": 1})"), "/lines/1/closed"},
        {withLine(R"({"points": [[0,0],[1,1]], "level": 0})"), "/lines/1/level"},
        {withLine(R"({"points": [[0,0],[1,1]], "level": 1.5})"), "/lines/1/level"},
        {withLine(R"({"points": [[0,0],[1,1]], "level": 4294967297})"), "/lines/1/level"},
        {withLine(R"({"points": [[0,0],[1,1]], "name": 7})"), "/lines/1/name"},
        {withLine(R"({"points": [[0,0],[1,1]], "curve": "nurbs"})"), "/lines/1/curve"},
        {withLine(R"({"points": [[0,0],[1,1]], "curve": 7})"), "/lines/1/curve"},
        {withLine(R"({"points": [[0,0],[1,1],[2,2]], "curve": "bezier"})"), "/lines/1/points"},
        {R"({"sherdMap": 1, "nodes": [[0,0],[1,1]], "edges": [[0,1],[0,2]]})", "/edges/1/1"},
        {R"({"sherdMap": 1, "nodes": [[0,0],[1,1]], "edges": [[-1,1]]})", "/edges/0/0"},
        {R"({"sherdMap": 1, "nodes": [[0,0],[1,1]], "edges": [[0,1,1]]})", "/edges/0"},
        {R"({"sherdMap": 1, "edges": [[0,1]]})", "/edges/0/0"},
        {R"({"sherdMap": 1, "nodes": [0]})", "/nodes/0"},
    };
    for (const auto& [text, pointer] : cases)
        CHECK(errorOf(text) == std::pair(ErrorCode::invalidData, "m.json#" + pointer));
}

TEST_CASE("huge coordinates give an error from reader or planariser") {
    CHECK(errorOf(withLine(R"({"curve": "bezier", "points": [[0,0],[1e300,0],[0,1e300],[1,1]]})"))
              .first == ErrorCode::limitExceeded);
    const auto map = readJsonMap(withLine(R"({"points": [[0,0],[1e300,0]]})"), "m.json", {});
    REQUIRE(map);
    const auto planar = planarise(*map);
    REQUIRE_FALSE(planar);
    CHECK(planar.error().code == ErrorCode::limitExceeded);
    CHECK(planar.error().where.find("m.json: line 1") == 0);
}

TEST_CASE("lines, closed lines, levels and names are read") {
    MapReadOptions options;
    options.level = 2;
    const auto map = readJsonMap(
        R"(/* a map */ {"sherdMap": 1, "lines": [
            {"points": [[0,0],[1,0.5]]}, // plain
            {"points": [[0,0],[1,0],[1,1]], "closed": true, "level": 1, "name": "ring"}]})",
        "m.json", options);
    REQUIRE(map);
    REQUIRE(map->lines.size() == 2);
    CHECK(map->lines[0].level == 2);
    CHECK(map->lines[0].source == "m.json: line 0");
    CHECK(map->lines[0].points[1] == glm::dvec2(1, 0.5));
    CHECK(map->lines[1].level == 1);
    CHECK(map->lines[1].source == "m.json: line 1 \"ring\"");
    CHECK(map->lines[1].points.size() == 4);
    CHECK(map->lines[1].points.front() == map->lines[1].points.back());
    CHECK(map->warnings.empty());
}

TEST_CASE("curves are flattened, closed ones back to their start") {
    const auto map = readJsonMap(
        R"({"sherdMap": 1, "lines": [
            {"curve": "bezier", "points": [[0,0],[0,1],[1,1],[1,0]]},
            {"curve": "bezier", "closed": true, "points": [[0,0],[0,1],[1,1],[1,0],[1,-1],[0,-1]]}]})",
        "m.json", {});
    REQUIRE(map);
    CHECK(map->lines[0].points.size() > 10);
    CHECK(map->lines[0].points.back() == glm::dvec2(1, 0));
    CHECK(map->lines[1].points.back() == glm::dvec2(0, 0));
    CHECK(map->lines[1].points.size() > 2 * map->lines[0].points.size() - 3);
}

TEST_CASE("a graph becomes one line an edge") {
    const auto map = readJsonMap(
        R"({"sherdMap": 1, "nodes": [[0,0],[1,0],[0,1]], "edges": [[0,1],[2,0]]})", "m.json", {});
    REQUIRE(map);
    REQUIRE(map->lines.size() == 2);
    CHECK(map->lines[1].points == std::vector<glm::dvec2>{{0, 1}, {0, 0}});
    CHECK(map->lines[1].source == "m.json: edge 1");
}

TEST_CASE("unknown members are passed over with a warning") {
    const auto map = readJsonMap(
        R"({"sherdMap": 1, "comment": "x", "line": [], "lines": [{"points": [[0,0],[1,1]], "Level": 2}]})",
        "m.json", {});
    REQUIRE(map);
    REQUIRE(map->warnings.size() == 2);
    CHECK(map->warnings[0].find("\"line\"") != std::string::npos);
    CHECK(map->warnings[1].find("m.json#/lines/0") == 0);
}

TEST_CASE("the specification's example is read") {
    const auto path = std::filesystem::path(SHERD_SOURCE_DIR) / "formats" / "spec" /
                      "fracture_map" / "examples" / "window.json";
    const auto map = readFractureMap(path, {});
    REQUIRE(map);
    CHECK(map->lines.size() == 7);
    CHECK(map->warnings.empty());
    CHECK(planarise(*map));
}
