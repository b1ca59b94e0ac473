// SPDX-License-Identifier: MIT
// Labels in a drawing: texts, named shapes and shapes with attributes.
#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "svg_drawing.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FractureMap readLabels(const std::string& body) {
    return readDrawing(drawing("<path d='M0 0L9 9'/>" + body));
}

FractureMap::Label labelOf(const std::string& body) {
    const FractureMap map = readLabels(body);
    CAPTURE(body);
    for (const std::string& warning : map.warnings) INFO(warning);
    REQUIRE(map.labels.size() == 1);
    CHECK(map.lines.size() == 1);
    return map.labels[0];
}

FractureMap::Label labelOfText(const std::string& words) {
    return labelOf("<text x='10' y='20'>" + words + "</text>");
}

bool liesAt(const FractureMap::Label& label, double u, double v) {
    CAPTURE(label.place.point.x);
    CAPTURE(label.place.point.y);
    return !label.place.in3d && glm::length(label.place.point - glm::dvec3(u, v, 0)) < 1e-9;
}

}  // namespace

TEST_CASE("a drawing with labels and no line is an empty map") {
    const auto map = readSvgMap(drawing("<text>name: rim</text>"), "t.svg", {});
    REQUIRE_FALSE(map);
    CHECK(map.error().code == ErrorCode::emptyMap);
}

TEST_CASE("a text without words of a label is passed over") {
    for (const char* words : {"", " ", "rim", "Scale 1:20", "note: draw here", "anchors",
                              "anchor rim", "level: 2", "name", "named: x"}) {
        const FractureMap map = readLabels("<text>" + std::string(words) + "</text>");
        CHECK_MESSAGE(map.labels.empty(), words);
        CHECK(warns(map, "1 text"));
    }
}

TEST_CASE("a text is a label at its anchor point") {
    const auto label = labelOfText(
        "name: the rim; material:glass ; DENSITY: 2500; strength: 5e7; toughness: 8;"
        "anchor; level: 2");
    CHECK(liesAt(label, 0.1, 0.2));
    CHECK(label.name == "the rim");
    CHECK(label.material == "glass");
    CHECK(label.density == 2500.0F);
    CHECK(label.strength == 5e7F);
    CHECK(label.toughness == 8.0F);
    CHECK(label.anchor);
    CHECK(label.level == 2);
    CHECK(label.source.find("t.svg: text at byte ") == 0);
}

TEST_CASE("labels may be short") {
    CHECK(labelOfText("label: rim").name == "rim");
    CHECK(labelOfText("Label:").name.empty());
    CHECK(labelOfText("label: name: rim").name == "rim");
    CHECK(labelOfText("label: anchor").anchor);
    CHECK(labelOfText("label: rim; anchor").anchor);
    CHECK(labelOfText(" Anchor ").anchor);
    CHECK(labelOfText("anchor: yes").anchor);
    CHECK_FALSE(labelOfText("anchor: no").anchor);
    CHECK(labelOfText("toughness: 5").toughness == 5.0F);
    CHECK_FALSE(labelOfText("toughness: 5").density);
    CHECK(labelOfText("name: a: b").name == "a: b");
}

TEST_CASE("words of a label that cannot be read are reported, and the others hold") {
    for (const char* bad :
         {"density: 0", "density: -1", "density: x", "strength: NaN", "toughness: -0.1",
          "anchor: maybe", "level: 65", "level: x", "glass", "colour: red"}) {
        CAPTURE(bad);
        const FractureMap map =
            readLabels("<text id='t'>name: rim; " + std::string(bad) + "; material: clay</text>");
        REQUIRE(map.labels.size() == 1);
        CHECK(map.labels[0].name == "rim");
        CHECK(map.labels[0].material == "clay");
        REQUIRE(map.warnings.size() == 1);
        CHECK(warns(map, "t.svg: text #t: "));
    }
    const FractureMap map = readLabels("<text>name: " + std::string(300, 'x') + "</text>");
    REQUIRE(map.labels.size() == 1);
    CHECK(map.labels[0].name.empty());
    CHECK(warns(map, "256 bytes"));
}

TEST_CASE("Inkscape's text is a label, a tspan for each line") {
    const auto label = labelOf(
        R"svg(<text xml:space="preserve" style="font-size:4.9px;fill:#000000" x="10" y="50" id="text1"
           transform="translate(0,-10)"><tspan sodipodi:role="line" id="tspan1" x="10"
           y="50">name: rim</tspan><tspan sodipodi:role="line" x="10" y="56">material: glass</tspan>
           </text>)svg");
    CHECK(liesAt(label, 0.1, 0.4));
    CHECK(label.name == "rim");
    CHECK(label.material == "glass");
    CHECK(label.source == "t.svg: text #text1");
}

TEST_CASE("Illustrator's text is a label, a word broken over tspans being one word") {
    const auto label = labelOf(
        R"svg(<text class="cls-2" transform="translate(30 40)"><tspan x="0" y="0">name: r</tspan><tspan
           class="cls-3" x="20" y="0">im; anc</tspan><tspan x="30" y="0">hor</tspan><tspan x="0"
           y="14.4">density: 5</tspan></text>)svg");
    CHECK(liesAt(label, 0.3, 0.4));
    CHECK(label.name == "rim");
    CHECK(label.anchor);
    CHECK(label.density == 5.0F);
}

TEST_CASE("Affinity's text is a label") {
    const auto label = labelOf(
        R"(<text x="30px" y="40px" style="font-family:'ArialMT', 'Arial', sans-serif;">name: rim<tspan
           x="30px " y="52px ">anchor</tspan></text>)");
    CHECK(liesAt(label, 0.3, 0.4));
    CHECK(label.name == "rim");
    CHECK(label.anchor);
}

