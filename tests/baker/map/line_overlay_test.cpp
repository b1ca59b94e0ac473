// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sherd/baker/fracture_map.h"
#include "sherd/baker/layout.h"
#include "support/plans.h"
#include "support/property.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Points = std::vector<glm::dvec2>;

FracturePlan planOf(const std::vector<Points>& lines, uint32_t level = 1) {
    FractureMap map;
    for (const Points& points : lines) map.lines.push_back({points, level, "drawn"});
    return test::planOf(std::move(map));
}

LayoutOverlay inspected(const SurfaceMesh& mesh, const FracturePlan& plan,
                        const Recipe& recipe = {}) {
    Result<LayoutOverlay> overlay = inspectLines(mesh, plan, recipe);
    REQUIRE(overlay);
    return *overlay;
}

double lengthOf(const OverlayLine::Chains& chains) {
    double length = 0;
    for (const Points& chain : chains)
        for (size_t i = 1; i < chain.size(); ++i) length += glm::distance(chain[i - 1], chain[i]);
    return length;
}

double distanceToLine(const Points& line, const glm::dvec2& p) {
    double least = 1e300;
    for (size_t i = 1; i < line.size(); ++i) {
        const glm::dvec2 d = line[i] - line[i - 1];
        const double t = std::clamp(glm::dot(p - line[i - 1], d) / glm::dot(d, d), 0.0, 1.0);
        least = std::min(least, glm::distance(p, line[i - 1] + d * t));
    }
    return least;
}

const BakeFinding* finding(const LayoutOverlay& overlay, const std::string& code) {
    for (const BakeFinding& f : overlay.findings)
        if (f.code == code) return &f;
    return nullptr;
}

/// A closed line on face f of `chartedCube`.
Points ringOn(int f, double from = 0.25, double to = 0.75) {
    return {cubeUv(f, from, from), cubeUv(f, to, from), cubeUv(f, to, to), cubeUv(f, from, to),
            cubeUv(f, from, from)};
}

SurfaceMesh movedUv(SurfaceMesh mesh, glm::vec2 by) {
    for (Attribute& attribute : mesh.attributes) {
        if (attribute.semantic != mesh.uvSemantic) continue;
        for (size_t i = 0; i < attribute.values.size(); ++i)
            attribute.values[i] += by[static_cast<int>(i % 2)];
    }
    return mesh;
}

Layout layoutOf(const SurfaceMesh& mesh, std::vector<LayoutOverlay> overlays) {
    LayoutOptions options;
    options.overlays = std::move(overlays);
    Result<Layout> layout = makeLayoutSvg({&mesh, 1}, options);
    REQUIRE(layout);
    return *layout;
}

size_t countOf(const std::string& text, const std::string& what) {
    size_t count = 0;
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++count;
    return count;
}

std::string without(std::string text, const std::string& what) {
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what))
        text.erase(at, what.size());
    return text;
}

}  // namespace

TEST_CASE("there is nothing to show without lines, texture coordinates or triangles") {
    const FracturePlan ring = planOf({ringOn(0)});
    const auto isNothing = [](const LayoutOverlay& overlay) {
        return overlay.lines.empty() && overlay.findings.empty();
    };
    CHECK(isNothing(inspected(chartedCube(), {})));
    SurfaceMesh bare = chartedCube();
    bare.uvSemantic.clear();
    CHECK(isNothing(inspected(bare, ring)));
    SurfaceMesh flat = chartedCube();
    for (auto& t : flat.triangles) t = {0, 0, 1};
    CHECK(inspected(flat, ring).lines.empty());
    SurfaceMesh none = chartedCube();
    none.triangles.clear();
    none.corners.clear();
    none.triangleMaterials.clear();
    CHECK(inspected(none, ring).lines.empty());
}

TEST_CASE("texture coordinates beyond the grid are an error, as when baking") {
    const auto overlay = inspectLines(movedUv(chartedCube(), {20, 0}), planOf({ringOn(0)}), {});
    REQUIRE_FALSE(overlay);
    CHECK(overlay.error().code == ErrorCode::limitExceeded);
}

