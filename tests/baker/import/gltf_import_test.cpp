// SPDX-License-Identifier: MIT
#include "import/gltf_import.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "mesh_facts.h"
#include "tiny_import.h"
#include "tiny_model.h"

using namespace sherd;
using sherd::test::import;
using sherd::test::importOne;
using sherd::test::Json;
using sherd::test::signedVolume;
using sherd::test::tetrahedron;
using sherd::test::TinyModel;

namespace {

void checkRefused(const TinyModel& model, ErrorCode code, const std::string& where) {
    auto meshes = import(model);
    REQUIRE_FALSE(meshes);
    CHECK(meshes.error().code == code);
    CHECK(meshes.error().where == where);
    CHECK_FALSE(meshes.error().message.empty());
}

const Attribute& attribute(const SurfaceMesh& mesh, const std::string& semantic) {
    const Attribute* found = findAttribute(mesh.attributes, semantic);
    REQUIRE(found != nullptr);
    return *found;
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("a tetrahedron comes in welded, with flat normals and its texture coordinates") {
    const SurfaceMesh mesh = importOne(tetrahedron());
    CHECK(mesh.name == "thing");
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles.size() == 4);
    CHECK(mesh.uvSemantic == "TEXCOORD_0");
    CHECK(mesh.materials == std::vector<int32_t>{-1});
    CHECK(signedVolume(mesh) == doctest::Approx(1.0 / 6));
    // Flat: three attribute vertices per face, each with the face's normal.
    const Attribute& normal = attribute(mesh, "NORMAL");
    CHECK(normal.values.size() == 3 * 12);
    const uint32_t corner = mesh.corners[0][0];
    CHECK(normal.values[3 * corner + 2] == -1.0F);
    CHECK(attribute(mesh, "TEXCOORD_0").values.size() == 2 * 12);
}

TEST_CASE("positions weld bit by bit, minus zero as zero, in order of first appearance") {
    TinyModel model;
    const int position =
        model.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, /**/ -0.0F, 1, 0, 1, -0.0F, 0, 1, 1, 0});
    model.primitive({{"POSITION", position}});
    const SurfaceMesh mesh = importOne(model);
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles[1] == std::array<uint32_t, 3>{2, 1, 3});
    CHECK(mesh.uvSemantic.empty());
}

TEST_CASE("vertices no triangle uses are dropped, degenerate triangles are kept") {
    TinyModel model;
    const int position = model.vec3({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int normal = model.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    model.primitive({{"POSITION", position}, {"NORMAL", normal}},
                    model.indices({1, 2, 3, 1, 1, 2}));
    const SurfaceMesh mesh = importOne(model);
    CHECK(mesh.positions.size() == 3);
    CHECK(mesh.triangles.size() == 2);
    CHECK(attribute(mesh, "NORMAL").values.size() == 9);
}

TEST_CASE("strips and fans give the triangles of their lists, same side out") {
    TinyModel strip;
    strip.primitive({{"POSITION", strip.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})}})["mode"] = 5;
    TinyModel fan;
    fan.primitive({{"POSITION", fan.vec3({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})}})["mode"] = 6;
    for (const TinyModel& model : {strip, fan}) {
        const SurfaceMesh mesh = importOne(model);
        REQUIRE(mesh.triangles.size() == 2);
        const Attribute& normal = attribute(mesh, "NORMAL");
        for (size_t i = 2; i < normal.values.size(); i += 3) CHECK(normal.values[i] == 1.0F);
    }
}

TEST_CASE("index-degenerate triangles that connect runs of a strip are left out") {
    TinyModel model;
    const int position = model.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    model.primitive({{"POSITION", position}}, model.indices({0, 1, 2, 2, 1, 1, 3, 2}))["mode"] = 5;
    CHECK(importOne(model).triangles.size() == 2);
}

TEST_CASE("points are left out and said so, and lines alone are no object") {
    TinyModel model = tetrahedron();
    model.primitive({{"POSITION", 0}})["mode"] = 0;
    const SurfaceMesh mesh = importOne(model);
    CHECK(mesh.triangles.size() == 4);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].find("/meshes/0/primitives/1") != std::string::npos);
    TinyModel lines;
    lines.primitive({{"POSITION", lines.vec3({0, 0, 0, 1, 0, 0})}})["mode"] = 1;
    checkRefused(lines, ErrorCode::noTriangles, "t.glb#/meshes/0");
}

