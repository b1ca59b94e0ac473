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
        {withLine(R"({"points": [[0,0],[1,1]], "curve": "spline"})"), "/lines/1/curve"},
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

TEST_CASE("a map over the surface, of labels and curves, is read as its example says") {
    const auto path = std::filesystem::path(SHERD_SOURCE_DIR) / "formats" / "spec" /
                      "fracture_map" / "examples" / "vase.json";
    const auto map = readFractureMap(path, {});
    REQUIRE(map);
    CHECK(map->lines.size() == 3);
    CHECK(map->surfaceLines.size() == 2);
    CHECK(map->labels.size() == 3);
    CHECK(map->warnings.empty());
    CHECK(planarise(*map));
}

TEST_CASE("strength and toughness come from the line, else from the map's defaults") {
    const auto map = readJsonMap(
        R"({"sherdMap": 1, "defaults": {"level": 3, "toughness": 4, "comment": "x"},
            "lines": [{"points": [[0,0],[1,1]]},
                      {"points": [[0,0],[1,1]], "level": 2, "strength": 5e6, "toughness": 0},
                      {"points": [[0,0],[1,1]], "surface": true}],
            "nodes": [[0,0],[1,0]], "edges": [[0,1]]})",
        "m.json", {});
    REQUIRE(map);
    REQUIRE(map->lines.size() == 3);
    CHECK(map->lines[0].level == 3);
    CHECK(map->lines[0].properties.toughness == 4.0F);
    CHECK_FALSE(map->lines[0].properties.strength);
    CHECK(map->lines[1].level == 2);
    CHECK(map->lines[1].properties.strength == 5e6F);
    CHECK(map->lines[1].properties.toughness == 0.0F);
    CHECK(map->lines[2].properties.toughness == 4.0F);
    CHECK(map->surfaceLines[0].level == 3);
    CHECK(map->surfaceLines[0].properties.toughness == 4.0F);
    CHECK(map->warnings.empty());
}

TEST_CASE("a map of surface lines alone is not empty") {
    MapReadOptions options;
    options.level = 2;
    const auto map = readJsonMap(
        R"({"sherdMap": 1, "lines": [
            {"surface": true, "points": [[0,0],[1,2,3],[8,-8]], "closed": true, "name": "ring"},
            {"surface": true, "points": [[-1e6,0,1e6],[1,1,1]], "level": 1, "curve": "line"}]})",
        "m.json", options);
    REQUIRE(map);
    CHECK(map->lines.empty());
    REQUIRE(map->surfaceLines.size() == 2);
    const FractureMap::SurfaceLine& ring = map->surfaceLines[0];
    REQUIRE(ring.places.size() == 4);
    CHECK_FALSE(ring.places[0].in3d);
    CHECK(ring.places[1].in3d);
    CHECK(ring.places[1].point == glm::dvec3(1, 2, 3));
    CHECK(ring.places[2].point == glm::dvec3(8, -8, 0));
    CHECK(ring.places[3].point == ring.places[0].point);
    CHECK(ring.level == 2);
    CHECK(ring.source == "m.json: line 0 \"ring\"");
    CHECK(map->surfaceLines[1].level == 1);
    CHECK(map->surfaceLines[1].places.size() == 2);
}

