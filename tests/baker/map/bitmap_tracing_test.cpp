// SPDX-License-Identifier: MIT
// Drawings of known graphs, traced: the same graph comes back, nowhere a texel away.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bitmap_drawing.h"
#include "map/planar_map.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FractureMap traced(const std::vector<uint8_t>& bytes, const BitmapOptions& options = {}) {
    MapReadOptions read;
    read.bitmap = options;
    Result<FractureMap> map = readBitmapMap(bytes, "cracks.png", read);
    INFO((map ? std::string() : map.error().message));
    REQUIRE(map);
    return std::move(*map);
}

void checkSameGraph(const FractureMap& map, const Drawing& drawing, double within = 1) {
    std::string warnings;
    for (const std::string& warning : map.warnings) warnings += warning + "\n";
    CAPTURE(warnings);
    const std::vector<Polyline> lines = inTexels(map, drawing);
    const GraphCounts is = countGraph(lines);
    const GraphCounts should = countGraph(drawing.lines);
    CHECK(is.nodes == should.nodes);
    CHECK(is.edges == should.edges);
    CHECK(is.loose == should.loose);
    CHECK(hausdorff(lines, drawing.lines) < within);
}

Drawing star(int arms, double turn, double length = 40) {
    Drawing drawing{110, 110, {}};
    const glm::dvec2 centre(54.3, 55.6);
    for (int k = 0; k < arms; ++k) {
        const double angle = turn + 2 * 3.14159265358979 * k / arms;
        drawing.lines.push_back(
            {centre, centre + length * glm::dvec2(std::cos(angle), std::sin(angle))});
    }
    return drawing;
}