TEST_CASE("attributes are joined over primitives, gaps filled with defaults, materials kept") {
    TinyModel model = tetrahedron();
    model.json["materials"] = Json::array({Json::object(), Json::object()});
    const int color = model.accessor(
        std::vector<uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}, "VEC3", 3, 5121);
    model.json["accessors"].back()["normalized"] = true;
    const int heat = model.accessor(std::vector<float>{1, 2, 3, 4}, "SCALAR", 1, 5126);
    model.primitive({{"POSITION", 0}, {"COLOR_0", color}, {"_HEAT", heat}}, 2)["material"] = 1;
    const SurfaceMesh mesh = importOne(model);
    CHECK(mesh.materials == std::vector<int32_t>{-1, 1});
    CHECK(mesh.triangleMaterials == std::vector<uint32_t>{0, 0, 0, 0, 1, 1, 1, 1});
    const Attribute& colors = attribute(mesh, "COLOR_0");
    CHECK(colors.components == 4);
    CHECK(colors.values[0] == 1.0F);  // the first primitive has none: white
    const uint32_t corner = mesh.corners[4][0];
    CHECK(colors.values[4 * corner] == 1.0F);
    CHECK(colors.values[4 * corner + 1] == 0.0F);
    CHECK(colors.values[4 * corner + 3] == 1.0F);
    CHECK(attribute(mesh, "_HEAT").values[corner] == 1.0F);
    CHECK(attribute(mesh, "TEXCOORD_0").values[2 * corner] == 0.0F);
    CHECK(mesh.warnings.size() == 3);
}

TEST_CASE("normalised integers, quantized positions, byte strides and sparse values are read") {
    TinyModel model;
    // POSITION as int16 with a stride of 8, the last one moved by a sparse value.
    const std::vector<int16_t> packed = {0, 0, 0, 7, 10, 0, 0, 7, 0, 10, 0, 7, 0, 0, 0, 7};
    const int position = model.accessor(packed, "VEC3", 4, 5122);
    model.json["bufferViews"].back()["byteStride"] = 8;
    const int where = model.view(std::vector<uint8_t>{3});
    const int what = model.view(std::vector<int16_t>{0, 0, 10});
    model.json["accessors"][position]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", where}, {"componentType", 5121}}},
        {"values", {{"bufferView", what}}}};
    const int normal = model.accessor(
        std::vector<int8_t>{0, 0, -128, 0, 0, -127, 0, 0, -127, 0, 0, 127}, "VEC3", 3, 5120);
    model.json["accessors"].back()["normalized"] = true;
    const int index = model.accessor(std::vector<uint8_t>{0, 2, 1, 0, 1, 3}, "SCALAR", 1, 5121);
    model.primitive({{"POSITION", position}, {"NORMAL", normal}}, index);
    const SurfaceMesh mesh = importOne(model);
    REQUIRE(mesh.positions.size() == 4);
    CHECK(mesh.positions[3] == glm::vec3(0, 0, 10));
    CHECK(mesh.positions[1] == glm::vec3(10, 0, 0));
    const Attribute& normals = attribute(mesh, "NORMAL");
    CHECK(normals.values[2] == -1.0F);
    CHECK(normals.values[11] == 1.0F);
}

TEST_CASE("a rotation goes to the rest pose and leaves every bit of the vertices") {
    TinyModel model = tetrahedron();
    model.json["nodes"][0]["rotation"] = {0.18257418583505536, 0.3651483716701107,
                                          0.5477225575051661, 0.7302967433402214};
    model.json["nodes"][0]["translation"] = {1, 2, 3};
    model.json["nodes"].push_back({{"children", {0}}, {"rotation", {0, 1, 0, 0}}});
    model.json["scenes"][0]["nodes"] = {1};
    const SurfaceMesh mesh = importOne(model);
    CHECK(mesh.positions == importOne(tetrahedron()).positions);
    CHECK(mesh.restPose.translation.x == doctest::Approx(-1));
    CHECK(mesh.restPose.translation.y == doctest::Approx(2));
    CHECK(mesh.restPose.translation.z == doctest::Approx(-3));
}

TEST_CASE("a matrix that is a rotation counts as one") {
    TinyModel model = tetrahedron();
    model.json["nodes"][0]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    const SurfaceMesh mesh = importOne(model);
    CHECK(mesh.positions == importOne(tetrahedron()).positions);
    const glm::vec3 turned = mesh.restPose.rotation * glm::vec3(1, 0, 0);
    CHECK(glm::length(turned - glm::vec3(0, 1, 0)) < 1e-6F);
    CHECK(mesh.restPose.translation == glm::vec3(5, 6, 7));
}

