// SPDX-License-Identifier: MIT
#include "import/obj_import.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "import/gltf_import.h"
#include "import/polygon_triangulation.h"

using namespace sherd;

namespace {

Result<Model> import(const std::string& text) {
    return importObj(text, "t.obj", {});
}

SurfaceMesh importOne(const std::string& text) {
    auto model = import(text);
    REQUIRE_MESSAGE(model, (model ? "" : model.error().message + model.error().where));
    return model->meshes.front();
}

double areaOf(const std::vector<glm::vec3>& polygon) {
    double sum = 0;
    for (const auto& t : triangulatePolygon(polygon)) {
        const glm::dvec3 a(polygon[t[0]]);
        const glm::dvec3 b(polygon[t[1]]);
        const glm::dvec3 c(polygon[t[2]]);
        const double z = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        CHECK(z >= 0);
        sum += z / 2;
    }
    return sum;
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("a face may have texture coordinates, normals, both or neither") {
    const std::string rest = "vt 0.25 0.25\nvn 0 0 5\n";
    struct Case {
        std::string face;
        bool hasUv;
    };
    for (const Case& c :
         {Case{"f 1 2 3", false}, Case{"f 1/1 2/1 3/1", true}, Case{"f 1//1 2//1 3//1", false},
          Case{"f 1/1/1 2/1/1 3/1/1", true}, Case{"f -4/-1/-1 -3/-1/-1 -2/-1/-1", true}}) {
        CAPTURE(c.face);
        const SurfaceMesh mesh = importOne(kSquare + rest + c.face);
        CHECK(mesh.triangles.size() == 1);
        CHECK(findAttribute(mesh.attributes, "NORMAL")->values[2] == 1.0F);
        CHECK(mesh.uvSemantic == (c.hasUv ? "TEXCOORD_0" : ""));
        if (c.hasUv) CHECK(findAttribute(mesh.attributes, "TEXCOORD_0")->values[1] == 0.75F);
    }
}

TEST_CASE("mixed faces give one mesh with the union of attributes") {
    const SurfaceMesh mesh =
        importOne(kSquare + "vt 0.5 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1 3 4\n");
    CHECK(mesh.triangles.size() == 2);
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.uvSemantic == "TEXCOORD_0");
    CHECK(mesh.warnings.size() == 1);
}

TEST_CASE("line ends, comments, continued lines, signs and exponents are read") {
    const SurfaceMesh mesh = importOne(
        "# head\r\nv +0 0 0 # tail\r\nv 1.0e0 0 -1E-60\r\n\r\n  v 0 1 \\\r\n 0\r\nf 1 2 \\\n3\r\n");
    CHECK(mesh.triangles.size() == 1);
    CHECK(mesh.positions[1] == glm::vec3(1, 0, 0));
    CHECK(importOne("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3").triangles.size() == 1);
}

TEST_CASE("numbers are rounded correctly, so nine digits give the same bits again") {
    const SurfaceMesh mesh =
        importOne("v 0.100000001 16777217 0.333333343\nv 1 0 0\nv 0 1 0\nf 1 2 3");
    CHECK(mesh.positions[0] == glm::vec3(0.1F, 16777216.0F, 1.0F / 3.0F));
}

TEST_CASE("quads and concave polygons are covered exactly") {
    CHECK(importOne(kSquare + "f 1 2 3 4").triangles.size() == 2);
    // An arrowhead whose fan from the first corner would lie outside.
    CHECK(areaOf({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 1, 0}}) == doctest::Approx(4));
    // A comb.
    CHECK(areaOf({{0, 0, 0},
                  {5, 0, 0},
                  {5, 3, 0},
                  {4, 3, 0},
                  {4, 1, 0},
                  {3, 1, 0},
                  {3, 3, 0},
                  {2, 3, 0},
                  {2, 1, 0},
                  {1, 1, 0},
                  {1, 3, 0},
                  {0, 3, 0}}) == doctest::Approx(11));
    // Straight corners stay corners: no crack may open along them.
    const std::vector<glm::vec3> straight = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0},
                                             {2, 2, 0}, {1, 2, 0}, {0, 2, 0}};
    CHECK(triangulatePolygon(straight).size() == 4);
    CHECK(areaOf(straight) == doctest::Approx(4));
}

TEST_CASE("polygons of no area or crossing themselves still give all their triangles") {
    CHECK(triangulatePolygon(std::vector<glm::vec3>(5, glm::vec3(1))).size() == 3);
    CHECK(triangulatePolygon(std::vector<glm::vec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}})
              .size() == 2);
    CHECK(triangulatePolygon(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}})
              .size() == 2);
    CHECK(triangulatePolygon(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}}).empty());
}

TEST_CASE("a cap of 600 corners is one face") {
    std::string text;
    std::string face = "f";
    for (int i = 0; i < 600; ++i) {
        const double angle = 6.283185307179586 * i / 600;
        text +=
            "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
        face += " " + std::to_string(i + 1);
    }
    CHECK(importOne(text + face).triangles.size() == 598);
}

