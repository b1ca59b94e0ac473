// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>

#include "map/planar_map.h"
#include "sherd/baker/fracture_map.h"
#include "support/models.h"
#include "svg_drawing.h"

using namespace sherd;
using sherd::test::drawing;

namespace {

FractureMap readBody(const std::string& body, const MapReadOptions& options = {}) {
    const Result<FractureMap> map = readSvgMap(drawing(body), "t.svg", options);
    INFO(body);
    if (!map) FAIL(map.error().message << " " << map.error().where);
    return *map;
}

ErrorCode codeOf(const std::string& text) {
    const Result<FractureMap> map = readSvgMap(text, "t.svg", {});
    REQUIRE_FALSE(map);
    CHECK_FALSE(map.error().message.empty());
    return map.error().code;
}

/// The points in drawing units, rounded, "0,0 10,20".
std::string pointsOf(const FractureMap::Line& line) {
    std::ostringstream out;
    for (const glm::dvec2 p : line.points)
        out << (out.tellp() > 0 ? " " : "") << std::round(p.x * 1e4) / 100 << ","
            << std::round(p.y * 1e4) / 100;
    return out.str();
}

std::string pathPoints(const std::string& d) {
    const FractureMap map = readBody("<path d='" + d + "'/>");
    std::string all;
    for (const FractureMap::Line& line : map.lines)
        all += (all.empty() ? "" : " | ") + pointsOf(line);
    return all;
}

size_t linesIn(const std::string& body) {
    const Result<FractureMap> map = readSvgMap(drawing(body), "t.svg", {});
    return map ? map->lines.size() : 0;
}

}  // namespace

TEST_CASE("an empty file, no XML and another XML are malformed") {
    CHECK(codeOf("") == ErrorCode::malformed);
    CHECK(codeOf("   \n") == ErrorCode::malformed);
    CHECK(codeOf("PNG\x01\x02") == ErrorCode::malformed);
    CHECK(codeOf("<svg viewBox='0 0 1 1'><path d='M0 0") == ErrorCode::malformed);
    CHECK(codeOf("<html><body/></html>") == ErrorCode::malformed);
}

TEST_CASE("a drawing without lines is an empty map and says what was passed over") {
    CHECK(codeOf(drawing("")) == ErrorCode::emptyMap);
    CHECK(codeOf(drawing("<path d='M 5 5'/><path d='M 5 5 z'/><line x1='1' x2='1'/>")) ==
          ErrorCode::emptyMap);
    const Result<FractureMap> map = readSvgMap(
        drawing("<text>crack</text><g style='display:none'><path d='M0 0L1 1'/></g>"), "a.svg", {});
    REQUIRE_FALSE(map);
    CHECK(map.error().code == ErrorCode::emptyMap);
    CHECK(map.error().message.find("1 hidden element(s), 1 text") != std::string::npos);
}

TEST_CASE("a drawing without a size is refused with advice") {
    const Result<FractureMap> map = readSvgMap("<svg><path d='M0 0L1 1'/></svg>", "a.svg", {});
    REQUIRE_FALSE(map);
    CHECK(map.error().code == ErrorCode::invalidData);
    CHECK(map.error().message.find("viewBox=") != std::string::npos);
    CHECK(codeOf("<svg viewBox='0 0 0 5'><path d='M0 0L1 1'/></svg>") == ErrorCode::invalidData);
    CHECK(codeOf("<svg width='100%' height='100%'><path d='M0 0L1 1'/></svg>") ==
          ErrorCode::invalidData);
}

TEST_CASE("width and height stand in for a missing viewBox") {
    const auto map =
        readSvgMap("<svg width='2in' height='96px'><path d='M0 0L96 96'/></svg>", "a.svg", {});
    REQUIRE(map);
    CHECK(map->lines[0].points[1].x == doctest::Approx(0.5));
    CHECK(map->lines[0].points[1].y == doctest::Approx(1));
}