TEST_CASE("scale is applied to the vertices, and a mirror turns the triangles round") {
    TinyModel model = tetrahedron();
    model.json["nodes"][0]["scale"] = {-2, 3, 4};
    const SurfaceMesh mesh = importOne(model);
    CHECK(mesh.positions[1] == glm::vec3(-2, 0, 0));
    CHECK(mesh.positions[2] == glm::vec3(0, 3, 0));
    CHECK(signedVolume(mesh) == doctest::Approx(4));
    model.json["nodes"][0].erase("scale");
    model.json["nodes"][0]["matrix"] = {-2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1};
    CHECK(signedVolume(importOne(model)) == doctest::Approx(4));
}

TEST_CASE("scale under rotation shears: rest pose times vertex is where the scene shows it") {
    TinyModel model = tetrahedron();
    const double h = std::sqrt(0.5);
    model.json["nodes"][0]["rotation"] = {0, 0, std::sin(0.4), std::cos(0.4)};
    model.json["nodes"].push_back(
        {{"children", {0}}, {"scale", {1, 5, 1}}, {"rotation", {h, 0, 0, h}}});
    model.json["scenes"][0]["nodes"] = {1};
    const SurfaceMesh mesh = importOne(model);
    const glm::vec3 got = mesh.restPose.rotation * mesh.positions[1] + mesh.restPose.translation;
    // (1,0,0) turned by 0.8 about z, y stretched by 5, then turned so that y becomes z.
    CHECK(got.x == doctest::Approx(std::cos(0.8)));
    CHECK(got.y == doctest::Approx(0).epsilon(1e-5));
    CHECK(got.z == doctest::Approx(5 * std::sin(0.8)));
}

