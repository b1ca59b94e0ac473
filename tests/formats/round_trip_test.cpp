// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstring>

#include "sherd/formats/glb_read.h"
#include "sherd/formats/glb_write.h"
#include "support/fractured_cube.h"
#include "support/same_set.h"

using namespace sherd;
using namespace sherd::test;

namespace {

std::vector<FractureSet> mustRead(const std::vector<uint8_t>& glb) {
    auto sets = readFractureSets(glb);
    if (!sets) FAIL(sets.error().message << " at " << sets.error().where);
    return std::move(*sets);
}

std::vector<uint8_t> mustAttach(const GltfDocument& document, const FractureSet& set) {
    const NewMaterial inside{"inside"};
    auto glb = attachFractureSets(document, {&set, 1}, {&inside, 1});
    if (!glb) FAIL(glb.error().message << " at " << glb.error().where);
    return std::move(*glb);
}

/// The intact document with more nodes behind the first.
GltfDocument withNodes(const FractureSet& set, const std::vector<std::string>& nodes) {
    GltfDocument document = makeIntactDocument(set);
    const size_t at = document.json.find("}],\"meshes\"") + 1;
    std::string more;
    for (const std::string& node : nodes) more += "," + node;
    document.json.insert(at, more);
    return document;
}

}  // namespace

TEST_CASE("an object that is not divided at all is written and read") {
    FracturedCubeOptions options;
    options.splits.clear();
    FractureSet set = makeFracturedCube(options);
    const auto sets = mustRead(mustAttach(makeIntactDocument(set), set));
    REQUIRE(sets.size() == 1);
    set.sourceHash = sets[0].sourceHash;
    CHECK(whatDiffers(set, sets[0]) == "");
}

TEST_CASE("everything in a fracture set survives the file, bit for bit") {
    FracturedCubeOptions options;
    options.size = {0.3F, 1.7F, 0.9F};
    options.splits = {{2, 1, 1}, {1, 3, 2}, {2, 2, 2}};
    options.anchorBottom = true;
    options.restPose.translation = {0.1F, -2.3F, 1e-7F};
    options.restPose.rotation = glm::normalize(glm::quat(0.3F, 0.1F, -0.7F, 0.2F));
    options.name = "a \"quoted\" name, \xC3\xA9";
    FractureSet set = makeFracturedCube(options);
    set.fragments[3].name = "corner";
    set.fragments[2].material =
        "\xC3\xA9"
        "b\xC3\xA8ne";
    set.fragments[3].friction = 0.1F;
    set.geometry.attributes.push_back(
        {"_HEAT", 1, std::vector<float>(set.geometry.positions.size(), 0.3F)});
    const auto sets = mustRead(mustAttach(makeIntactDocument(set), set));
    REQUIRE(sets.size() == 1);
    CHECK(sets[0].sourceHash.size() == 16);
    set.sourceHash = sets[0].sourceHash;
    CHECK(whatDiffers(set, sets[0]) == "");
}

TEST_CASE("names and materials that nobody gave take no room") {
    FractureSet set = makeFracturedCube();
    for (Fragment& fragment : set.fragments) fragment.name.clear();
    const auto bare = parseGlb(mustAttach(makeIntactDocument(set), set), "bare");
    REQUIRE(bare);
    CHECK(bare->json.find("\"names\"") == std::string::npos);
    CHECK(bare->json.find("\"fragments\":{\"count\":19,\"attributes\"") != std::string::npos);
    set.fragments[4].material = "oak";
    const auto sets = mustRead(mustAttach(makeIntactDocument(set), set));
    CHECK(sets[0].fragments[4].material == "oak");
    CHECK(sets[0].fragments[3].material.empty());
}

