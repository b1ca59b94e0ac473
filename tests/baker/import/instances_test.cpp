// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "import/gltf_import.h"
#include "mesh_facts.h"
#include "tiny_import.h"
#include "tiny_model.h"

using namespace sherd;
using sherd::test::addNode;
using sherd::test::importAll;
using sherd::test::Json;
using sherd::test::mentions;
using sherd::test::signedVolume;
using sherd::test::tetrahedron;
using sherd::test::TinyModel;

namespace {

SurfaceMesh joined(const TinyModel& model, const std::vector<std::string>& nodes = {}) {
    ImportOptions options;
    options.nodes = nodes;
    options.join = true;
    std::vector<SurfaceMesh> meshes = importAll(model, options);
    REQUIRE(meshes.size() == 1);
    return std::move(meshes.front());
}

/// Where the scene shows a position of the mesh.
glm::vec3 shown(const SurfaceMesh& mesh, size_t position) {
    return mesh.restPose.rotation * mesh.positions[position] + mesh.restPose.translation;
}

}  // namespace

TEST_CASE("two nodes that show a mesh at one scale are one object, hung on the lower node") {
    TinyModel model = tetrahedron();
    model.json["nodes"][0]["scale"] = {2, 2, 2};
    addNode(model, {{"mesh", 0}, {"name", "b"}, {"scale", {2, 2, 2}}, {"translation", {5, 0, 0}}});
    addNode(model, {{"mesh", 0}, {"scale", {2, 2, 2}}, {"rotation", {0, 1, 0, 0}}});
    for (const ImportOptions& options : {ImportOptions(), ImportOptions{{"2", "b", "thing"}, 0}}) {
        const std::vector<SurfaceMesh> meshes = importAll(model, options);
        REQUIRE(meshes.size() == 1);
        CHECK(meshes[0].node == 0);
        CHECK(meshes[0].name == "thing");
        CHECK(meshes[0].restPose.translation == glm::vec3(0));
        CHECK(meshes[0].sameNodes == std::vector<int32_t>{1, 2});
        CHECK(meshes[0].joinedNodes.empty());
        CHECK(meshes[0].warnings.empty());
    }
    CHECK(importAll(model, {{"b"}, 0})[0].sameNodes.empty());
}

TEST_CASE("another scale, or a mirror, makes another object, and that is said") {
    TinyModel model = tetrahedron();
    addNode(model, {{"mesh", 0}, {"name", "big"}, {"scale", {2, 2, 2}}});
    addNode(model, {{"mesh", 0}, {"name", "mirrored"}, {"scale", {-1, 1, 1}}});
    addNode(model, {{"mesh", 0}, {"name", "twin"}, {"scale", {2, 2, 2}}});
    const std::vector<SurfaceMesh> meshes = importAll(model);
    REQUIRE(meshes.size() == 3);
    CHECK(meshes[1].sameNodes == std::vector<int32_t>{3});
    CHECK(
        mentions(meshes[1], "node \"big\" shows the same mesh as node \"thing\" at another scale"));
    CHECK(mentions(meshes[2], "node \"mirrored\""));
    CHECK(meshes[0].warnings.empty());
}

TEST_CASE("equal meshes of different numbers are not the same object") {
    TinyModel model = tetrahedron();
    model.json["meshes"].push_back(model.json["meshes"][0]);
    addNode(model, {{"mesh", 1}});
    CHECK(importAll(model).size() == 2);
}

TEST_CASE("two sights of a mesh with other lines below them are two objects") {
    TinyModel model = tetrahedron();
    const auto lines = [&](const std::vector<float>& points) {
        model.json["meshes"].push_back(
            {{"primitives",
              Json::array({{{"attributes", {{"POSITION", model.vec3(points)}}}, {"mode", 1}}})}});
        return static_cast<int>(model.json["meshes"].size()) - 1;
    };
    const int first = lines({0, 0, 0, 1, 0, 0});
    const int second = lines({0, 0, 0, 0, 1, 0});
    model.json["nodes"].push_back({{"mesh", first}});
    model.json["nodes"][0]["children"] = {1};
    model.json["nodes"].push_back({{"mesh", second}});
    const int twin = addNode(model, {{"mesh", 0}, {"translation", {3, 0, 0}}, {"children", {2}}});
    std::vector<SurfaceMesh> meshes = importAll(model);
    REQUIRE(meshes.size() == 2);
    CHECK(meshes[0].lines.size() == 1);
    CHECK(meshes[1].lines.size() == 1);
    CHECK(mentions(meshes[1], "with other lines below it"));
    // A copy of the whole tree is the same object: its lines are taken once.
    model.json["nodes"][2]["mesh"] = first;
    meshes = importAll(model);
    REQUIRE(meshes.size() == 1);
    CHECK(meshes[0].sameNodes == std::vector<int32_t>{twin});
    CHECK(meshes[0].lines.size() == 1);
}

TEST_CASE("joining one node changes nothing") {
    TinyModel model = tetrahedron();
    model.json["nodes"][0]["scale"] = {1, 2, 3};
    model.json["nodes"][0]["rotation"] = {0.5, 0.5, 0.5, 0.5};
    const SurfaceMesh plain = importAll(model).front();
    const SurfaceMesh one = joined(model);
    CHECK(one.positions == plain.positions);
    CHECK(one.triangles == plain.triangles);
    CHECK(one.joinedNodes.empty());
}