TEST_CASE("labels are read, and alone they make no map") {
    CHECK(errorOf(R"({"sherdMap": 1, "labels": [{"at": [0,0]}]})").first == ErrorCode::emptyMap);
    const auto map = readJsonMap(
        R"({"sherdMap": 1, "lines": [{"points": [[0,0],[1,1]]}], "labels": [
            {"at": [0.5, 0.25]},
            {"at": [1, 2, 3], "name": "rim", "material": "glass", "density": 2500, "strength": 0,
             "toughness": 8, "anchor": true, "level": 2, "comment": 1}]})",
        "m.json", {});
    REQUIRE(map);
    REQUIRE(map->labels.size() == 2);
    CHECK(map->labels[0].place.point == glm::dvec3(0.5, 0.25, 0));
    CHECK_FALSE(map->labels[0].place.in3d);
    CHECK(map->labels[0].level == 0);
    CHECK_FALSE(map->labels[0].anchor);
    CHECK_FALSE(map->labels[0].density);
    CHECK(map->labels[0].source == "m.json: label 0");
    const FractureMap::Label& rim = map->labels[1];
    CHECK(rim.place.in3d);
    CHECK(rim.place.point == glm::dvec3(1, 2, 3));
    CHECK(rim.name == "rim");
    CHECK(rim.material == "glass");
    CHECK(rim.density == 2500.0F);
    CHECK(rim.strength == 0.0F);
    CHECK(rim.toughness == 8.0F);
    CHECK(rim.anchor);
    CHECK(rim.level == 2);
    CHECK(rim.source == "m.json: label 1 \"rim\"");
    CHECK(map->warnings.empty());
}

TEST_CASE("every mistake in settings, labels and lines over the surface carries its pointer") {
    const auto label = [](const std::string& members) {
        return R"({"sherdMap": 1, "labels": [)" + members + "]}";
    };
    const std::pair<std::string, std::string> cases[] = {
        {R"({"sherdMap": 1, "defaults": 3})", "/defaults"},
        {R"({"sherdMap": 1, "defaults": {"level": 0}})", "/defaults/level"},
        {R"({"sherdMap": 1, "defaults": {"strength": "x"}})", "/defaults/strength"},
        {withLine(R"({"points": [[0,0],[1,1]], "strength": -1})"), "/lines/1/strength"},
        {withLine(R"({"points": [[0,0],[1,1]], "strength": "5"})"), "/lines/1/strength"},
        {withLine(R"({"points": [[0,0],[1,1]], "toughness": 1e39})"), "/lines/1/toughness"},
        {withLine(R"({"points": [[0,0],[1,1]], "toughness": null})"), "/lines/1/toughness"},
        {withLine(R"({"points": [[0,0],[1,1]], "surface": 1})"), "/lines/1/surface"},
        {withLine(R"({"points": [[0,0],[1,1,1]]})"), "/lines/1/points/1"},
        {withLine(R"({"surface": true, "points": [[0,0],[1]]})"), "/lines/1/points/1"},
        {withLine(R"({"surface": true, "points": [[0,0],[1,1,1,1]]})"), "/lines/1/points/1"},
        {withLine(R"({"surface": true, "points": [[0,0],[1,8.5]]})"), "/lines/1/points/1"},
        {withLine(R"({"surface": true, "points": [[0,0],[1,1,"x"]]})"), "/lines/1/points/1"},
        {withLine(R"({"surface": true, "points": [[0,0,0]]})"), "/lines/1/points"},
        {withLine(R"({"surface": true, "points": {}})"), "/lines/1/points"},
        {withLine(R"({"surface": true, "points": [[0,0],[1,1]], "curve": "bezier"})"),
         "/lines/1/curve"},
        {R"({"sherdMap": 1, "labels": {}})", "/labels"},
        {label("3"), "/labels/0"},
        {label(R"({"name": "x"})"), "/labels/0"},
        {label(R"({"at": 3})"), "/labels/0/at"},
        {label(R"({"at": [1]})"), "/labels/0/at"},
        {label(R"({"at": [0, 9]})"), "/labels/0/at"},
        {label(R"({"at": [0, 0], "name": 3})"), "/labels/0/name"},
        {label(R"({"at": [0, 0], "material": []})"), "/labels/0/material"},
        {label(R"({"at": [0, 0], "density": 0})"), "/labels/0/density"},
        {label(R"({"at": [0, 0], "density": 1e-60})"), "/labels/0/density"},
        {label(R"({"at": [0, 0], "strength": -1})"), "/labels/0/strength"},
        {label(R"({"at": [0, 0], "toughness": true})"), "/labels/0/toughness"},
        {label(R"({"at": [0, 0], "anchor": "yes"})"), "/labels/0/anchor"},
        {label(R"({"at": [0, 0], "level": -1})"), "/labels/0/level"},
        {label(R"({"at": [0, 0], "level": 65})"), "/labels/0/level"},
    };
    for (const auto& [text, pointer] : cases)
        CHECK(errorOf(text) == std::pair(ErrorCode::invalidData, "m.json#" + pointer));
    const auto three = readJsonMap(withLine(R"({"points": [[0,0,0],[1,1,1]]})"), "m.json", {});
    REQUIRE_FALSE(three);
    CHECK(three.error().message.find("\"surface\": true") != std::string::npos);
}

