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
    set.fragments[3].friction = 0.1F;
    set.geometry.attributes.push_back(
        {"_HEAT", 1, std::vector<float>(set.geometry.positions.size(), 0.3F)});
    const auto sets = mustRead(mustAttach(makeIntactDocument(set), set));
    REQUIRE(sets.size() == 1);
    CHECK(sets[0].sourceHash.size() == 16);
    set.sourceHash = sets[0].sourceHash;
    CHECK(whatDiffers(set, sets[0]) == "");
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