TEST_CASE("the viewBox spans the unit square whatever its aspect and origin") {
    const auto map = readSvgMap("<svg viewBox='-10 20 40 10'><path d='M-10 20L30 30L40 20'/></svg>",
                                "a.svg", {});
    REQUIRE(map);
    CHECK(map->lines[0].points[0] == glm::dvec2(0, 0));
    CHECK(map->lines[0].points[1] == glm::dvec2(1, 1));
    CHECK(map->lines[0].points[2].x == doctest::Approx(1.25));
}

TEST_CASE("straight path commands are read absolute and relative") {
    CHECK(pathPoints("M1 2 L3 4 H10 V20 Z") == "1,2 3,4 10,4 10,20 1,2");
    CHECK(pathPoints("m1 2 l3 4 h10 v20 z") == "1,2 4,6 14,6 14,26 1,2");
    CHECK(pathPoints("M1,2 3,4 5,6") == "1,2 3,4 5,6");
    CHECK(pathPoints("m1,2 3,4 5,6") == "1,2 4,6 9,12");
    CHECK(pathPoints("M0 0h1 2 3v1 2") == "0,0 1,0 3,0 6,0 6,1 6,3");
    CHECK(pathPoints("M1 1L2 2M5 5L6 6") == "1,1 2,2 | 5,5 6,6");
    CHECK(pathPoints("m1 1l2 2m5 5l6 6") == "1,1 3,3 | 8,8 14,14");
}

TEST_CASE("drawing goes on from the start after a closed subpath") {
    CHECK(pathPoints("M1 1h2v2zl9 0") == "1,1 3,1 3,3 1,1 | 1,1 10,1");
    CHECK(pathPoints("M1 1h2v2zm1 1h2") == "1,1 3,1 3,3 1,1 | 2,2 4,2");
}

TEST_CASE("numbers need no separators where the grammar is clear") {
    CHECK(pathPoints("M1.5.5L-1-2") == "1.5,0.5 -1,-2");
    CHECK(pathPoints("M+1e1,1E+1L2e-1.5") == "10,10 0.2,0.5");
    CHECK(pathPoints("M0,0,5,5") == "0,0 5,5");
    CHECK(pathPoints(" \t\nM\n1\r\n,\t2L3.,4") == "1,2 3,4");
    CHECK(pathPoints("M1e-999 0L5 5") == "0,0 5,5");
}

TEST_CASE("a mistake in path data keeps what came before and is reported with its place") {
    for (const char* d :
         {"M0 0L10 10L5", "M0 0L10 10L5 x", "M0 0 10 10 ! L 3 3", "M0 0L10 10C1 2 3",
          "M0 0L10 10L1e999 0", "M0 0L10 10LNaN 0", "M0 0L10 10A1 1 0 2 0 5 5"}) {
        CAPTURE(d);
        const FractureMap map = readBody(std::string("<path id='p' d='") + d + "'/>");
        REQUIRE(map.lines.size() == 1);
        CHECK(pointsOf(map.lines[0]) == "0,0 10,10");
        REQUIRE(map.warnings.size() == 1);
        CHECK(map.warnings[0].find("t.svg: path #p") != std::string::npos);
        CHECK(map.warnings[0].find("at character ") != std::string::npos);
    }
    CHECK(codeOf(drawing("<path d='L5 5'/>")) == ErrorCode::emptyMap);
    CHECK(codeOf(drawing("<polyline points='NaN,0 inf,3'/>")) == ErrorCode::emptyMap);
}