TEST_CASE("a line is shown once, where it was drawn and as long") {
    for (const int cells : {1, 7}) {
        const LayoutOverlay overlay =
            inspected(chartedCube(1, cells), planOf({ringOn(0), ringOn(4)}, 1));
        REQUIRE(overlay.lines.size() == 2);
        for (size_t i = 0; i < 2; ++i) {
            const OverlayLine& line = overlay.lines[i];
            CHECK(line.level == 1);
            CHECK(line.source == "drawn");
            CHECK(line.idle.empty());
            REQUIRE(line.parting.size() == 1);
            CHECK(line.parting[0].front() == line.parting[0].back());
            CHECK(lengthOf(line.parting) == doctest::Approx(4 * 0.5 * 0.2));
            for (const glm::dvec2& p : line.parting[0])
                CHECK(distanceToLine(ringOn(i == 0 ? 0 : 4), p) < 1e-6);
        }
        CHECK(overlay.findings.empty());
    }
}

TEST_CASE("a line along a seam is shown on both charts") {
    // Where s = 1 on +x lies t = 1 on +z; a ring that begins there has two of its sides there.
    const Points ring = {cubeUv(0, 1, 0.25), cubeUv(0, 1, 0.75), cubeUv(0, 0.5, 0.75),
                         cubeUv(0, 0.5, 0.25), cubeUv(0, 1, 0.25)};
    const LayoutOverlay overlay = inspected(chartedCube(1, 4), planOf({ring}));
    REQUIRE(overlay.lines.size() == 1);
    CHECK(overlay.lines[0].parting.size() == 2);
    CHECK(lengthOf(overlay.lines[0].parting) == doctest::Approx((4 + 1) * 0.5 * 0.2));
}

TEST_CASE("a dead end has its place where it was drawn, and its line is dashed") {
    const Points stub = {cubeUv(2, 0.3, 0.25), cubeUv(2, 0.6, 0.4)};
    const LayoutOverlay overlay = inspected(chartedCube(1, 3), planOf({ringOn(0), stub}));
    const BakeFinding* ends = finding(overlay, "dead-ends");
    REQUIRE(ends != nullptr);
    REQUIRE(ends->places.size() == 2);
    for (const glm::dvec2& end : stub) {
        CHECK(std::any_of(ends->places.begin(), ends->places.end(), [&](const BakePlace& place) {
            return place.uv && glm::distance(*place.uv, end) < 1e-6;
        }));
    }
    REQUIRE(finding(overlay, "idle-lines") != nullptr);
    REQUIRE(overlay.lines.size() == 2);
    CHECK(overlay.lines[1].parting.empty());
    CHECK(lengthOf(overlay.lines[1].idle) == doctest::Approx(glm::distance(stub[0], stub[1])));

    const std::string svg = layoutOf(chartedCube(1, 3), {overlay}).svg;
    const auto number = [](double value) {
        char text[32];
        std::snprintf(text, sizeof text, "%.2f", value * 1024);
        return std::string(text);
    };
    for (const glm::dvec2& end : stub)
        CHECK(svg.find("cx=\"" + number(end.x) + "\" cy=\"" + number(end.y) + "\"") !=
              std::string::npos);
    CHECK(countOf(svg, "<title>dead-ends: lines end in the surface [drawn") == 2);
    CHECK(countOf(svg, "stroke-dasharray") >= 1);
}

TEST_CASE("lines that separate nothing at all are a finding, no refusal") {
    const LayoutOverlay overlay = inspected(flatSquare(3), planOf({{{0.2, 0.2}, {0.6, 0.3}}}));
    CHECK(finding(overlay, "separates-nothing") != nullptr);
    CHECK(overlay.lines.size() == 1);
}

