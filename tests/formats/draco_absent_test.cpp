// SPDX-License-Identifier: MIT
// A library without Draco, whatever the build: draco_stream.cpp is compiled again for this program.
#include <doctest/doctest.h>

#include "sherd/formats/glb_read.h"
#include "sherd/formats/glb_write.h"
#include "support/fractured_cube.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("a build without Draco says how to have it, where something needs it") {
    REQUIRE_FALSE(hasDraco());
    const FractureSet set = makeFracturedCube({});
    const NewMaterial inside{"inside"};
    const auto attach = [&](const GeometryPacking& packing) {
        return attachFractureSets(makeIntactDocument(set), {&set, 1}, {&inside, 1}, packing);
    };
    const auto packed = attach({GeometryPacking::Encoding::draco});
    REQUIRE_FALSE(packed.has_value());
    CHECK(packed.error().code == ErrorCode::unsupported);
    CHECK(packed.error().message.find("SHERD_DRACO=ON") != std::string::npos);

    auto document = parseGlb(attach({}).value(), "cube").value();
    const std::string geometry = "\"geometry\":{\"encoding\":\"none\"";
    const size_t at = document.json.find(geometry);
    REQUIRE(at != std::string::npos);
    const size_t end = document.json.find("\"indices\":", at);
    document.json.replace(
        at, end - at,
        "\"geometry\":{\"encoding\":\"draco\",\"vertexCount\":3,\"indexCount\":3,"
        "\"attributes\":{\"POSITION\":{\"id\":0,\"components\":3,\"origin\":[0,0,0],"
        "\"step\":1}},\"stream\":0,");
    const auto read = readFractureSets(toGlb(document));
    REQUIRE_FALSE(read.has_value());
    CHECK(read.error().code == ErrorCode::unsupported);
    CHECK(read.error().message.find("SHERD_DRACO=ON") != std::string::npos);
    CHECK(read.error().where.find("/geometry/stream") != std::string::npos);
}
