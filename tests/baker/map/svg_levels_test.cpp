// SPDX-License-Identifier: MIT
// Which level a line of a drawing gets: by layers as editors write them, colours and attributes.
#include <doctest/doctest.h>

#include "map/map_text.h"
#include "map/svg_color.h"
#include "map/svg_names.h"
#include "svg_drawing.h"

using namespace sherd;
using namespace sherd::test;
using Levels = std::vector<uint32_t>;

namespace {

const std::string kPath = "<path d='M0 0L9 9'/>";

/// The level of a path with these attributes where red is 1, green 2 and blue 3; 9 by default.
uint32_t levelWith(const std::string& attributes, const std::string& css = "",
                   const std::string& group = "") {
    MapReadOptions options;
    options.level = 9;
    options.levelOfColor = {{"#f00", 1}, {"rgb(0,128,0)", 2}, {"BLUE", 3}};
    const FractureMap map =
        readDrawing(drawing("<style>" + css + "</style><g " + group +
                            "><path class='a' d='M0 0L9 9' " + attributes + "/></g>"),
                    options);
    return map.lines.at(0).level;
}

std::optional<uint32_t> colorOf(const std::string& text) {
    const std::optional<SvgColor> color = parseSvgColor(text);
    return color ? std::optional(color->rgb) : std::nullopt;
}

}  // namespace

TEST_CASE("a name without the word level, or without a number after it, gives no level") {
    for (const char* name : {"", "level", "levels", "levels 2", "level two", "eyelevel2", "2",
                             "layer 2", "level x2", "le vel 2", "leve"})
        CHECK_MESSAGE(!levelOfName(name), name);
    for (const char* name : {"level 0", "level 65", "level 100", "level 99999999999999999999"})
        CHECK_MESSAGE(levelOfName(name) == 0U, name);
}

TEST_CASE("a level is one word among others, and copies keep it") {
    for (const char* name :
         {"level 2", "Level_2", "LEVEL-2", "level2", "cracks level 2", "level2_fine", "level 2-2",
          "level_2_1_", "level 2 copy", "level 2 #3", "crackLevel2", "my_level_02", "level: 2",
          "levels of level 2", "1 level 2", "level 2_2", "level 2b"})
        CHECK_MESSAGE(levelOfName(name) == 2U, name);
    CHECK(levelOfName("level 64") == 64U);
}

// Each as the editor exports two layers "level 1" and "level 2" and a copy of the second.

TEST_CASE("Inkscape's layers choose the level by their label") {
    const FractureMap map = readDrawing(R"(<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<svg width="100mm" height="100mm" viewBox="0 0 100 100" version="1.1" id="svg5"
   xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
   xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"
   xmlns="http://www.w3.org/2000/svg">
  <sodipodi:namedview id="namedview7" inkscape:current-layer="layer1" />
  <defs id="defs2" />
  <g inkscape:label="level 1" inkscape:groupmode="layer" id="layer1">
    <path style="fill:none;stroke:#000000;stroke-width:0.26" d="M 0,0 10,10" id="path31" />
  </g>
  <g inkscape:groupmode="layer" id="layer3" inkscape:label="level 2" style="display:inline">
    <path style="fill:none;stroke:#000000" d="m 0,5 h 90" id="path31-1" />
    <g id="g12"><path d="m 0,5 h 90" id="level1" inkscape:label="path12" /></g>
  </g>
  <g inkscape:groupmode="layer" id="layer2" inkscape:label="level 2 copy">
    <path d="m 0,5 h 90" id="path31-1-3" />
  </g>
</svg>)");
    CHECK(levelsOf(map) == Levels{1, 2, 1, 2});
    CHECK(map.warnings.empty());
}