TEST_CASE("a set is hung on every node that shows its mesh, and taken off all of them") {
    FractureSet set = makeFracturedCube();
    set.restPose.translation = {1, 2, 3};
    const GltfDocument document =
        withNodes(set, {R"({"mesh":0,"translation":[5,0,0]})", R"({"name":"other"})",
                        R"({"mesh":0,"extensions":{"EXT_x":{}}})"});
    set.sameNodes = {1, 3};
    const std::vector<uint8_t> glb = mustAttach(document, set);
    const auto sets = mustRead(glb);
    REQUIRE(sets.size() == 1);
    set.sourceHash = sets[0].sourceHash;
    CHECK(whatDiffers(set, sets[0]) == "");
    const auto back = withoutFractureSets(*parseGlb(glb, "baked"));
    REQUIRE(back);
    CHECK(back->json == document.json);
    CHECK(back->bin == document.bin);
}

TEST_CASE("joined nodes are listed and carry nothing") {
    FractureSet set = makeFracturedCube();
    const GltfDocument document = withNodes(set, {R"({"mesh":0})", R"({"mesh":0})"});
    set.joinedNodes = {2, 1};
    const std::vector<uint8_t> glb = mustAttach(document, set);
    const auto sets = mustRead(glb);
    REQUIRE(sets.size() == 1);
    set.sourceHash = sets[0].sourceHash;
    CHECK(whatDiffers(set, sets[0]) == "");
    const auto baked = parseGlb(glb, "baked");
    CHECK(baked->json.find("\"joined\":[2,1]") != std::string::npos);
    CHECK(baked->json.find("\"fracture\":0") == baked->json.rfind("\"fracture\":0"));
    CHECK(withoutFractureSets(*baked)->json == document.json);
    FractureSet alone = set;
    alone.joinedNodes.clear();
    CHECK(mustRead(mustAttach(document, alone))[0].sourceHash != set.sourceHash);
}

TEST_CASE("nodes that cannot carry a set, or carry one already, are refused") {
    const FractureSet cube = makeFracturedCube();
    GltfDocument document =
        withNodes(cube, {R"({"mesh":0})", R"({"name":"empty"})", R"({"mesh":1})"});
    const std::string meshes = "\"meshes\":[";
    document.json.insert(document.json.find(meshes) + meshes.size(), "{\"primitives\":[]},");
    struct Nodes {
        std::vector<int32_t> same;
        std::vector<int32_t> joined;
    };
    const NewMaterial inside{"inside"};
    const auto attached = [&](int32_t node, const Nodes& nodes) {
        FractureSet set = cube;
        set.node = node;
        set.sameNodes = nodes.same;
        set.joinedNodes = nodes.joined;
        return attachFractureSets(document, {&set, 1}, {&inside, 1}).has_value();
    };
    CHECK(attached(0, {{1}, {}}));
    CHECK(attached(0, {{}, {1, 3}}));
    CHECK_FALSE(attached(0, {{2}, {}}));     // no mesh
    CHECK_FALSE(attached(0, {{3}, {}}));     // another mesh
    CHECK_FALSE(attached(0, {{9}, {}}));     // no node
    CHECK_FALSE(attached(0, {{-1}, {}}));    // no node
    CHECK_FALSE(attached(0, {{0}, {}}));     // itself
    CHECK_FALSE(attached(0, {{1, 1}, {}}));  // twice
    CHECK_FALSE(attached(1, {{0}, {}}));     // in front: the pose would be taken for its
    CHECK_FALSE(attached(0, {{1}, {3}}));    // an object of several nodes, twice
    CHECK_FALSE(attached(0, {{}, {0}}));     // itself
    CHECK_FALSE(attached(0, {{}, {1, 1}}));  // twice
    CHECK_FALSE(attached(0, {{}, {2}}));     // no mesh
    CHECK_FALSE(attached(0, {{}, {1000000000}}));
    std::vector<FractureSet> two = {cube, cube};
    two[0].joinedNodes = {1};
    two[1].node = 1;
    CHECK_FALSE(attachFractureSets(document, two, {&inside, 1}));
}