TEST_CASE("a component too small for a piece has a place inside of it, and its line is dashed") {
    Recipe recipe;
    recipe.minimumComponentShare = 0.001;
    const LayoutOverlay overlay =
        inspected(chartedCube(), planOf({ringOn(0), ringOn(3, 0.45, 0.5)}), recipe);
    const BakeFinding* small = finding(overlay, "merged-small");
    REQUIRE(small != nullptr);
    REQUIRE(small->places.size() == 1);
    REQUIRE(small->places[0].uv);
    const glm::dvec2 inside = *small->places[0].uv - cubeUv(3, 0.475, 0.475);
    CHECK(std::max(std::abs(inside.x), std::abs(inside.y)) < 0.025 * 0.2);
    CHECK(overlay.lines[1].parting.empty());
}

TEST_CASE("lines and places of other tiles are shown on the page") {
    const SurfaceMesh mesh = movedUv(chartedCube(1, 3), {2, -1});
    const Points stub = {cubeUv(2, 0.3, 0.25), cubeUv(2, 0.6, 0.4)};
    const LayoutOverlay overlay = inspected(mesh, planOf({ringOn(0), stub}));
    REQUIRE(overlay.lines.size() == 2);
    for (const glm::dvec2& p : overlay.lines[0].parting.at(0))
        CHECK(distanceToLine(ringOn(0), p) < 1e-5);
    const BakeFinding* ends = finding(overlay, "dead-ends");
    REQUIRE(ends != nullptr);
    for (const BakePlace& place : ends->places) CHECK(distanceToLine(stub, *place.uv) < 1e-5);
}

TEST_CASE("lines of a projection are shown on the charts they fall on") {
    FracturePlan plan = planOf({{{0.5, -0.1}, {0.5, 1.1}}, {{2, 2}, {3, 3}}});
    plan.drawings[0].projection = *parseProjection("planar:z");
    const LayoutOverlay overlay = inspected(chartedCube(), plan);
    // Around the cube over +z, -z, +y and -y; off the page there is no place in UV.
    REQUIRE(overlay.lines.size() == 1);
    CHECK(overlay.lines[0].parting.size() == 4);
    CHECK(lengthOf(overlay.lines[0].parting) == doctest::Approx(4 * 0.2));
    const BakeFinding* off = finding(overlay, "off-charts");
    REQUIRE(off != nullptr);
    CHECK_FALSE(off->places.at(0).uv);
}

TEST_CASE("lines modelled on the object are shown") {
    SurfaceMesh mesh = chartedCube();
    FractureMap::SurfaceLine line;
    line.source = "modelled";
    for (const glm::dvec2 p : {glm::dvec2(0.2, 0.2), {0.8, 0.2}, {0.8, 0.8}, {0.2, 0.2}})
        line.places.push_back({true, {1, p.x, p.y}});
    mesh.lines.push_back(line);
    const LayoutOverlay overlay = inspected(mesh, {});
    REQUIRE(overlay.lines.size() == 1);
    CHECK(overlay.lines[0].source == "modelled");
    CHECK(lengthOf(overlay.lines[0].parting) ==
          doctest::Approx((0.6 + 0.6 + 0.6 * std::sqrt(2)) * 0.2).epsilon(1e-4));
}

TEST_CASE("drawings are shown where they are drawn, whatever they are") {
    for (uint32_t seed = 1; seed <= static_cast<uint32_t>(propertyCases(40)); ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const int cells = static_cast<int>(1 + random.below(5));
        std::vector<Points> lines;
        lines.reserve(4);
        for (int i = 0; i < 4; ++i)
            lines.push_back({{random.in(0, 0.75), random.in(0, 0.75)},
                             {random.in(0, 0.75), random.in(0, 0.75)},
                             {random.in(0, 0.75), random.in(0, 0.75)}});
        Recipe recipe;
        recipe.seamJoinShare = 0;  // joined ends mark stretches of seams that nobody drew
        const LayoutOverlay overlay = inspected(chartedCube(1, cells), planOf(lines), recipe);
        double worst = 0;
        for (const OverlayLine& shown : overlay.lines)
            for (const OverlayLine::Chains* chains : {&shown.parting, &shown.idle})
                for (const Points& chain : *chains)
                    for (const glm::dvec2& p : chain) {
                        double least = 1e300;
                        for (const Points& line : lines)
                            least = std::min(least, distanceToLine(line, p));
                        worst = std::max(worst, least);
                    }
        CHECK(worst < 1e-6);
    }
}

