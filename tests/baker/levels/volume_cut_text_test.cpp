// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "sherd/baker/volume_cut.h"

using namespace sherd;

TEST_CASE("cuts are read with their seeds and options") {
    const VolumeCut voronoi = parseVolumeCut("voronoi:50:7:around=0,1,0;2,0,1:spread=0.1").value();
    CHECK(voronoi.kind == VolumeCut::Kind::voronoi);
    CHECK(voronoi.count == 50);
    CHECK(voronoi.seed == 7);
    CHECK(voronoi.around == std::vector<glm::dvec3>{{0, 1, 0}, {2, 0, 1}});
    CHECK(voronoi.spread == 0.1);
    CHECK(parseVolumeCut("voronoi:5:stretch=1,4,1").value().stretch == glm::dvec3(1, 4, 1));
    CHECK(parseVolumeCut("grid:30:jitter=0.3").value().jitter == 0.3);
    const VolumeCut slices = parseVolumeCut("slices:4x3x2:1:jitter=0.4:tilt=0.1").value();
    CHECK(slices.slabs == std::array<uint32_t, 3>{4, 3, 2});
    CHECK(slices.tilt == 0.1);
    CHECK(parseVolumeCut("slices:4x3x2").value().jitter == 0);
    CHECK(parseVolumeCut("wood:20:3:axis=z").value().axis == 2U);
    CHECK(parseVolumeCut("bricks:6x10x1").value().jitter == 0);
    CHECK(parseVolumeCut("points:0,0,0;1,2,3").value().points[1] == glm::dvec3(1, 2, 3));
    CHECK(parseVolumeCut("glass:12x4:2:at=0,1,0").value().centre == glm::dvec3(0, 1, 0));
    const VolumeCut map = parseVolumeCut("map:C:/a=b/cracks.svg:axis=-y:larger=0.1").value();
    CHECK(map.map == "C:/a=b/cracks.svg");
    CHECK(map.along == glm::dvec3(0, -1, 0));
    CHECK(map.only.larger == 0.1);
    CHECK(parseVolumeCut("map:cracks.svg").value().along == glm::dvec3(0));
    CHECK(parseVolumeCut("map:cracks.svg:axis=x:axis=-y").value().along == glm::dvec3(0, -1, 0));
    const PieceChoice only =
        parseVolumeCut("voronoi:6:larger=0.1:smaller=0.5:near=0,1,0:within=2:name=head")
            .value()
            .only;
    CHECK(only.larger == 0.1);
    CHECK(only.smaller == 0.5);
    CHECK(only.near == std::vector<glm::dvec3>{{0, 1, 0}});
    CHECK(only.within == 2);
    CHECK(only.name == "head");
}

TEST_CASE("a cut that cannot be is refused with what could be") {
    struct Wrong {
        const char* text;
        const char* says;
    };
    const Wrong all[] = {
        {"", "known are voronoi"},
        {"voronoy:5", "known are voronoi"},
        {"voronoi", "from 1 to 10000"},
        {"voronoi:0", "from 1 to 10000"},
        {"voronoi:-3", "from 1 to 10000"},
        {"voronoi:10001", "from 1 to 10000"},
        {"voronoi:5:x", "is not a seed"},
        {"voronoi:5:1:jitter=1", "known are around, larger, name, near"},
        {"points:0,0,0", "at least two points"},
        {"points:0,0", "X,Y,Z"},
        {"glass:5", "sectors and rings"},
        {"map", "needs a drawing"},
        {"map:", "needs a drawing"},
        {"map:a.svg:axis=w", "x, y, z, -x, -y or -z"},
        {"map:a.svg:jitter=1", "known are axis, larger"},
        {"bricks:5x5", "rows"},
        {"voronoi:5:larger=2", "from 0 to 1"},
        {"voronoi:5:name=", "name"},
        {"voronoi:5:around=1,2", "X,Y,Z"},
        {"voronoi:5:around=1,2,nan", "X,Y,Z"},
        {"voronoi:5:stretch=1,65,1", "from 1 to 64"},
        {"grid:5:jitter=1.5", "from 0 to 1"},
        {"slices:4x3", "NxMxK"},
        {"slices:0x3x2", "NxMxK"},
        {"slices:100x100x100", "more than 10000 cells"},
        {"wood:5:axis=w", "x, y or z"},
        {"wood:5:elongation=0.5", "from 1 to 64"},
    };
    for (const Wrong& wrong : all) {
        CAPTURE(wrong.text);
        const Result<VolumeCut> cut = parseVolumeCut(wrong.text);
        REQUIRE_FALSE(cut.has_value());
        CHECK(cut.error().code == ErrorCode::badArgument);
        CHECK(cut.error().message.find(wrong.says) != std::string::npos);
    }
}