TEST_CASE("normals and tangents follow scale and mirror") {
    TinyModel model;
    const int position = model.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int normal = model.vec3({0.6F, 0, 0.8F, 0.6F, 0, 0.8F, 0.6F, 0, 0.8F});
    const int tangent = model.vec4({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
    model.primitive({{"POSITION", position}, {"NORMAL", normal}, {"TANGENT", tangent}});
    model.json["nodes"][0]["scale"] = {-2, 1, 1};
    const SurfaceMesh mesh = importOne(model);
    const Attribute& n = attribute(mesh, "NORMAL");
    CHECK(n.values[0] == doctest::Approx(-0.3 / std::sqrt(0.73)));
    CHECK(n.values[2] == doctest::Approx(0.8 / std::sqrt(0.73)));
    const Attribute& t = attribute(mesh, "TANGENT");
    CHECK(t.values[0] == -1.0F);
    CHECK(t.values[3] == -1.0F);
}

TEST_CASE("normals of no direction are taken from a face, other bad values get defaults") {
    TinyModel model;
    const int position = model.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int normal = model.vec3({0, 0, 0, kNan, 0, 1, 0, 0, 1});
    const int tangent = model.vec4({kNan, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, kNan});
    model.primitive({{"POSITION", position}, {"NORMAL", normal}, {"TANGENT", tangent}});
    const SurfaceMesh mesh = importOne(model);
    CHECK(attribute(mesh, "NORMAL").values == std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1});
    CHECK(attribute(mesh, "TANGENT").values[0] == 1.0F);
    CHECK(mesh.warnings.size() == 2);
}

TEST_CASE("nodes are chosen by name or index, and a wrong name lists what there is") {
    TinyModel model = tetrahedron();
    model.json["nodes"].push_back({{"mesh", 0}, {"name", "spare"}});
    CHECK(import(model)->size() == 1);  // the spare is in no scene
    model.json["nodes"][1]["scale"] = {2, 2, 2};
    auto spare = import(model, {{"spare", "0", "thing"}, 0});
    REQUIRE(spare);
    REQUIRE(spare->size() == 2);
    CHECK(spare->front().node == 1);
    auto wrong = import(model, {{"lamp"}, 0});
    REQUIRE_FALSE(wrong);
    CHECK(wrong.error().code == ErrorCode::badArgument);
    CHECK(wrong.error().message.find("\"spare\"") != std::string::npos);
    model.json.erase("scenes");
    model.json.erase("scene");
    CHECK(import(model)->size() == 2);
}

TEST_CASE("another UV set can be chosen, and a missing one is no error here") {
    TinyModel model = tetrahedron();
    CHECK(import(model, {{}, 1})->front().uvSemantic.empty());
    model.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 1;
    CHECK(import(model, {{}, 1})->front().uvSemantic == "TEXCOORD_1");
}

TEST_CASE("skinned and morphed meshes are refused") {
    TinyModel skinned = tetrahedron();
    skinned.json["nodes"][0]["skin"] = 0;
    checkRefused(skinned, ErrorCode::skinnedMesh, "t.glb#/nodes/0/skin");
    TinyModel weighted = tetrahedron();
    weighted.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = 0;
    checkRefused(weighted, ErrorCode::skinnedMesh, "t.glb#/meshes/0/primitives/0");
    TinyModel morphed = tetrahedron();
    morphed.json["meshes"][0]["primitives"][0]["targets"] = Json::array({{{"POSITION", 0}}});
    checkRefused(morphed, ErrorCode::skinnedMesh, "t.glb#/meshes/0/primitives/0");
}

TEST_CASE("required extensions that hide the geometry are refused, harmless ones are not") {
    TinyModel model = tetrahedron();
    model.json["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_texture_transform",
                                        "KHR_materials_unlit", "EXT_texture_webp"};
    CHECK(import(model));
    model.json["extensionsRequired"].push_back("KHR_draco_mesh_compression");
    checkRefused(model, ErrorCode::unsupportedExtension, "t.glb#/extensionsRequired/4");
    TinyModel draco = tetrahedron();
    draco.json["accessors"][0].erase("bufferView");
    draco.json["meshes"][0]["primitives"][0]["extensions"] = {
        {"KHR_draco_mesh_compression", Json::object()}};
    checkRefused(draco, ErrorCode::unsupportedExtension, "t.glb#/meshes/0/primitives/0");
    TinyModel meshopt = tetrahedron();
    meshopt.json["bufferViews"][0]["buffer"] = 1;
    meshopt.json["bufferViews"][0]["extensions"] = {{"EXT_meshopt_compression", Json::object()}};
    checkRefused(meshopt, ErrorCode::unsupportedExtension, "t.glb#/bufferViews/0");
}

TEST_CASE("numbers that are not finite are refused where they stand") {
    TinyModel position;
    position.primitive({{"POSITION", position.vec3({0, 0, 0, 1, kNan, 0, 0, 1, 0})}});
    checkRefused(position, ErrorCode::invalidData, "t.glb#/accessors/0");
    TinyModel uv;
    uv.primitive({{"POSITION", uv.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})},
                  {"TEXCOORD_0", uv.vec2({0, 0, INFINITY, 0, 0, 1})}});
    checkRefused(uv, ErrorCode::invalidData, "t.glb#/meshes/0/primitives/0/attributes/TEXCOORD_0");
    TinyModel scaled = tetrahedron();
    scaled.json["nodes"][0]["scale"] = {1, 1e39, 1};
    checkRefused(scaled, ErrorCode::invalidData, "t.glb#/nodes/0");
    TinyModel overflow;
    overflow.primitive({{"POSITION", overflow.vec3({0, 0, 0, 1e30F, 0, 0, 0, 1, 0})}});
    overflow.json["nodes"][0]["scale"] = {1e30, 1, 1};
    checkRefused(overflow, ErrorCode::invalidData, "t.glb#/nodes/0");
}