TEST_CASE("a template with an overlay holds no line, however an editor rewrites its layers") {
    const Points stub = {cubeUv(2, 0.3, 0.25), cubeUv(2, 0.6, 0.4)};
    const LayoutOverlay overlay = inspected(chartedCube(), planOf({ringOn(0), stub}));
    const Layout layout = layoutOf(chartedCube(), {overlay});
    CHECK(layout.spots > 2);
    for (const char* layer : {"sherd guide lines", "sherd guide spots", "sherd guide legend"})
        CHECK(countOf(layout.svg, std::string("inkscape:label=\"") + layer + "\"") == 1);
    const std::string unmarked = without(layout.svg, " data-sherd-guide=\"true\"");
    std::string idsOnly = unmarked;
    for (size_t at; (at = idsOnly.find("inkscape:label=\"sherd guide")) != std::string::npos;)
        idsOnly.replace(at, 27, "inkscape:label=\"Ebene");
    std::string dissolved = idsOnly;
    for (const char* id : {"sherd-guide", "sherd-guide-lines", "sherd-guide-lines-style",
                           "sherd-guide-spots", "sherd-guide-legend", "sherd-guide-seams"})
        dissolved = without(dissolved, "id=\"" + std::string(id) + "\"");
    for (const std::string& svg : {layout.svg, unmarked, idsOnly, dissolved}) {
        const Result<FractureMap> map = readSvgMap(svg, "l.svg", {});
        REQUIRE_FALSE(map);
        CHECK(map.error().code == ErrorCode::emptyMap);
        std::string drawn = svg;
        const size_t layer = drawn.find("id=\"level-1\"");
        drawn.insert(drawn.find('>', layer) + 1, "<path d=\"M 0,512 H 1024\"/>");
        const Result<FractureMap> read = readSvgMap(drawn, "l.svg", {});
        REQUIRE(read);
        CHECK(read->lines.size() == 1);
        CHECK(read->warnings.empty());
    }
}

TEST_CASE("whatever a drawing's lines are called, the template stays well formed") {
    LayoutOverlay overlay;
    const std::string name = "\"/></title><path d='M0 0L9 9'/>&\x01 caf\xe9 \xc3\xa9 \xed\xa0\x80";
    overlay.lines.push_back({1, name, {{{0, 0}, {1, 1}}}, {}});
    overlay.findings.push_back({"new-code", "m", "", 1, {{std::nullopt, glm::dvec2(0.5), name}}});
    overlay.findings.push_back({"gaps", "m", "", 1, {{std::nullopt, glm::dvec2(NAN), name}}});
    const Layout layout = layoutOf(chartedCube(), {overlay});
    CHECK(layout.spots == 1);
    const Result<FractureMap> map = readSvgMap(layout.svg, "l.svg", {});
    REQUIRE_FALSE(map);
    CHECK(map.error().code == ErrorCode::emptyMap);
    CHECK(countOf(layout.svg, "\xe9") == 0);
    CHECK(countOf(layout.svg, "\xc3\xa9") == 2);
    CHECK(countOf(layout.svg, "\xef\xbf\xbd") == 2 * 4);
}

TEST_CASE("a line off the charts of one object that lies on another's is no spot") {
    LayoutOverlay off;
    off.findings.push_back({"off-charts", "m", "", 1, {{std::nullopt, glm::dvec2(0.5), "a"}}});
    CHECK(layoutOf(chartedCube(), {off, {}}).spots == 0);
    CHECK(layoutOf(chartedCube(), {off, off}).spots == 1);
}