TEST_CASE("curves reach their ends and stay within the tolerance") {
    MapReadOptions options;
    options.tolerance = 1e-3;
    const FractureMap map = readBody("<path d='M0 0C0 100 100 100 100 0'/>", options);
    const auto& points = map.lines[0].points;
    CHECK(points.front() == glm::dvec2(0, 0));
    CHECK(points.back() == glm::dvec2(1, 0));
    CHECK(points.size() > 5);
    CHECK(points.size() < 60);
    for (int i = 0; i <= 1000; ++i) {
        const double t = i / 1000.0;
        const glm::dvec2 on = 3 * t * t * (1 - t) * glm::dvec2(1, 1) +
                              3 * t * (1 - t) * (1 - t) * glm::dvec2(0, 1) +
                              t * t * t * glm::dvec2(1, 0);
        double nearest = 1;
        for (size_t k = 1; k < points.size(); ++k) {
            const glm::dvec2 d = points[k] - points[k - 1];
            const double s = glm::clamp(glm::dot(on - points[k - 1], d) / glm::dot(d, d), 0.0, 1.0);
            nearest = std::min(nearest, glm::length(points[k - 1] + s * d - on));
        }
        CHECK(nearest <= options.tolerance);
    }
}

TEST_CASE("smooth and quadratic commands equal the full cubics they abbreviate") {
    CHECK(pathPoints("M0 0C0 10 10 10 10 0S20 -10 20 0") ==
          pathPoints("M0 0C0 10 10 10 10 0C10 -10 20 -10 20 0"));
    CHECK(pathPoints("m5 5c0 10 10 10 10 0s10 -10 10 0") ==
          pathPoints("M5 5C5 15 15 15 15 5C15 -5 25 -5 25 5"));
    CHECK(pathPoints("M0 0S10 10 20 0") == pathPoints("M0 0C0 0 10 10 20 0"));
    CHECK(pathPoints("M0 0Q15 15 30 0") == pathPoints("M0 0C10 10 20 10 30 0"));
    CHECK(pathPoints("M0 0Q15 15 30 0T60 0") == pathPoints("M0 0Q15 15 30 0Q45 -15 60 0"));
    CHECK(pathPoints("m3 0q15 15 30 0t30 0") == pathPoints("M3 0Q18 15 33 0Q48 -15 63 0"));
    CHECK(pathPoints("M0 0T10 10") == pathPoints("M0 0Q0 0 10 10"));
}

TEST_CASE("arcs take every combination of flags, packed or not") {
    const auto middle = [](const std::string& flags) {
        const FractureMap map = readBody("<path d='M50 40A10 10 0 " + flags + "60 50'/>");
        return map.lines[0].points[map.lines[0].points.size() / 2];
    };
    // Quarter and three-quarter circles about (50, 50) and (60, 40).
    CHECK(glm::length(middle("0 1 ") - glm::dvec2(0.5707, 0.4293)) < 0.02);
    CHECK(glm::length(middle("00") - glm::dvec2(0.5293, 0.4707)) < 0.02);
    CHECK(glm::length(middle("1,1,") - glm::dvec2(0.6707, 0.3293)) < 0.02);
    CHECK(glm::length(middle("10") - glm::dvec2(0.4293, 0.5707)) < 0.02);
    CHECK(pathPoints("M0 0a5 5 0 0110 0") == pathPoints("M0 0A5 5 0 0 1 10 0"));
}

TEST_CASE("degenerate arcs are lines, and too small radii grow") {
    CHECK(pathPoints("M0 0A0 5 0 0 0 10 0") == "0,0 10,0");
    CHECK(pathPoints("M0 0A5 5 0 0 0 0 0L3 3") == "0,0 0,0 3,3");
    CHECK(pathPoints("M0 0A1 1 0 0 1 10 0") == pathPoints("M0 0A5 5 0 0 1 10 0"));
    CHECK(pathPoints("M0 0A-5 5 0 0 1 10 0") == pathPoints("M0 0A5 5 0 0 1 10 0"));
}

TEST_CASE("an arc of a turned ellipse stays on it") {
    const FractureMap map = readBody("<path d='M20 50A30 10 30 1 1 40 60'/>");
    // Fit: |R(-30 deg)(p - c) / (rx, ry)| = 1 has the same centre for all points; check by
    // midpoints of opposite tangents instead: every point is within the ellipse's reach of the
    // start.
    for (const glm::dvec2 p : map.lines[0].points)
        CHECK(glm::length(p - glm::dvec2(0.2, 0.5)) < 0.61);
    CHECK(map.lines[0].points.back() == glm::dvec2(0.4, 0.6));
}