TEST_CASE("joined nodes are one mesh in the frame of the first, welded where positions are equal") {
    TinyModel model = tetrahedron();
    const double h = std::sqrt(0.5);
    for (const Json& rotation : {Json({0, 0, 0, 1}), Json({0, 0, h, h})}) {
        TinyModel two = model;
        two.json["nodes"][0]["rotation"] = rotation;
        two.json["nodes"][0]["translation"] = {7, 8, 9};
        // The second lies beside the first along the first's own x: corner (1,0,0) is shared.
        const glm::dvec3 beside = rotation[2] == 0 ? glm::dvec3(8, 8, 9) : glm::dvec3(7, 9, 9);
        addNode(two, {{"mesh", 0},
                      {"name", "second"},
                      {"rotation", rotation},
                      {"translation", {beside.x, beside.y, beside.z}}});
        const SurfaceMesh mesh = joined(two);
        CHECK(mesh.name == "thing");
        CHECK(mesh.node == 0);
        CHECK(mesh.joinedNodes == std::vector<int32_t>{1});
        CHECK(mesh.sameNodes.empty());
        CHECK(mesh.triangles.size() == 8);
        CHECK(mesh.positions.size() == 7);
        CHECK(signedVolume(mesh) == doctest::Approx(2.0 / 6));
        CHECK(mesh.restPose.translation == glm::vec3(7, 8, 9));
        // The second's own corner (1,0,0).
        const glm::vec3 last = shown(mesh, 4);
        const glm::dvec3 along = beside - glm::dvec3(7, 8, 9);
        CHECK(glm::length(glm::dvec3(last) - (glm::dvec3(7, 8, 9) + 2.0 * along)) < 1e-5);
    }
}

TEST_CASE("a joined node keeps its scale and turn, and a mirrored one turns its triangles round") {
    TinyModel model = tetrahedron();
    model.json["nodes"][0]["rotation"] = {0.5, 0.5, 0.5, 0.5};
    model.json["nodes"][0]["translation"] = {1, 2, 3};
    addNode(model, {{"mesh", 0},
                    {"scale", {-2, 3, 4}},
                    {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}},
                    {"translation", {-4, 5, 6}}});
    const SurfaceMesh mesh = joined(model);
    REQUIRE(mesh.positions.size() == 8);
    CHECK(signedVolume(mesh) == doctest::Approx((1.0 + 24.0) / 6));
    // (1,0,0) of the second: x scaled to -2, then turned by 90 degrees about y to +2 z.
    CHECK(glm::length(shown(mesh, 5) - glm::vec3(-4, 5, 8)) < 1e-5F);
}

TEST_CASE("joined nodes bring their materials, and what one lacks is given defaults") {
    TinyModel model = tetrahedron();
    model.json["materials"] = Json::array({Json::object(), Json::object()});
    model.json["meshes"][0]["primitives"][0]["material"] = 1;
    const int color = model.vec3({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0});
    model.json["meshes"].push_back(
        {{"primitives", Json::array({{{"attributes", {{"POSITION", 0}, {"COLOR_0", color}}},
                                      {"indices", 2},
                                      {"material", 0}}})}});
    addNode(model, {{"mesh", 1}, {"translation", {3, 0, 0}}});
    const SurfaceMesh mesh = joined(model);
    CHECK(mesh.materials == std::vector<int32_t>{1, 0});
    CHECK(mesh.triangleMaterials == std::vector<uint32_t>{0, 0, 0, 0, 1, 1, 1, 1});
    const Attribute* colors = findAttribute(mesh.attributes, "COLOR_0");
    REQUIRE(colors != nullptr);
    CHECK(colors->values[1] == 1.0F);  // white
    CHECK(colors->values[4 * mesh.corners[4][0] + 1] == 0.0F);
    CHECK(mentions(mesh, "has no COLOR_0"));
    CHECK(mentions(mesh, "has no TEXCOORD_0"));
}

TEST_CASE("the order in which nodes are named decides whose frame it is") {
    TinyModel model = tetrahedron();
    addNode(model, {{"mesh", 0}, {"name", "second"}, {"translation", {3, 0, 0}}});
    const SurfaceMesh mesh = joined(model, {"second", "thing"});
    CHECK(mesh.name == "second");
    CHECK(mesh.node == 1);
    CHECK(mesh.joinedNodes == std::vector<int32_t>{0});
    CHECK(mesh.restPose.translation == glm::vec3(3, 0, 0));
    CHECK(mesh.positions[4] == glm::vec3(-3, 0, 0));
}

TEST_CASE("a joined node that cannot be one is refused as if it were alone") {
    TinyModel model = tetrahedron();
    addNode(model, {{"mesh", 0}, {"skin", 0}});
    ImportOptions options;
    options.join = true;
    CHECK(importGltf(model.document(), "t.glb", options).error().code == ErrorCode::skinnedMesh);
    model.json["nodes"][1] = {{"mesh", 0}, {"scale", {0, 1, 1}}};
    CHECK(importGltf(model.document(), "t.glb", options).error().where == "t.glb#/nodes/1");
    model.json["nodes"][1] = {{"mesh", 9}};
    CHECK(importGltf(model.document(), "t.glb", options).error().where == "t.glb#/nodes/1/mesh");
}