TEST_CASE("Figma's text is a label, its wrapped lines going on") {
    const auto label = labelOf(
        R"(<text id="name: the upper rim" fill="black" xml:space="preserve" style="white-space: pre"
           font-size="16"><tspan x="30" y="40.5">name: the upper </tspan><tspan x="30"
           y="60">rim&#10;</tspan><tspan x="30" y="80">material: clay</tspan></text>)");
    CHECK(liesAt(label, 0.3, 0.405));
    CHECK(label.name == "the upper rim");
    CHECK(label.material == "clay");
}

TEST_CASE("Figma's outlined text is a label by its name, at the middle of the letters") {
    const auto label = labelOf(
        "<path id='name: rim; toughness: 5' d='M10 10H30V20H10Z M40 10H50V30Z' fill='black'/>");
    CHECK(liesAt(label, 0.3, 0.2));
    CHECK(label.name == "rim");
    CHECK(label.toughness == 5.0F);
}

TEST_CASE("any shape is a label by its name, as each editor writes it") {
    const std::string place = " cx='30' cy='40' r='3'/>";
    CHECK(labelOf("<circle inkscape:label='label: rim' id='c1'" + place).name == "rim");
    CHECK(labelOf("<circle data-name='label: rim' id='label_rim'" + place).name == "rim");
    CHECK(labelOf("<circle serif:id='label: the rim' id='label-the-rim'" + place).name ==
          "the rim");
    CHECK(labelOf("<circle id='label: rim'" + place).name == "rim");
    const auto escaped = labelOf("<circle id='label_x3A__the_rim_x3B__anchor'" + place);
    CHECK(escaped.name == "the rim");
    CHECK(escaped.anchor);
    CHECK(liesAt(escaped, 0.3, 0.4));
}

TEST_CASE("any shape is a label by its attributes") {
    const auto label = labelOf(
        "<g transform='translate(10 0)'><circle data-name='rim' data-material='glass' "
        "data-density='5'"
        " data-strength='6' data-toughness='7' data-anchor='' data-level='2' cx='30' cy='40' "
        "r='3'/></g>");
    CHECK(liesAt(label, 0.4, 0.4));
    CHECK(label.name == "rim");
    CHECK(label.material == "glass");
    CHECK(label.density == 5.0F);
    CHECK(label.strength == 6.0F);
    CHECK(label.toughness == 7.0F);
    CHECK(label.anchor);
    CHECK(label.level == 2);
    CHECK(labelOf("<ellipse data-label='rim' data-name='x' cx='1' cy='2' rx='3' ry='4'/>").name ==
          "rim");
    CHECK(labelOf("<rect data-label='material: clay' width='3' height='4'/>").material == "clay");
    CHECK(labelOf("<text data-label='rim'>anything</text>").name == "rim");
    CHECK_FALSE(labelOf("<circle data-label='rim' data-anchor='false' r='3'/>").anchor);
}

TEST_CASE("a group is a label at the middle of its shapes") {
    const auto label = labelOf(
        "<g id='label: rim'><path d='M10 10H20'/><g><rect x='30' y='20' width='10' "
        "height='10'/></g>"
        "<text>name: inner</text></g>");
    CHECK(liesAt(label, 0.25, 0.2));
    CHECK(label.name == "rim");
}

TEST_CASE("a named line stays a line, also one named after its toughness") {
    const FractureMap map = readDrawing(drawing(
        "<path data-name='rim' d='M0 0L9 9'/><path id='toughness: 5' d='M0 0L9 9'/>"
        "<path id='anchor' d='M0 0L9 9'/><path data-strength='5' data-name='a' d='M0 0L9 9'/>"));
    CHECK(map.lines.size() == 4);
    CHECK(map.labels.empty());
}

TEST_CASE("a label means a component of its layer's level, or the deepest") {
    CHECK(labelOf("<text>anchor</text>").level == 0);
    CHECK(labelOf("<g id='level 2'><text>anchor</text></g>").level == 2);
    CHECK(labelOf("<g id='level 2'><text>anchor; level: 0</text></g>").level == 0);
    CHECK(labelOf("<g id='level 2'><circle r='3' data-label='a'/></g>").level == 2);
}

TEST_CASE("hidden labels and those in the guide layer say nothing") {
    CHECK(readLabels("<text display='none'>anchor</text>").labels.empty());
    CHECK(readLabels("<text visibility='hidden'>anchor</text>").labels.empty());
    CHECK(readLabels("<g style='display:none'><text>anchor</text></g>").labels.empty());
    CHECK(readLabels("<g id='sherd-guide'><text>anchor</text></g>").labels.empty());
    CHECK(readLabels("<defs><text>anchor</text></defs>").labels.empty());
}

TEST_CASE("a label that lies nowhere is reported") {
    for (const char* body : {"<circle data-label='rim'/>", "<g id='label: rim'/>",
                             "<path visibility='hidden' data-label='rim' d='M0 0L1 1'/>"}) {
        const FractureMap map = readLabels(body);
        CHECK(map.labels.empty());
        CHECK(warns(map, "lies nowhere"));
    }
}

TEST_CASE("tspans nested without end, and endless texts, are no label") {
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<tspan>";
    deep += "name: rim";
    for (int i = 0; i < 100000; ++i) deep += "</tspan>";
    CHECK(readLabels("<text>" + deep + "</text>").labels.empty());
    CHECK(readLabels("<text>name: " + std::string(100000, 'x') + "</text>").labels.empty());
}