TEST_CASE("the source document stays bit for bit under what is added") {
    const FractureSet set = makeFracturedCube();
    GltfDocument document = makeIntactDocument(set);
    // Numbers and members that a parser would print differently or drop.
    document.json.insert(document.json.size() - 1,
                         ",\"extras\":{\"a\":1e5,\"b\":-0,\"c\":123456789012345678901234567890,"
                         "\"d\":0.1000,\"e\":{},\"f\":[ ],\"g\":null,\"\\u0067\":1}");
    const std::vector<uint8_t> glb = mustAttach(document, set);
    const auto baked = parseGlb(glb, "baked");
    REQUIRE(baked);
    CHECK(baked->json.find("\"extras\":{\"a\":1e5,\"b\":-0,\"c\":123456789012345678901234567890,"
                           "\"d\":0.1000,\"e\":{},\"f\":[ ],\"g\":null,\"\\u0067\":1}") !=
          std::string::npos);
    CHECK(std::memcmp(baked->bin.data(), document.bin.data(), document.bin.size()) == 0);
    const auto back = withoutFractureSets(*baked);
    REQUIRE(back);
    CHECK(back->json == document.json);
    CHECK(back->bin == document.bin);
}

TEST_CASE("baking a baked file again replaces the old set and adds nothing") {
    const FractureSet set = makeFracturedCube();
    const std::vector<uint8_t> once = mustAttach(makeIntactDocument(set), set);
    const auto document = parseGlb(once, "baked");
    REQUIRE(document);
    FractureSet again = set;
    again.materials = {0, 2};  // counted in the baked document: its two, then the new one
    const std::vector<uint8_t> twice = mustAttach(*document, again);
    CHECK(once == twice);
}

TEST_CASE("a material of an earlier bake stays when the new set asks for it") {
    const FractureSet set = makeFracturedCube();
    const auto document = parseGlb(mustAttach(makeIntactDocument(set), set), "baked");
    REQUIRE(document);
    const auto glb = attachFractureSets(*document, {&set, 1}, {});
    REQUIRE(glb);
    CHECK(mustRead(*glb)[0].materials == std::vector<int32_t>{0, 1});
}

TEST_CASE("what another tool appended after the bake is not taken away") {
    const FractureSet set = makeFracturedCube();
    auto document = parseGlb(mustAttach(makeIntactDocument(set), set), "baked");
    REQUIRE(document);
    const size_t place = document->json.find("\"materials\":[") + std::strlen("\"materials\":[");
    document->json.insert(place, "{},");
    const auto stripped = withoutFractureSets(*document);
    REQUIRE(stripped);
    CHECK(stripped->json.find("SHERD_mesh_fracture") == std::string::npos);
    CHECK(stripped->bin == document->bin);
    CHECK(stripped->json.find("inside") != std::string::npos);
}

TEST_CASE("a document with neither buffers nor materials can be baked") {
    const FractureSet set = makeFracturedCube();
    FractureSet bare = set;
    bare.materials = {-1, 0};
    const GltfDocument document{
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[]}]})", {}};
    const std::vector<uint8_t> glb = mustAttach(document, bare);
    CHECK(mustRead(glb)[0].materials == std::vector<int32_t>{-1, 0});
    const auto back = withoutFractureSets(*parseGlb(glb, "baked"));
    REQUIRE(back);
    CHECK(back->json == document.json);
    CHECK(back->bin.empty());
}

TEST_CASE("a set that the runtime would refuse is not written") {
    FractureSet set = makeFracturedCube();
    const GltfDocument document = makeIntactDocument(set);
    set.fragments[1].mass = NAN;
    const auto glb = attachFractureSets(document, {&set, 1}, {});
    CHECK_FALSE(glb);
    set = makeFracturedCube();
    set.node = 7;
    CHECK_FALSE(attachFractureSets(document, {&set, 1}, {}));
    set.node = 0;
    const std::vector<FractureSet> two = {set, set};
    CHECK_FALSE(attachFractureSets(document, two, {}));
    set.geometry.attributes[0].values.pop_back();
    CHECK_FALSE(attachFractureSets(document, {&set, 1}, {}));
}

TEST_CASE("the same set gives the same bytes") {
    CHECK(makeBakedCube() == makeBakedCube());
}