TEST_CASE("basic shapes become closed or open lines") {
    CHECK(pointsOf(readBody("<line x1='1' y1='2' x2='3' y2='4'/>").lines[0]) == "1,2 3,4");
    CHECK(pointsOf(readBody("<polyline points='1,2 3,4 5-6'/>").lines[0]) == "1,2 3,4 5,-6");
    CHECK(pointsOf(readBody("<polygon points='1 2 3 4 5 6'/>").lines[0]) == "1,2 3,4 5,6 1,2");
    CHECK(pointsOf(readBody("<rect x='1' y='2' width='10' height='20'/>").lines[0]) ==
          "1,2 11,2 11,22 1,22 1,2");
    CHECK(linesIn("<rect width='0' height='5'/><circle r='0'/><ellipse rx='-1' ry='5'/>") == 0);
}

TEST_CASE("circles and ellipses are closed and on their curve") {
    const FractureMap map =
        readBody("<circle cx='50' cy='40' r='20'/><ellipse cx='50%' cy='50' rx='30' ry='10'/>");
    REQUIRE(map.lines.size() == 2);
    CHECK(map.lines[0].points.front() == map.lines[0].points.back());
    for (const glm::dvec2 p : map.lines[0].points)
        CHECK(glm::length(p - glm::dvec2(0.5, 0.4)) == doctest::Approx(0.2));
    for (const glm::dvec2 p : map.lines[1].points)
        CHECK(glm::length((p - glm::dvec2(0.5, 0.5)) / glm::dvec2(0.3, 0.1)) == doctest::Approx(1));
}

TEST_CASE("rounded rectangles clamp their radii and close") {
    const FractureMap map = readBody("<rect x='10' y='10' width='20' height='10' rx='99' ry='3'/>");
    const auto& points = map.lines[0].points;
    CHECK(points.front() == points.back());
    for (const glm::dvec2 p : points) {
        CHECK(p.x >= 0.1 - 1e-12);
        CHECK(p.x <= 0.3 + 1e-12);
        CHECK(p.y >= 0.1 - 1e-12);
        CHECK(p.y <= 0.2 + 1e-12);
    }
    CHECK(points.front().x == doctest::Approx(0.2));
}

TEST_CASE("transforms nest, in the order they are written") {
    const auto moved = [](const std::string& transform) {
        return pointsOf(readBody("<path d='M1 0L3 4' transform='" + transform + "'/>").lines[0]);
    };
    CHECK(moved("translate(10)") == "11,0 13,4");
    CHECK(moved("translate(10 , 20)") == "11,20 13,24");
    CHECK(moved("scale(2)") == "2,0 6,8");
    CHECK(moved("scale(2,3)") == "2,0 6,12");
    CHECK(moved("rotate(90)") == "0,1 -4,3");
    CHECK(moved("rotate(90,1,0)") == "1,0 -3,2");
    CHECK(moved("skewX(45)") == "1,0 7,4");
    CHECK(moved("skewY(45)") == "1,1 3,7");
    CHECK(moved("matrix(1 2 3 4 5 6)") == "6,8 20,28");
    CHECK(moved("translate(10,0),scale(2)") == "12,0 16,8");
    CHECK(moved("scale(2) translate(10,0)") == "22,0 26,8");
    CHECK(pointsOf(readBody("<g transform='translate(5 5)'><g transform='scale(2)'>"
                            "<path d='M1 0L3 4' transform='translate(1)'/></g></g>")
                       .lines[0]) == "9,5 13,13");
}