TEST_CASE("members of a curve on a line that is none are passed over with a warning") {
    const auto map = readJsonMap(
        R"({"sherdMap": 1, "lines": [{"points": [[0,0],[1,1]], "degree": 2, "weights": [1, 1]}]})",
        "m.json", {});
    REQUIRE(map);
    CHECK(map->warnings.size() == 2);
}

TEST_CASE("every mistake in a NURBS curve carries its pointer") {
    const std::string points = R"("points": [[0,0],[1,0],[1,1],[0,1]])";
    const auto nurbs = [&](const std::string& members) {
        return R"({"sherdMap": 1, "lines": [{"curve": "nurbs", )" + points + ", " + members + "}]}";
    };
    const std::pair<std::string, std::string> cases[] = {
        {R"("degree": 0)", "degree"},
        {R"("degree": 11)", "degree"},
        {R"("degree": 2.5)", "degree"},
        {R"("degree": "3")", "degree"},
        {R"("degree": 4)", "points"},
        {R"("degree": 4, "closed": true)", "points"},
        {R"("weights": 3)", "weights"},
        {R"("weights": [])", "weights"},
        {R"("weights": [1, 1, 1])", "weights"},
        {R"("weights": [1, 1, 1, 1, 1])", "weights"},
        {R"("weights": [1, 0, 1, 1])", "weights/1"},
        {R"("weights": [1, 1, -1, 1])", "weights/2"},
        {R"("weights": [1, 1, 1, "1"])", "weights/3"},
        {R"("knots": [])", "knots"},
        {R"("knots": {})", "knots"},
        {R"("knots": [0,0,0,0,1,1,1])", "knots"},
        {R"("knots": [0,0,0,0,1,1,1,1,1])", "knots"},
        {R"("knots": [0,0,0,0,1,1,1,null])", "knots/7"},
        {R"("knots": [0,0,0,0,1,1,1,0.5])", "knots/7"},
        {R"("knots": [1,1,1,1,1,1,1,1])", "knots"},
        {R"("knots": [0,1,2,3,3,4,5,6])", "knots"},
        {R"("degree": 1, "knots": [0,0,1,1,2,2])", "knots/2"},
        {R"("degree": 1, "knots": [0,0,0,1,2,2])", "knots/0"},
        {R"("degree": 2, "knots": [0,0,0,0.5,1,1,1], "weights": [1,1,1])", "weights"},
        {R"("knots": [-1.7e308,0,0,0,1,1,1,1.7e308])", "knots"},
        {R"("closed": true, "knots": [0,1,2,3])", "knots"},
        {R"("closed": true, "knots": [0,1,2,3,4,5,6,7])", "knots"},
        {R"("closed": true, "knots": [0,0,0,0,4])", "knots/0"},
        {R"("closed": true, "degree": 2, "knots": [0,1,1,1,4])", "knots/1"},
        {R"("closed": true, "degree": 2, "knots": [0,0,1,4,4])", "knots/0"},
    };
    for (const auto& [members, member] : cases) {
        CAPTURE(members);
        const auto [code, where] = errorOf(nurbs(members));
        CHECK(code == ErrorCode::invalidData);
        CHECK(where == "m.json#/lines/0/" + member);
    }
    CHECK(
        errorOf(
            R"({"sherdMap": 1, "lines": [{"curve": "nurbs", "points": [[0,0],[1,1e300],[0,1],[1,1]]}]})")
            .first == ErrorCode::limitExceeded);
}
