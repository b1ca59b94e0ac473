// SPDX-License-Identifier: MIT
#include "import/unit_scale.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "import/gltf_import.h"
#include "tiny_model.h"

using namespace sherd;
using sherd::test::Json;
using sherd::test::tetrahedron;

namespace {

Json scaled(const std::string& json, double metres) {
    GltfDocument document{json, {}};
    const Result<void> done = scaleScenes(document, "t.glb", metres);
    if (!done) FAIL(done.error().message);
    return Json::parse(document.json);
}

Error refusal(const std::string& json) {
    GltfDocument document{json, {}};
    const Result<void> done = scaleScenes(document, "t.glb", 0.5);
    REQUIRE_FALSE(done.has_value());
    return done.error();
}

}  // namespace

TEST_CASE("every scene gets a node of its own above its roots, and nothing else changes") {
    const Json made = scaled(
        R"({"nodes":[{"name":"a"},{"children":[0]},{}],"scenes":[{"nodes":[1]},{"nodes":[2]},{}]})",
        0.25);
    REQUIRE(made["nodes"].size() == 5);
    CHECK(made["scenes"][0]["nodes"] == Json::array({3}));
    CHECK(made["scenes"][1]["nodes"] == Json::array({4}));
    CHECK_FALSE(made["scenes"][2].contains("nodes"));
    CHECK(made["nodes"][3]["children"] == Json::array({1}));
    CHECK(made["nodes"][4]["children"] == Json::array({2}));
    CHECK(made["nodes"][3]["scale"] == Json::array({0.25, 0.25, 0.25}));
    CHECK(made["nodes"][0] == Json::parse(R"({"name":"a"})"));
}

TEST_CASE("a scale is put on once, and changed where it is") {
    const std::string plain = R"({"nodes":[{}],"scenes":[{"nodes":[0]}]})";
    CHECK(scaled(plain, 1) == Json::parse(plain));
    const Json once = scaled(plain, 0.5);
    CHECK(scaled(once.dump(), 0.5) == once);
    const Json other = scaled(once.dump(), 2);
    CHECK(other["nodes"].size() == 2);
    CHECK(other["nodes"][1]["scale"] == Json::array({2, 2, 2}));
    CHECK(scaled(other.dump(), 1)["nodes"][1]["scale"] == Json::array({1, 1, 1}));
}

TEST_CASE("a document without scenes is scaled above the nodes that have no parent") {
    const Json made = scaled(R"({"nodes":[{"children":[1]},{},{}]})", 0.5);
    REQUIRE(made["nodes"].size() == 4);
    CHECK(made["nodes"][3]["children"] == Json::array({0, 2}));
}

TEST_CASE("scenes that share nodes and documents that are broken are refused") {
    const Error shared = refusal(R"({"nodes":[{}],"scenes":[{"nodes":[0]},{"nodes":[0]}]})");
    CHECK(shared.code == ErrorCode::unsupported);
    CHECK(shared.where == "t.glb#/scenes/1/nodes");
    for (const char* bad :
         {"", "[]", "{}", R"({"nodes":3})", R"({"nodes":[],"scenes":[3]})",
          R"({"nodes":[],"scenes":[{"nodes":3}]})", R"({"nodes":[],"scenes":[{"nodes":[-1]}]})",
          R"({"nodes":[],"scenes":[{"nodes":["a"]}]})"}) {
        CAPTURE(bad);
        CHECK(refusal(bad).code == ErrorCode::invalidData);
    }
}

TEST_CASE("an object below the node is imported in metres") {
    const GltfDocument plain = tetrahedron().document();
    GltfDocument small = plain;
    REQUIRE(scaleScenes(small, "t.glb", 0.5).has_value());
    const auto before = importGltf(plain, "t.glb", {});
    const auto after = importGltf(small, "t.glb", {});
    REQUIRE((before.has_value() && after.has_value()));
    REQUIRE(after->size() == 1);
    CHECK(after->front().node == before->front().node);
    for (size_t v = 0; v < before->front().positions.size(); ++v)
        CHECK(after->front().positions[v] == before->front().positions[v] * 0.5F);
    CHECK(after->front().restPose.translation == before->front().restPose.translation * 0.5F);
}