TEST_CASE("an unreadable transform leaves the element out and says so") {
    for (const char* transform :
         {"rotate()", "matrix(1 2 3)", "spin(3)", "scale(2", "translate(1e999)"}) {
        CAPTURE(transform);
        const FractureMap map =
            readBody("<path d='M0 0L1 1'/><path id='bad' d='M0 0L2 2' transform='" +
                     std::string(transform) + "'/>");
        CHECK(map.lines.size() == 1);
        REQUIRE(map.warnings.size() == 1);
        CHECK(map.warnings[0].find("path #bad") != std::string::npos);
    }
}

TEST_CASE("nested drawings place their own viewBox") {
    CHECK(pointsOf(readBody("<svg x='10' y='20' width='20' height='20' viewBox='0 0 2 2'>"
                            "<path d='M0 0L1 1'/></svg>")
                       .lines[0]) == "10,20 20,30");
    // A taller viewport than the box: centred.
    CHECK(pointsOf(
              readBody("<svg width='20' height='40' viewBox='0 0 2 2'><path d='M0 0L1 1'/></svg>")
                  .lines[0]) == "0,10 10,20");
    CHECK(pointsOf(
              readBody("<svg width='20' height='40' viewBox='0 0 2 2' preserveAspectRatio='none'>"
                       "<path d='M0 0L1 1'/></svg>")
                  .lines[0]) == "0,0 10,20");
}

TEST_CASE("hidden things are not drawn, however they are hidden") {
    const std::string path = "d='M0 0L1 1'/>";
    CHECK(linesIn("<path display='none' " + path) == 0);
    CHECK(linesIn("<path style='stroke:red; display : none !important' " + path) == 0);
    CHECK(linesIn("<path visibility='hidden' " + path) == 0);
    CHECK(linesIn("<path opacity='0' " + path) == 0);
    CHECK(linesIn("<path opacity='0.5' " + path) == 1);
    CHECK(linesIn("<g style='display:none'><path style='display:inline' " + path + "</g>") == 0);
    CHECK(linesIn("<g visibility='hidden'><path visibility='visible' " + path + "<path " + path +
                  "</g>") == 1);
    CHECK(linesIn("<path display='none' style='display:inline' " + path) == 1);
}

TEST_CASE("style rules hide by type, class and id, the stronger one winning") {
    const std::string path = "<path id='p' class='a  b' d='M0 0L1 1'/>";
    const auto with = [&](const std::string& css) {
        return linesIn("<style>" + css + "</style>" + path);
    };
    CHECK(with("") == 1);
    CHECK(with("path{display:none}") == 0);
    CHECK(with(".b { display : none }") == 0);
    CHECK(with("#p{fill:none;display:none}") == 0);
    CHECK(with("*{visibility:hidden}") == 0);
    CHECK(with("path.a.b{display:none}") == 0);
    CHECK(with("rect, .c, .a {display:none}") == 0);
    CHECK(with(".a{display:none} path{display:inline}") == 0);
    CHECK(with(".a{display:none} .b{display:inline}") == 1);
    CHECK(with(".a{display:none} #p{display:inline}") == 1);
    CHECK(with("g .a{display:none} .a:hover{display:none}") == 1);
    CHECK(with("/* path{display:none} */ @import 'x'; @media print {path{display:none}} .c{}") ==
          1);
    CHECK(with("path{display:none") == 0);
    CHECK(linesIn("<style><![CDATA[ path{display:none} ]]></style>" + path) == 0);
}

TEST_CASE("what is no line is passed over and counted") {
    const FractureMap map = readBody(
        "<defs><path d='M0 0L9 9'/></defs><defs/><text>a</text><text>b</text><image href='x.png'/>"
        "<clipPath><path d='M0 0L9 9'/></clipPath><symbol><path d='M0 0L9 9'/></symbol>"
        "<marker><path d='M0 0L9 9'/></marker><pattern><path d='M0 0L9 9'/></pattern>"
        "<title>t</title><metadata/><path d='M0 0L1 1'/>");
    CHECK(map.lines.size() == 1);
    REQUIRE(map.warnings.size() == 1);
    CHECK(map.warnings[0] ==
          "t.svg: passed over 1 clipPath, 1 defs, 1 image, 1 marker, 1 pattern, 1 symbol, 2 text");
}