TEST_CASE("a transform that flattens the object is refused") {
    for (const Json& change :
         {Json{{"scale", {1, 0, 1}}}, Json{{"rotation", {0, 0, 0, 0}}},
          Json{{"matrix", {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}) {
        TinyModel model = tetrahedron();
        model.json["nodes"][0].update(change);
        checkRefused(model, ErrorCode::invalidData, "t.glb#/nodes/0");
    }
}

TEST_CASE("node cycles, second parents and children that do not exist are refused") {
    TinyModel cycle = tetrahedron();
    cycle.json["nodes"][0]["children"] = {1};
    cycle.json["nodes"].push_back({{"children", {0}}});
    checkRefused(cycle, ErrorCode::invalidData, "t.glb#/nodes");
    TinyModel self = tetrahedron();
    self.json["nodes"][0]["children"] = {0};
    checkRefused(self, ErrorCode::invalidData, "t.glb#/nodes");
    TinyModel parents = tetrahedron();
    parents.json["nodes"].push_back({{"children", {0}}});
    parents.json["nodes"].push_back({{"children", {0}}});
    checkRefused(parents, ErrorCode::invalidData, "t.glb#/nodes/2/children");
    TinyModel missing = tetrahedron();
    missing.json["nodes"][0]["children"] = {7};
    checkRefused(missing, ErrorCode::invalidData, "t.glb#/nodes/0/children");
}

TEST_CASE("references out of range are refused where they stand") {
    struct Breakage {
        const char* pointer;
        Json value;
        const char* where;
    };
    const std::vector<Breakage> breakages = {
        {"/scene", 3, "/scene"},
        {"/scenes/0/nodes/0", 9, "/scenes/0/nodes"},
        {"/nodes/0/mesh", 5, "/nodes/0/mesh"},
        {"/meshes/0/primitives/0/attributes/POSITION", 77,
         "/meshes/0/primitives/0/attributes/POSITION"},
        {"/meshes/0/primitives/0/material", 0, "/meshes/0"},
        {"/meshes/0/primitives/0/mode", 7, "/meshes/0/primitives/0"},
        {"/accessors/0/bufferView", 9, "/accessors/0"},
        {"/accessors/0/count", 5, "/accessors/0"},
        {"/accessors/0/byteOffset", 4, "/accessors/0"},
        {"/accessors/0/type", "VEC2", "/accessors/0"},
        {"/accessors/0/componentType", 5124, "/accessors/0"},
        {"/accessors/1/count", 3, "/meshes/0/primitives/0/attributes/TEXCOORD_0"},
        {"/accessors/2/componentType", 5126, "/accessors/2"},
        {"/bufferViews/0/byteLength", 1000000, "/accessors/0"},
        {"/bufferViews/0/byteStride", 8, "/accessors/0"},
        {"/bufferViews/0/buffer", 1, "/bufferViews/0/buffer"},
        // What tinygltf would wrap, truncate or drop.
        {"/accessors/0/bufferView", 4294967296ULL, "/accessors/0/bufferView"},
        {"/accessors/0/bufferView", -1, "/accessors/0/bufferView"},
        {"/accessors/0/count", 1e300, "/accessors/0/count"},
        {"/nodes/0/mesh", 0.5, "/nodes/0/mesh"},
        {"/nodes/0/matrix", {1, 2}, "/nodes/0/matrix"},
        {"/nodes/0/scale", {1, "two", 3}, "/nodes/0/scale"},
        {"/meshes/0/primitives/0", 4, "/meshes/0/primitives/0"},
        {"/meshes/0/primitives", 4, "/meshes/0"},
        {"/nodes", 4, "/nodes"},
        {"/extensionsRequired", "x", "/extensionsRequired"},
    };
    for (const Breakage& breakage : breakages) {
        CAPTURE(breakage.pointer);
        CAPTURE(breakage.value.dump());
        TinyModel model = tetrahedron();
        model.json[Json::json_pointer(breakage.pointer)] = breakage.value;
        checkRefused(model, ErrorCode::invalidData, std::string("t.glb#") + breakage.where);
    }
}

TEST_CASE("an index beyond the vertices is refused") {
    TinyModel model = tetrahedron();
    model.bin[model.json["bufferViews"][2]["byteOffset"].get<size_t>()] = 4;
    checkRefused(model, ErrorCode::invalidData, "t.glb#/accessors/2");
}

TEST_CASE("a small file cannot ask for much memory") {
    TinyModel model = tetrahedron();
    model.json["accessors"][0].erase("bufferView");
    model.json["accessors"][0]["count"] = 4000000000U;
    checkRefused(model, ErrorCode::limitExceeded, "t.glb#/accessors/0");
}

TEST_CASE("whatever single member is missing or of another type, nothing crashes") {
    const Json whole = tetrahedron().json.flatten();
    for (const auto& item : whole.items()) {
        const std::string& pointer = item.key();
        for (const Json& value : {Json(), Json("x"), Json(-1), Json(1e9), Json::array(),
                                  Json::object(), Json(true), Json(0)}) {
            TinyModel model = tetrahedron();
            model.json[Json::json_pointer(pointer)] = value;
            CAPTURE(pointer);
            auto meshes = import(model);
            if (!meshes) CHECK_FALSE(meshes.error().message.empty());
        }
    }
}

TEST_CASE("an empty document, or one without meshes, says what is missing") {
    CHECK(importGltf({"{}", {}}, "t.glb", {}).error().code == ErrorCode::noTriangles);
    CHECK(importGltf({"[]", {}}, "t.glb", {}).error().code == ErrorCode::malformed);
    CHECK(importGltf({"", {}}, "t.glb", {}).error().code == ErrorCode::malformed);
    TinyModel empty;
    CHECK(import(empty).error().code == ErrorCode::noTriangles);
}