TEST_CASE("bad faces and numbers are refused with their line") {
    struct Case {
        std::string text;
        ErrorCode code;
        std::string where;
    };
    for (const Case& c : std::vector<Case>{
             {"v 0 0\n", ErrorCode::malformed, "t.obj:1"},
             {"v 0 abc 0\n", ErrorCode::malformed, "t.obj:1"},
             {"v 0 nan 0\n", ErrorCode::malformed, "t.obj:1"},
             {"v 0 1e999 0\n", ErrorCode::malformed, "t.obj:1"},
             {"v 0 1e39 0\n", ErrorCode::malformed, "t.obj:1"},
             {"vt inf 0\n", ErrorCode::malformed, "t.obj:1"},
             {"vn 0 0\n", ErrorCode::malformed, "t.obj:1"},
             {kSquare + "f 1 2\n", ErrorCode::malformed, "t.obj:5"},
             {kSquare + "f 0 1 2\n", ErrorCode::malformed, "t.obj:5"},
             {kSquare + "f 1 2 x\n", ErrorCode::malformed, "t.obj:5"},
             {kSquare + "f 1 2 3/\\\n", ErrorCode::malformed, "t.obj:5"},
             {kSquare + "f 1 2 5\n", ErrorCode::invalidData, "t.obj:5"},
             {kSquare + "f 1 2 -5\n", ErrorCode::invalidData, "t.obj:5"},
             {kSquare + "f 1/1 2/1 3/1\n", ErrorCode::invalidData, "t.obj:5"},
             {kSquare + "f 1//1 2//1 3//1\n", ErrorCode::invalidData, "t.obj:5"},
             {kSquare + "f 1 2 4294967297\n", ErrorCode::invalidData, "t.obj:5"},
             {kSquare + "f 1 2 4294967295\n", ErrorCode::invalidData, "t.obj:5"},
             {kSquare + "f 1 2 99999999999999999999\n", ErrorCode::malformed, "t.obj:5"},
             {kSquare, ErrorCode::noTriangles, "t.obj"},
             {"", ErrorCode::noTriangles, "t.obj"},
         }) {
        CAPTURE(c.text);
        auto model = import(c.text);
        REQUIRE_FALSE(model);
        CHECK(model.error().code == c.code);
        CHECK(model.error().where == c.where);
    }
}

TEST_CASE("a face of too many corners is refused") {
    std::string face = "f";
    for (int i = 0; i < 5000; ++i) face += " 1";
    CHECK(import(kSquare + face).error().code == ErrorCode::limitExceeded);
}

TEST_CASE("the made document reads back as the same mesh") {
    auto model =
        import(kSquare + "v 0.5 0.5 1 1 0 0\nvt 0 0\nvt 1 1\no pyramid\nusemtl stone\n" +
               "f 4/1 3/1 2/2 1/1\nusemtl sky\nf 1/1 2/1 5/2\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
    REQUIRE(model);
    const SurfaceMesh& made = model->meshes.front();
    auto back = importGltf(model->document, "t.glb", {});
    REQUIRE_MESSAGE(back, (back ? "" : back.error().message));
    const SurfaceMesh& read = back->front();
    CHECK(made.name == "pyramid");
    CHECK(read.name == made.name);
    CHECK(read.node == made.node);
    CHECK(read.mesh == made.mesh);
    CHECK(read.materials == made.materials);
    CHECK(read.triangleMaterials == made.triangleMaterials);
    CHECK(read.positions.size() == made.positions.size());
    REQUIRE(read.triangles.size() == made.triangles.size());
    for (size_t t = 0; t < read.triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            CHECK(read.positions[read.triangles[t][k]] == made.positions[made.triangles[t][k]]);
        }
    }
    CHECK(read.attributes.size() == made.attributes.size());
}

TEST_CASE("materials and textures beside the model are taken in, missing ones reported") {
    const auto folder = std::filesystem::temp_directory_path() / "sherd_obj_test";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "m.mtl") << "newmtl red\r\nKd 1 0 0\r\nd 0.5\r\nnewmtl wood\n"
                                       "map_Kd -s 2 2 1 -clamp on oak planks.png\nnewmtl lost\n"
                                       "map_Kd C:\\lost.png\n";
    std::ofstream(folder / "oak planks.png", std::ios::binary) << "\x89PNG\r\n\x1a\n...";
    auto model = importObj(kSquare +
                               "mtllib m.mtl\nmtllib none.mtl\nusemtl red\nf 1 2 3\n"
                               "usemtl wood\nf 1 3 4\nusemtl lost\nf 1 2 4\nusemtl red\n"
                               "f 2 3 4\n",
                           folder / "t.obj", {});
    std::filesystem::remove_all(folder);
    REQUIRE(model);
    const auto json = nlohmann::json::parse(model->document.json);
    REQUIRE(json["materials"].size() == 3);
    CHECK(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] ==
          nlohmann::json({1.0, 0.0, 0.0, 0.5}));
    CHECK(json["materials"][1]["pbrMetallicRoughness"].contains("baseColorTexture"));
    CHECK(json["images"][0]["mimeType"] == "image/png");
    CHECK(json["meshes"][0]["primitives"].size() == 3);
    CHECK(model->meshes[0].warnings.size() == 2);
}