TEST_CASE("Illustrator's layers choose the level by data-name, or by their id") {
    const FractureMap map = readDrawing(R"(<?xml version="1.0" encoding="UTF-8"?>
<svg id="Layer_1" data-name="Layer 1" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">
  <defs><style>.cls-1{fill:none;stroke:#000;stroke-miterlimit:10;}</style></defs>
  <g id="level_1" data-name="level 1"><path class="cls-1" d="M0,0l10,10"/></g>
  <g id="level_2" data-name="level 2"><polyline class="cls-1" points="0 0 9 9"/></g>
  <g id="level_2-2" data-name="level 2"><line class="cls-1" x1="0" y1="1" x2="2" y2="3"/></g>
  <g id="level2"><line class="cls-1" x1="0" y1="1" x2="2" y2="3"/></g>
</svg>)");
    CHECK(levelsOf(map) == Levels{1, 2, 2, 2});
    const FractureMap older = readDrawing(R"(<?xml version="1.0" encoding="utf-8"?>
<!-- Generator: Adobe Illustrator 19.0.0, SVG Export Plug-In . SVG Version: 6.00 Build 0)  -->
<svg version="1.1" xmlns="http://www.w3.org/2000/svg" x="0px" y="0px" viewBox="0 0 100 100"
	 style="enable-background:new 0 0 100 100;" xml:space="preserve">
<style type="text/css">.st0{fill:none;stroke:#000000;stroke-miterlimit:10;}</style>
<g id="level_2"><path class="st0" d="M0,0l10,10"/></g>
<g id="level_2_1_"><path class="st0" d="M0,0l10,10"/></g>
<g id="level_x5F_3"><path class="st0" d="M0,0l10,10"/></g>
<g id="cracks_x28_level_4_x29_"><path class="st0" d="M0,0l10,10"/></g>
</svg>)");
    CHECK(levelsOf(older) == Levels{2, 2, 3, 4});
}

TEST_CASE("a single layer's name stands on the drawing itself in Illustrator") {
    const FractureMap map = readDrawing(drawing(kPath, "id='level_3' data-name='level 3'"));
    CHECK(levelsOf(map) == Levels{3});
}

TEST_CASE("CorelDRAW's layers choose the level by an id with escapes") {
    const FractureMap map = readDrawing(R"(<svg xmlns="http://www.w3.org/2000/svg" width="10mm"
 height="10mm" viewBox="0 0 1000 1000"><defs><style type="text/css"><![CDATA[
    .str0 {stroke:#2B2A29;stroke-width:7.62} .fil0 {fill:none} ]]></style></defs>
 <g id="level_x0020_2"><metadata id="CorelCorpID_0Corel-Layer"/>
  <path class="fil0 str0" d="M0 0l100 0"/></g></svg>)");
    CHECK(levelsOf(map) == Levels{2});
}

TEST_CASE("Affinity's layers choose the level by serif:id, not by the id made of it") {
    const FractureMap map = readDrawing(R"(<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
<svg width="100%" height="100%" viewBox="0 0 100 100" version="1.1"
 xmlns="http://www.w3.org/2000/svg" xml:space="preserve" xmlns:serif="http://www.serif.com/"
 style="fill-rule:evenodd;clip-rule:evenodd;stroke-linejoin:round;">
    <g id="level-1" serif:id="level 1"><path d="M0,0L10,10" style="fill:none;stroke:black;"/></g>
    <g id="level-2" serif:id="level 2"><path d="M0,0L10,10" style="fill:none;stroke:black;"/></g>
    <g id="level-21" serif:id="level 2"><path d="M0,0L10,10" style="fill:none;stroke:black;"/></g>
    <g id="level4" serif:id="level"><path d="M0,0L10,10" style="fill:none;stroke:black;"/></g>
    <g id="level3"><path d="M0,0L10,10" style="fill:none;stroke:black;"/></g>
</svg>)");
    CHECK(levelsOf(map) == Levels{1, 2, 2, 1, 3});
}

TEST_CASE("Figma's layers choose the level by an id with spaces") {
    const FractureMap map = readDrawing(R"(<svg width="100" height="100" viewBox="0 0 100 100"
 fill="none" xmlns="http://www.w3.org/2000/svg">
<g id="cracks">
<g id="level 1"><path id="Vector 1" d="M0 0L10 10" stroke="black"/></g>
<g id="level 2"><path id="Vector 2" d="M0 0L10 10" stroke="black"/></g>
<g id="level 2_2"><path id="Vector 2_2" d="M0 0L10 10" stroke="black"/></g>
</g>
</svg>)");
    CHECK(levelsOf(map) == Levels{1, 2, 2});
}

TEST_CASE("an editor's own name wins over the id") {
    CHECK(levelsOf(readDrawing(drawing("<g id='level 2' inkscape:label='level 3'>" + kPath +
                                       "</g><g id='level 2' data-name='level 4'>" + kPath +
                                       "</g>"))) == Levels{3, 4});
}

TEST_CASE("a layer whose number is no level is reported and changes nothing") {
    for (const char* name : {"level 0", "level_65", "level 1000"}) {
        const FractureMap map = readDrawing(
            drawing("<g id='level 7'><g id='" + std::string(name) + "'>" + kPath + "</g></g>"));
        CHECK(levelsOf(map) == Levels{7});
        CHECK(warns(map, "t.svg: g #" + std::string(name)));
        CHECK(warns(map, "from 1 to 64"));
    }
}

TEST_CASE("escapes in ids are undone, broken ones left alone") {
    const auto nameOf = [](const std::string& id) {
        pugi::xml_document document;
        pugi::xml_node node = document.append_child("g");
        node.append_attribute("id") = id.c_str();
        return svgObjectName(node);
    };
    CHECK(nameOf("label_x3A__the_rim") == "label: the rim");
    CHECK(nameOf("a_x0020_b") == "a b");
    CHECK(nameOf("a_x5F_b") == "a_b");
    CHECK(nameOf("_x31_st") == "1st");
    CHECK(nameOf("caf_xE9_") == "caf\xC3\xA9");
    CHECK(nameOf("_x4E2D__x1F600_") == "\xE4\xB8\xAD\xF0\x9F\x98\x80");
    for (const char* id : {"", "_", "_x", "_x_", "_xZZ_", "_x0_", "_xD800_", "_x110000_", "_x20",
                           "_x1234567_", "snake_case"})
        CHECK(nameOf(id) == id);
}

TEST_CASE("colours are read in every form of CSS") {
    for (const char* text : {"#f80", "#F80f", "#ff8800", "#FF880080", "rgb(255,136,0)",
                             "rgb( 255 , 136 , 0 )", "rgba(255,136,0,.5)", "RGB(255 136 0 / 50%)",
                             "rgb(100%, 53.3333%, 0%)", "rgb(300,136,-4)"})
        CHECK_MESSAGE(colorOf(text) == 0xff8800U, text);
    CHECK(colorOf("aliceblue") == 0xf0f8ffU);
    CHECK(colorOf(" Red ") == 0xff0000U);
    CHECK(colorOf("grey") == colorOf("gray"));
    CHECK(colorOf("rebeccapurple") == 0x663399U);
    CHECK(colorOf("yellowgreen") == 0x9acd32U);
    for (const char* text : {"", "#", "#ff", "#ff00g0", "#fffff", "rgb(", "rgb()", "rgb(1,2)",
                             "rgb(1,2,3", "rgb(1,2,3,4,5)", "rgb(1,2,3) x", "rgb(nan,0,0)", "none",
                             "transparent", "currentColor", "url(#a)", "redd", "re", "zzz"})
        CHECK_MESSAGE(!colorOf(text), text);
    CHECK(colorText(SvgColor{0x00ff8a}) == "#00ff8a");
}

TEST_CASE("stroke colours choose the level, from attributes, styles, classes and inheritance") {
    CHECK(levelWith("stroke='red'") == 1);
    CHECK(levelWith("stroke='#0000FF'") == 3);
    CHECK(levelWith("style='fill:none;stroke:rgb(0,128,0);stroke-width:2'") == 2);
    CHECK(levelWith("", ".a{stroke:#f00}") == 1);
    CHECK(levelWith("stroke='blue'", ".a{stroke:#f00}") == 1);
    CHECK(levelWith("style='stroke:blue'", ".a{stroke:#f00}") == 3);
    CHECK(levelWith("", "", "stroke='green'") == 2);
    CHECK(levelWith("stroke='inherit'", "", "stroke='green'") == 2);
    CHECK(levelWith("stroke='blue'", "", "stroke='green'") == 3);
    CHECK(levelWith("", "g{stroke:red}") == 1);
    CHECK(levelWith("stroke='rgba(255,0,0,0.5)'") == 1);
}

TEST_CASE("currentColor is the colour where the line is drawn") {
    CHECK(levelWith("stroke='currentColor'", "", "color='red'") == 1);
    CHECK(levelWith("color='blue'", "", "color='red' stroke='currentcolor'") == 3);
    CHECK(levelWith("", "", "color='red'") == 9);
    CHECK(levelWith("stroke='currentColor' color='inherit'", "", "style='color:green'") == 2);
}

TEST_CASE("no stroke, a gradient and a colour that was not named choose no level") {
    for (const char* stroke : {"none", "transparent", "url(#g)", "#ff0001", "nonsense", "black"})
        CHECK_MESSAGE(levelWith("stroke='" + std::string(stroke) + "'", "", "stroke='red'") == 9,
                      stroke);
    CHECK(levelWith("fill='red'") == 9);
}

TEST_CASE("lines in colours that choose no level are reported, once, unless a layer speaks") {
    const std::string black = "<path stroke='black' d='M0 0L9 9'/>";
    const std::string red = "<path stroke='red' d='M0 0L9 9'/>";
    const FractureMap map = readDrawing(drawing(black + black + red, "data-sherd-colors='red:2'"));
    REQUIRE(map.warnings.size() == 1);
    CHECK(warns(map, "2 line(s)"));
    CHECK(warns(map, "#000000"));
    CHECK(
        readDrawing(drawing("<g id='level 1'>" + black + "</g>" + red, "data-sherd-colors='red:2'"))
            .warnings.empty());
    CHECK(readDrawing(drawing(black)).warnings.empty());
}

TEST_CASE("an element's own level beats its colour, and its colour beats its layer") {
    const std::string layer = "id='level 5' data-level='6'";
    CHECK(levelWith("", "", layer) == 6);
    CHECK(levelWith("stroke='red'", "", layer) == 1);
    CHECK(levelWith("stroke='red' data-level='7'", "", layer) == 7);
    CHECK(levelWith("stroke='red'", "", layer + " stroke='blue'") == 1);
    CHECK(levelWith("id='level 8'", "", layer) == 8);
}

TEST_CASE("a drawing carries its own colours, and the options win over them") {
    const std::string body = "<path stroke='red' d='M0 0L9 9'/><path stroke='#0f0' d='M0 0L9 9'/>";
    CHECK(levelsOf(readDrawing(drawing(body, "data-sherd-colors='#ff0000:2 #00ff00:3'"))) ==
          Levels{2, 3});
    CHECK(levelsOf(readDrawing(drawing(
              body, "data-sherd-colors='rgb(255, 0, 0) : 4,lime:5;blue:6 '"))) == Levels{4, 5});
    MapReadOptions options;
    options.levelOfColor = {{"red", 7}};
    CHECK(levelsOf(readDrawing(drawing(body, "data-sherd-colors='#f00:2 #0f0:3'"), options)) ==
          Levels{7, 3});
}

TEST_CASE("a drawing's colours that cannot be read are reported, and what came before holds") {
    for (const char* list : {"red:2 lime", "red:2 limee:3", "red:2 lime:0", "red:2 lime:65",
                             "red:2 :3", "red:2 lime:x", "red:2 lime:", "red:2 lime:99999999999"}) {
        CAPTURE(list);
        const FractureMap map = readDrawing(drawing(
            "<path stroke='red' d='M0 0L9 9'/>", "data-sherd-colors='" + std::string(list) + "'"));
        CHECK(levelsOf(map) == Levels{2});
        REQUIRE(map.warnings.size() == 1);
        CHECK(warns(map, "data-sherd-colors"));
    }
}

TEST_CASE("colours in the options that are none, or whose level is none, are refused") {
    for (const std::pair<std::string, uint32_t>& bad : {std::pair<std::string, uint32_t>{"redd", 1},
                                                        {"", 1},
                                                        {"none", 1},
                                                        {"red", 0},
                                                        {"red", 65}}) {
        MapReadOptions options;
        options.levelOfColor = {bad};
        for (const bool json : {false, true}) {
            const auto map =
                json ? readJsonMap("{}", "t", options) : readSvgMap(drawing(kPath), "t", options);
            REQUIRE_FALSE(map);
            CHECK(map.error().code == ErrorCode::badArgument);
        }
    }
}

TEST_CASE("strength and toughness are read from shapes and inherited from groups") {
    const FractureMap map = readDrawing(drawing(
        kPath + "<g data-strength='5e5' data-toughness='10'>" + kPath +
            "<path data-toughness=' 0 ' d='M0 0L9 9'/><g data-strength='1'>" + kPath + "</g></g>",
        "data-toughness='3'"));
    REQUIRE(map.lines.size() == 4);
    CHECK_FALSE(map.lines[0].properties.strength);
    CHECK(map.lines[0].properties.toughness == 3.0F);
    CHECK(map.lines[1].properties.strength == 5e5F);
    CHECK(map.lines[1].properties.toughness == 10.0F);
    CHECK(map.lines[2].properties.strength == 5e5F);
    CHECK(map.lines[2].properties.toughness == 0.0F);
    CHECK(map.lines[3].properties.strength == 1.0F);
    CHECK(map.warnings.empty());
}

TEST_CASE(
    "attributes that cannot be read are reported with their element, the inherited ones hold") {
    for (const char* bad : {"", "x", "NaN", "inf", "-1", "1e39", "1e999", "5 MPa", "1 2", "0x10"}) {
        CAPTURE(bad);
        const FractureMap map = readDrawing(drawing(
            "<g data-strength='7' data-toughness='8' data-level='9'>"
            "<path id='p' d='M0 0L9 9' data-strength='" +
            std::string(bad) + "' data-toughness='" + bad + "' data-level='" + bad + "'/></g>"));
        CHECK(map.lines[0].properties.strength == 7.0F);
        CHECK(map.lines[0].properties.toughness == 8.0F);
        CHECK(map.lines[0].level == 9);
        CHECK(map.warnings.size() == 3);
        CHECK(warns(map, "t.svg: path #p: data-strength"));
    }
    for (const char* bad : {"0", "65", "1.5", "-3"})
        CHECK(warns(
            readDrawing(drawing("<path data-level='" + std::string(bad) + "' d='M0 0L9 9'/>")),
            "data-level"));
}

TEST_CASE("the same mistake is reported once, and a million of them do not fill the memory") {
    std::string uses;
    for (int i = 0; i < 100; ++i) uses += "<use href='#p'/>";
    const FractureMap map =
        readDrawing(drawing("<path id='p' data-strength='x' d='M0 0L9 9'/>" + uses));
    CHECK(map.lines.size() == 101);
    CHECK(map.warnings.size() == 1);
    std::string many;
    for (int i = 0; i < 5000; ++i)
        many += "<path id='p" + std::to_string(i) + "' data-strength='x' d='M0 0L9 9'/>";
    const FractureMap loud = readDrawing(drawing(many));
    CHECK(loud.warnings.size() < 500);
    CHECK(warns(loud, "further warnings"));
}

TEST_CASE("style sheets that would cost hours are refused") {
    std::string css;
    std::string body;
    for (int i = 0; i < 20000; ++i) css += "g{color:red}";
    for (int i = 0; i < 20000; ++i) body += "<g/>";
    const auto map = readSvgMap(drawing("<style>" + css + "</style>" + body + kPath), "t.svg", {});
    REQUIRE_FALSE(map);
    CHECK(map.error().code == ErrorCode::limitExceeded);
    CHECK(map.error().message.find("style sheets") != std::string::npos);
}

TEST_CASE("classes named again and again cost no more than once") {
    // Once took minutes: every mention tried every rule, and every rule searched the whole list.
    std::string css;
    std::string classes;
    for (int i = 0; i < 2000; ++i) css += ".a{stroke:red}";
    for (int i = 0; i < 20000; ++i) classes += "a ";
    const FractureMap map = readDrawing(
        drawing("<style>" + css + "</style><path class='" + classes + "' d='M0 0L9 9'/>",
                "data-sherd-colors='red:2'"));
    CHECK(levelsOf(map) == Levels{2});
}