TEST_CASE("use draws its target, moved, also from defs and symbols") {
    CHECK(pointsOf(readBody("<defs><path id='p' d='M0 0L1 1'/></defs><use href='#p' x='5' y='6'/>")
                       .lines[0]) == "5,6 6,7");
    CHECK(pointsOf(readBody("<defs><g id='p'><path d='M0 0L1 1'/></g></defs>"
                            "<use xlink:href='#p' transform='scale(3)' x='1'/>")
                       .lines[0]) == "3,0 6,3");
    CHECK(pointsOf(readBody("<symbol id='s' viewBox='0 0 1 1'><path d='M0 0L1 1'/></symbol>"
                            "<use href='#s' x='10' y='10' width='20' height='20'/>")
                       .lines[0]) == "10,10 30,30");
}

TEST_CASE("uses of nothing, of other files and of themselves are left out") {
    const FractureMap map = readBody(
        "<path d='M0 0L1 1'/><use href='#no'/><use/><use href='b.svg#p'/>"
        "<g id='g'><use href='#g'/></g>");
    CHECK(map.lines.size() == 1);
    CHECK(map.warnings.size() == 4);
}

TEST_CASE("uses that double and double again end at the limit") {
    std::string body = "<defs><path id='u0' d='M0 0L1 1'/>";
    for (int i = 1; i < 40; ++i) {
        const std::string use = "<use href='#u" + std::to_string(i - 1) + "'/>";
        body.append("<g id='u").append(std::to_string(i)).append("'>");
        body.append(use).append(use).append("</g>");
    }
    CHECK(codeOf(drawing(body + "</defs><use href='#u39'/>")) == ErrorCode::limitExceeded);
}

TEST_CASE("groups nested without end are refused, not followed") {
    std::string open;
    std::string close;
    for (int i = 0; i < 100000; ++i) {
        open += "<g>";
        close += "</g>";
    }
    CHECK(codeOf(drawing(open + "<path d='M0 0L1 1'/>" + close)) == ErrorCode::limitExceeded);
}

TEST_CASE("hostile sizes give errors, not memory") {
    CHECK(codeOf(drawing("<circle r='1e300'/>")) == ErrorCode::limitExceeded);
    CHECK(codeOf(drawing("<path d='M0 0C1e200 0 0 1e200 5 5'/>")) == ErrorCode::limitExceeded);
    CHECK(codeOf(drawing("<g transform='scale(1e300)'><path d='M0 0L1e300 1'/></g>")) ==
          ErrorCode::invalidData);
    CHECK(codeOf("<!DOCTYPE svg [<!ENTITY a 'aaaaaaaa'><!ENTITY b '&a;&a;'>]>" +
                 drawing("<text>&b;</text>")) == ErrorCode::emptyMap);
    const Result<FractureMap> huge = readSvgMap(std::string((64U << 20U) + 1, ' '), "h.svg", {});
    REQUIRE_FALSE(huge);
    CHECK(huge.error().code == ErrorCode::limitExceeded);
}

TEST_CASE("options out of range are refused") {
    for (const MapReadOptions& options :
         {MapReadOptions{0, 1e-4}, MapReadOptions{65, 1e-4}, MapReadOptions{1, 0},
          MapReadOptions{1, -1}, MapReadOptions{1, std::nan("")}}) {
        const auto map = readSvgMap(drawing("<path d='M0 0L1 1'/>"), "t.svg", options);
        REQUIRE_FALSE(map);
        CHECK(map.error().code == ErrorCode::badArgument);
    }
}

