// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <glm/vec3.hpp>

#include "import/gltf_import.h"
#include "mesh_facts.h"
#include "tiny_import.h"
#include "tiny_model.h"

using namespace sherd;
using sherd::test::importOne;
using sherd::test::Json;
using sherd::test::mentions;
using sherd::test::tetrahedron;
using sherd::test::TinyModel;

namespace {

/// A tetrahedron whose material "bark" has a picture.
TinyModel pictured(const Json& textureInfo = Json::object(), const Json& sampler = Json()) {
    TinyModel model = tetrahedron();
    Json info = {{"index", 0}};
    info.update(textureInfo);
    model.json["materials"] =
        Json::array({{{"name", "bark"}, {"pbrMetallicRoughness", {{"baseColorTexture", info}}}}});
    model.json["textures"] = Json::array({{{"source", 0}}});
    model.json["images"] = Json::array({{{"uri", "data:image/png;base64,AA=="}}});
    if (!sampler.is_null()) {
        model.json["textures"][0]["sampler"] = 0;
        model.json["samplers"] = Json::array({sampler});
    }
    model.json["meshes"][0]["primitives"][0]["material"] = 0;
    return model;
}

Json transformed(const Json& extension) {
    return {{"extensions", {{"KHR_texture_transform", extension}}}};
}

glm::dvec2 placed(const SurfaceMesh& mesh, glm::dvec2 uv) {
    REQUIRE(mesh.placements.size() == 1);
    const glm::dvec3 at = mesh.placements[0].transform * glm::dvec3(uv, 1);
    CHECK(at.z == 1);
    return {at.x, at.y};
}

void checkNear(glm::dvec2 a, glm::dvec2 b) {
    CHECK(a.x == doctest::Approx(b.x).epsilon(1e-12));
    CHECK(a.y == doctest::Approx(b.y).epsilon(1e-12));
}

}  // namespace

TEST_CASE("a picture without transform and sampler lies plainly, and nothing is said") {
    const SurfaceMesh mesh = importOne(pictured());
    CHECK(mesh.placements.empty());
    CHECK(mesh.warnings.empty());
    CHECK(importOne(pictured(Json::object(), {{"wrapS", 10497}})).placements.empty());
    CHECK(importOne(tetrahedron()).placements.empty());
}

TEST_CASE("the sampler's wraps come in per axis") {
    const SurfaceMesh mesh =
        importOne(pictured(Json::object(), {{"wrapS", 33648}, {"wrapT", 33071}}));
    REQUIRE(mesh.placements.size() == 1);
    CHECK(mesh.placements[0].wrapU == Wrap::mirror);
    CHECK(mesh.placements[0].wrapV == Wrap::clamp);
    CHECK(mesh.placements[0].transform == glm::dmat3(1.0));
}

TEST_CASE("a texture is scaled, then turned counter-clockwise with v down, then moved") {
    const double quarter = std::acos(-1.0) / 2;
    // The extension's own example: the lower left quadrant of the picture, turned clockwise.
    const SurfaceMesh mesh = importOne(
        pictured(transformed({{"offset", {0, 1}}, {"rotation", quarter}, {"scale", {0.5, 0.5}}})));
    checkNear(placed(mesh, {0, 0}), {0, 1});
    checkNear(placed(mesh, {1, 0}), {0, 0.5});
    checkNear(placed(mesh, {0, 1}), {0.5, 1});
    checkNear(placed(mesh, {1, 1}), {0.5, 0.5});
    // Unequal scales tell the order of scaling and turning.
    const SurfaceMesh uneven =
        importOne(pictured(transformed({{"rotation", quarter}, {"scale", {2, 3}}})));
    checkNear(placed(uneven, {1, 0}), {0, -2});
    checkNear(placed(uneven, {0, 1}), {3, 0});
    CHECK(mesh.warnings.empty());
}

TEST_CASE("the extension's texCoord goes before the texture's") {
    Json info = transformed({{"texCoord", 1}, {"scale", {2, 2}}});
    info["texCoord"] = 0;
    TinyModel model = pictured(info);
    model.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = 1;
    checkNear(placed(importOne(model, 1), {1, 1}), {2, 2});
    const SurfaceMesh other = importOne(model, 0);
    CHECK(other.placements.empty());
    CHECK(mentions(other,
                   "lines are drawn in TEXCOORD_0, the picture of material \"bark\" lies in "
                   "TEXCOORD_1; choose it with --uv 1"));
}

TEST_CASE("each material of a mesh has its own placement, none for materials without a picture") {
    TinyModel model = pictured(transformed({{"scale", {4, 4}}}));
    model.json["materials"].push_back({{"name", "bare"}});
    model.primitive({{"POSITION", 0}, {"TEXCOORD_0", 1}}, 2)["material"] = 1;
    model.primitive({{"POSITION", 0}, {"TEXCOORD_0", 1}}, 2);
    const SurfaceMesh mesh = importOne(model);
    REQUIRE(mesh.materials == std::vector<int32_t>{0, 1, -1});
    REQUIRE(mesh.placements.size() == 3);
    CHECK(mesh.placements[0].transform[0][0] == 4);
    CHECK(mesh.placements[1] == TexturePlacement());
    CHECK(mesh.placements[2] == TexturePlacement());
}

TEST_CASE("a placement that makes no sense is reported and plain") {
    for (const Json& extension :
         {Json{{"offset", {1}}}, Json{{"offset", {1, "x"}}}, Json{{"offset", {1, nullptr}}},
          Json{{"scale", 2}}, Json{{"scale", {0, 1}}}, Json{{"scale", {1e200, 1e200}}},
          Json{{"rotation", "pi"}}, Json{{"texCoord", -1}}, Json{{"texCoord", "one"}}, Json("x")}) {
        CAPTURE(extension.dump());
        const SurfaceMesh mesh = importOne(pictured(transformed(extension)));
        CHECK(mesh.placements.empty());
        REQUIRE(mesh.warnings.size() == 1);
        CHECK(mentions(mesh, "material \"bark\""));
    }
    CHECK(mentions(importOne(pictured(Json::object(), {{"wrapS", 3}})), "sampler"));
    TinyModel noSampler = pictured();
    noSampler.json["textures"][0]["sampler"] = 7;
    CHECK(mentions(importOne(noSampler), "sampler"));
    CHECK(mentions(importOne(pictured({{"index", 9}})), "does not exist"));
}

TEST_CASE("materials of any shape never crash") {
    for (const Json& materials :
         {Json(), Json(4), Json::array({4}), Json::array({{{"name", 3}}}),
          Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", "x"}}}}}}})}) {
        TinyModel model = tetrahedron();
        model.json["materials"] = materials;
        CHECK(importOne(model).placements.empty());
    }
}

TEST_CASE("a primitive without the UV set lies in one point of it, and that is said") {
    TinyModel model = tetrahedron();
    model.primitive({{"POSITION", 0}}, 2);
    const SurfaceMesh mesh = importOne(model);
    REQUIRE(mesh.uvSemantic == "TEXCOORD_0");
    const Attribute* uv = findAttribute(mesh.attributes, "TEXCOORD_0");
    REQUIRE(uv != nullptr);
    for (size_t t = 4; t < 8; ++t) {
        for (const uint32_t v : mesh.corners[t]) CHECK(uv->values[2 * v] == 0.0F);
    }
    CHECK(
        mentions(mesh, "has no TEXCOORD_0: lines drawn in that UV set do not cut its 4 triangles"));
}