Drawing ring(double radius) {
    Drawing drawing{100, 100, {{}}};
    for (int k = 0; k < 180; ++k) {
        const double angle = 2 * 3.14159265358979 * k / 180;
        drawing.lines[0].push_back(glm::dvec2(50.2, 49.7) +
                                   radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    drawing.lines[0].push_back(drawing.lines[0].front());
    return drawing;
}

constexpr double kWidths[] = {1, 1.5, 2, 3, 4, 5, 6, 7, 8};

}  // namespace

TEST_CASE("a straight line is one line with two points") {
    for (const double width : kWidths) {
        CAPTURE(width);
        const Drawing drawing{80, 80, {{{14.3, 30.1}, {64.7, 35.4}}}};
        const FractureMap map = traced(plainPng(drawing, {width}));
        REQUIRE(map.lines.size() == 1);
        CHECK(map.lines[0].points.size() == 2);
        CHECK(map.warnings.empty());
        checkSameGraph(map, drawing);
    }
}

TEST_CASE("lines that meet in one point get one node, whatever their width, number and turn") {
    for (const double width : kWidths)
        for (int arms = 3; arms <= 6; ++arms)
            for (const double turn : {0.0, 0.2, 0.785}) {
                CAPTURE(width);
                CAPTURE(arms);
                CAPTURE(turn);
                const Drawing drawing = star(arms, turn);
                checkSameGraph(traced(plainPng(drawing, {width})), drawing);
            }
}

TEST_CASE("a cross drawn eight texels wide is one node of degree 4 down to sharp angles") {
    for (const double angle : {1.57, 1.2, 0.9, 0.7}) {
        CAPTURE(angle);
        const glm::dvec2 c(80.3, 79.8);
        const glm::dvec2 d = 60.0 * glm::dvec2(std::cos(angle), std::sin(angle));
        const Drawing drawing{
            160,
            160,
            {{c, c + glm::dvec2(60, 0)}, {c, c - glm::dvec2(60, 0)}, {c, c + d}, {c, c - d}}};
        const FractureMap map = traced(plainPng(drawing, {8}));
        CHECK(map.lines.size() == 4);
        checkSameGraph(map, drawing);
    }
}

TEST_CASE("T and Y are one node of degree 3, and planarising keeps it one") {
    const glm::dvec2 c(50.4, 50.1);
    for (const double width : kWidths)
        for (const glm::dvec2 stub : {glm::dvec2(0, 33), glm::dvec2(25, 25), glm::dvec2(-30, 20)}) {
            CAPTURE(width);
            const Drawing drawing{
                100, 100, {{c, c + glm::dvec2(36, 0)}, {c, c - glm::dvec2(36, 0)}, {c, c + stub}}};
            const FractureMap map = traced(plainPng(drawing, {width}));
            checkSameGraph(map, drawing);
            const Result<PlanarMap> planar = planarise(map);
            REQUIRE(planar);
            CHECK(planar->edges.size() == planar->nodes.size() - 1);
        }
}

TEST_CASE("two junctions further apart than the lines are wide stay two") {
    for (const double width : {2.0, 4.0, 8.0}) {
        CAPTURE(width);
        const double apart = 2 * width + 8;
        const glm::dvec2 a(60 - apart / 2, 50.3);
        const glm::dvec2 b(60 + apart / 2, 50.3);
        const Drawing drawing{120,
                              100,
                              {{a, b},
                               {a, a - glm::dvec2(30, 0)},
                               {b, b + glm::dvec2(30, 0)},
                               {a, a + glm::dvec2(0, 35)},
                               {b, b - glm::dvec2(0, 35)}}};
        checkSameGraph(traced(plainPng(drawing, {width})), drawing);
    }
}

TEST_CASE("a ring without a junction is one closed line") {
    for (const double width : kWidths)
        for (const double radius : {14.0, 40.0}) {
            CAPTURE(width);
            CAPTURE(radius);
            const Drawing drawing = ring(radius);
            const FractureMap map = traced(plainPng(drawing, {width}));
            REQUIRE(map.lines.size() == 1);
            CHECK(map.lines[0].points.front() == map.lines[0].points.back());
            checkSameGraph(map, drawing);
        }
}

TEST_CASE("closed lines with corners keep them, also where they start") {
    for (const double width : {1.5, 3.0, 6.0}) {
        CAPTURE(width);
        const Polyline triangle{{50.2, 12.4}, {88.1, 80.6}, {14.7, 70.3}, {50.2, 12.4}};
        const Drawing drawing{100, 100, {triangle}};
        const FractureMap map = traced(plainPng(drawing, {width}));
        checkSameGraph(map, drawing);
        CHECK(map.lines.at(0).points.size() <= 6);
    }
}

TEST_CASE("a wave that runs into a loop is two lines and one node") {
    for (const double width : kWidths) {
        CAPTURE(width);
        Drawing drawing{180, 120, {{}, {}}};
        for (int k = 0; k <= 60; ++k)
            drawing.lines[0].push_back({80 + 1.4 * k, 68 - 8 * std::cos(k * 0.1047)});
        for (int k = 0; k <= 90; ++k) {
            const double angle = 2 * 3.14159265358979 * k / 90;
            drawing.lines[1].push_back({50 + 30 * std::cos(angle), 60 + 30 * std::sin(angle)});
        }
        drawing.lines[1].back() = drawing.lines[1].front() = drawing.lines[0].front();
        const FractureMap map = traced(plainPng(drawing, {width}));
        CHECK(map.lines.size() == 2);
        // All three lines are bent where wide ink hides their centres.
        checkSameGraph(map, drawing, std::max(1.0, width / 3));
    }
}

TEST_CASE("ends near the border go on to it, exactly") {
    for (const double width : {1.0, 3.0, 8.0}) {
        CAPTURE(width);
        const Drawing drawing{90, 70, {{{-5, 20.3}, {95, 31.2}}, {{45.2, 40}, {45.2, 69}}}};
        const FractureMap map = traced(plainPng(drawing, {width}));
        REQUIRE(map.lines.size() == 2);
        for (const FractureMap::Line& line : map.lines) {
            size_t onBorder = 0;
            for (const glm::dvec2 end : {line.points.front(), line.points.back()})
                onBorder += end.x == 0 || end.x == 1 || end.y == 0 || end.y == 1 ? 1 : 0;
            CHECK(onBorder == (&line == map.lines.data() ? 2 : 1));
        }
    }
}

TEST_CASE("square ends are as long as they were drawn, and so are round ones") {
    for (const bool square : {false, true})
        for (const double width : {1.0, 2.0, 4.0, 5.0, 6.0, 8.0}) {
            CAPTURE(square);
            CAPTURE(width);
            const Drawing drawing{100, 60, {{{20.3, 18.6}, {80.2, 41.1}}}};
            checkSameGraph(traced(plainPng(drawing, {width, true, square})), drawing);
        }
}

TEST_CASE("noise on the edges of a wide line makes no branches") {
    Random random(3);
    const Drawing drawing{200, 60, {{{20, 30}, {180, 30}}}};
    std::vector<uint8_t> grey = shades(coverage(drawing, {12}), 255, 0, 0, random);
    for (int x = 20; x < 180; x += 7) {
        grey[static_cast<size_t>(23) * 200 + x] = 0;
        grey[static_cast<size_t>(22) * 200 + x] = 0;
        grey[static_cast<size_t>(36) * 200 + x + 3] = 0;
    }
    checkSameGraph(traced(greyPng(drawing, grey)), drawing, 1.5);
}

// Of 1600 such drawings two missed by more than a texel (by up to 3.4), at junctions of sharp
// angles.
TEST_CASE("random graphs come back as they were drawn") {
    int drawings = 0;
    int astray = 0;
    for (const double width : kWidths)
        for (int seed = 0; seed < propertyCases(20); ++seed) {
            CAPTURE(width);
            CAPTURE(seed);
            Random random(static_cast<uint32_t>(seed));
            const Drawing drawing = randomDrawing(random, width);
            const FractureMap map = traced(plainPng(drawing, {width}));
            checkSameGraph(map, drawing, 4);
            ++drawings;
            if (hausdorff(inTexels(map, drawing), drawing.lines) >= 1) ++astray;
        }
    CHECK(astray * 200 <= drawings);
}

// Without grey at their edges, an end or the tip of a sharp corner is known to a few texels only.
TEST_CASE("random graphs drawn without antialiasing come back") {
    for (const double width : kWidths)
        for (int seed = 0; seed < propertyCases(20); ++seed) {
            CAPTURE(width);
            CAPTURE(seed);
            Random random(static_cast<uint32_t>(seed));
            const Drawing drawing = randomDrawing(random, width);
            checkSameGraph(traced(plainPng(drawing, {width, false})), drawing, 3.5 + width / 4);
        }
}

TEST_CASE("random graphs come back through noise and JPEG") {
    for (const double width : {2.0, 3.0, 4.0, 6.0, 8.0})
        for (int seed = 0; seed < propertyCases(10); ++seed) {
            CAPTURE(width);
            CAPTURE(seed);
            Random random(static_cast<uint32_t>(seed));
            const Drawing drawing = randomDrawing(random, width);
            std::vector<uint8_t> grey =
                shades(coverage(drawing, {width}), 230, 30, seed % 2 == 0 ? 12 : 0, random);
            if (seed % 3 == 0)  // salt and pepper
                for (size_t k = 0; k < grey.size() / 500; ++k)
                    grey[random.below(static_cast<uint32_t>(grey.size()))] =
                        random.below(2) == 0 ? 0 : 255;
            const bool jpeg = seed % 2 != 0;
            checkSameGraph(traced(jpeg ? greyJpeg(drawing, grey, 80) : greyPng(drawing, grey)),
                           drawing, 2.5);
        }
}

TEST_CASE("curves stay as near, and are smoother") {
    const Drawing drawing = ring(40);
    BitmapOptions options;
    options.curves = true;
    const FractureMap smooth = traced(plainPng(drawing, {3}), options);
    checkSameGraph(smooth, drawing);
    CHECK(smooth.lines.at(0).points.size() > traced(plainPng(drawing, {3})).lines[0].points.size());
    for (int seed = 0; seed < propertyCases(10); ++seed) {
        CAPTURE(seed);
        Random random(static_cast<uint32_t>(seed));
        const Drawing graph = randomDrawing(random, 4);
        checkSameGraph(traced(plainPng(graph, {4}), options), graph);
    }
}

TEST_CASE("the tolerance bounds what simplifying takes away") {
    const Drawing drawing = ring(40);
    BitmapOptions fine;
    fine.tolerance = 0.1;
    BitmapOptions coarse;
    coarse.tolerance = 3;
    const auto bytes = plainPng(drawing, {3});
    const FractureMap many = traced(bytes, fine);
    const FractureMap few = traced(bytes, coarse);
    CHECK(few.lines[0].points.size() < many.lines[0].points.size() / 2);
    CHECK(few.lines[0].points.size() >= 4);
    CHECK(hausdorff(inTexels(few, drawing), inTexels(many, drawing)) <= 3.2);
}