TEST_CASE("layers named after levels give their lines that level") {
    MapReadOptions options;
    options.level = 3;
    const FractureMap map = readBody(
        "<path d='M0 0L1 1'/>"
        "<g inkscape:label='level 2'><path d='M0 0L2 2'/><g><path d='M0 0L3 3'/></g></g>"
        "<g id='level_1'><path d='M0 0L4 4'/><g id='Level-4'><path d='M0 0L5 5'/></g></g>"
        "<g id='level5' inkscape:label='cracks'><path d='M0 0L6 6'/></g>"
        "<g id='level0'><path d='M0 0L7 7'/></g><g id='levels'><path d='M0 0L8 8'/></g>",
        options);
    std::vector<uint32_t> levels;
    for (const FractureMap::Line& line : map.lines) levels.push_back(line.level);
    CHECK(levels == std::vector<uint32_t>{3, 2, 2, 1, 4, 5, 3, 3});
}

TEST_CASE("the guide layer never draws") {
    CHECK(linesIn("<g data-sherd-guide='true'><path d='M0 0L1 1'/></g>") == 0);
    CHECK(linesIn("<g id='sherd-guide-2'><path d='M0 0L1 1'/></g>") == 0);
    CHECK(linesIn("<g inkscape:label='sherd guide'><path d='M0 0L1 1'/></g>") == 0);
    CHECK(linesIn("<sherd:guide><path d='M0 0L1 1'/></sherd:guide>") == 0);
    CHECK(linesIn("<path data-sherd-guide='' id='p' d='M0 0L1 1'/><use href='#p'/>") == 0);
}

TEST_CASE("a line knows the element it comes from") {
    CHECK(readBody("<path id='crack3' d='M0 0L1 1'/>").lines[0].source == "t.svg: path #crack3");
    CHECK(readBody("<rect width='3' height='3'/>").lines[0].source.find("t.svg: rect at byte ") ==
          0);
}

TEST_CASE("lines beyond the unit square are kept") {
    CHECK(pathPoints("M-10 50L110 50") == "-10,50 110,50");
}

TEST_CASE("prefixed SVG elements are read, an editor's own are not") {
    const auto map = readSvgMap(
        "<svg:svg xmlns:svg='http://www.w3.org/2000/svg' viewBox='0 0 1 1'>"
        "<sodipodi:namedview><inkscape:path d='M0 0L1 1'/></sodipodi:namedview>"
        "<svg:g><svg:path d='M0 0L1 1'/></svg:g></svg:svg>",
        "a.svg", {});
    REQUIRE(map);
    CHECK(map->lines.size() == 1);
    CHECK(map->warnings.empty());
}

TEST_CASE("files are found, refused and named") {
    const auto missing = readFractureMap("/nonexistent/a.svg", {});
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == ErrorCode::fileNotFound);
    const auto kind = readFractureMap("/nonexistent/a.gif", {});
    REQUIRE_FALSE(kind);
    CHECK(kind.error().code == ErrorCode::unsupported);
}

TEST_CASE("every real map is read and planarised, with no fewer edges than segments") {
    if (!std::filesystem::exists(test::sharedDir() / "maps" / "COUNTS.md")) return;
    std::ifstream counts(test::sharedDir() / "maps" / "COUNTS.md");
    size_t maps = 0;
    for (std::string row; std::getline(counts, row);) {
        std::vector<std::string> cells;
        std::istringstream stream(row);
        for (std::string cell; std::getline(stream, cell, '|');) {
            std::string plain;
            for (const char c : cell)
                if (c != ' ') plain += c;
            cells.push_back(plain);
        }
        if (cells.size() < 7 || cells[2].find(".svg") == std::string::npos) continue;
        CAPTURE(cells[2]);
        const auto map = readFractureMap(test::sharedDir() / "maps" / cells[2], {});
        REQUIRE(map);
        CHECK(map->lines.size() == std::stoul(cells[5]));
        CHECK(map->warnings.empty());
        size_t segments = 0;
        for (const FractureMap::Line& line : map->lines) segments += line.points.size() - 1;
        CHECK(segments == std::stoul(cells[6]));
        const auto planar = planarise(*map);
        REQUIRE(planar);
        CHECK(planar->edges.size() >= segments);
        ++maps;
    }
    CHECK(maps == 33);
}
