// SPDX-License-Identifier: MIT
#include "sherd/baker/layout.h"

#include <doctest/doctest.h>

#include <cmath>

#include "layout/uv_wireframe.h"
#include "sherd/baker/fracture_map.h"

using namespace sherd;

namespace {

/// Two triangles that share an edge in space; in UV too unless `seam`.
SurfaceMesh quad(bool seam) {
    SurfaceMesh mesh;
    mesh.name = "quad";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.triangleMaterials = {0, 0};
    mesh.materials = {0};
    mesh.uvSemantic = "TEXCOORD_0";
    if (seam) {
        mesh.corners = {{0, 1, 2}, {3, 4, 5}};
        mesh.attributes = {
            {"TEXCOORD_0", 2, {0, 0, 0.4F, 0, 0.4F, 0.4F, 0.6F, 0.6F, 1, 1, 0.6F, 1}}};
    } else {
        mesh.corners = {{0, 1, 2}, {0, 2, 3}};
        mesh.attributes = {{"TEXCOORD_0", 2, {0, 0, 1, 0, 1, 1, 0, 1}}};
    }
    return mesh;
}

Layout layoutOf(const SurfaceMesh& mesh, const LayoutOptions& options = {}) {
    Result<Layout> layout = makeLayoutSvg({&mesh, 1}, options);
    REQUIRE(layout);
    return *layout;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), with);
}

/// The layout with a line drawn into the layer of that level.
std::string drawnOver(const std::string& svg, int level) {
    const size_t layer = svg.find("id=\"level-" + std::to_string(level) + "\"");
    REQUIRE(layer != std::string::npos);
    std::string out = svg;
    return out.insert(out.find('>', layer) + 1, "<path id=\"crack\" d=\"M 0,512 H 1024\"/>");
}

GltfDocument documentWith(const std::string& image, int texCoord = 0) {
    GltfDocument document;
    document.json = R"({"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
        "texCoord": )" +
                    std::to_string(texCoord) + R"(}}}], "textures": [{"source": 0}],
        "images": [)" +
                    image + R"(], "bufferViews": [{"byteOffset": 1, "byteLength": 5}]})";
    document.bin = {0, 'h', 'e', 'l', 'l', 'o'};
    return document;
}

}  // namespace

TEST_CASE("a mesh without texture coordinates has no layout") {
    SurfaceMesh mesh = quad(false);
    mesh.uvSemantic.clear();
    const Result<Layout> layout = makeLayoutSvg({&mesh, 1}, {});
    REQUIRE_FALSE(layout);
    CHECK(layout.error().code == ErrorCode::noTextureCoordinates);
    CHECK_FALSE(makeLayoutSvg({}, {}));
}

TEST_CASE("a resolution out of range is refused") {
    const SurfaceMesh mesh = quad(false);
    for (const uint32_t resolution : {0U, 15U, 65537U}) {
        LayoutOptions options;
        options.resolution = resolution;
        const Result<Layout> layout = makeLayoutSvg({&mesh, 1}, options);
        REQUIRE_FALSE(layout);
        CHECK(layout.error().code == ErrorCode::badArgument);
    }
}

TEST_CASE("an edge shared in UV is inner and drawn once, a seam is two borders") {
    CHECK(layoutOf(quad(false)).borderEdges == 4);
    CHECK(layoutOf(quad(false)).innerEdges == 1);
    CHECK(layoutOf(quad(true)).borderEdges == 6);
    CHECK(layoutOf(quad(true)).innerEdges == 0);
}

TEST_CASE("charts on top of each other are drawn once") {
    const SurfaceMesh meshes[] = {quad(false), quad(false)};
    const Result<Layout> layout = makeLayoutSvg(meshes, {});
    REQUIRE(layout);
    CHECK(layout->borderEdges == 4);
    CHECK(layout->innerEdges == 1);
}

TEST_CASE("texture coordinates that are no numbers or coincide are left out") {
    SurfaceMesh mesh = quad(false);
    mesh.attributes[0].values[6] = NAN;
    CHECK(layoutOf(mesh).borderEdges == 3);
    for (float& value : mesh.attributes[0].values) value = 0.5F;
    CHECK(layoutOf(mesh).borderEdges == 0);
}

TEST_CASE("chains hold every edge exactly once") {
    const std::vector<std::array<uint32_t, 2>> edges = {{0, 1}, {0, 2}, {0, 3},
                                                        {1, 2}, {2, 3}, {4, 5}};
    std::vector<std::array<uint32_t, 2>> found;
    for (const auto& chain : chainEdges(6, edges))
        for (size_t i = 1; i < chain.size(); ++i)
            found.push_back({std::min(chain[i - 1], chain[i]), std::max(chain[i - 1], chain[i])});
    std::sort(found.begin(), found.end());
    CHECK(found == edges);
    CHECK(chainEdges(3, {}).empty());
}

TEST_CASE("an untouched layout is an empty map") {
    const Result<FractureMap> map = readSvgMap(layoutOf(quad(true)).svg, "l.svg", {});
    REQUIRE_FALSE(map);
    CHECK(map.error().code == ErrorCode::emptyMap);
}

TEST_CASE("a line drawn over the layout is read back alone, with its layer's level") {
    LayoutOptions options;
    options.texture = "data:image/png;base64,AAAA";
    for (int level = 1; level <= 3; ++level) {
        const Result<FractureMap> map =
            readSvgMap(drawnOver(layoutOf(quad(false), options).svg, level), "l.svg", {});
        REQUIRE(map);
        REQUIRE(map->lines.size() == 1);
        CHECK(map->lines[0].level == static_cast<uint32_t>(level));
        CHECK(map->lines[0].points == std::vector<glm::dvec2>{{0, 0.5}, {1, 0.5}});
        CHECK(map->lines[0].source == "l.svg: path #crack");
        CHECK(map->warnings.empty());
    }
}

TEST_CASE("the guide stays a guide when an editor rewrites the file") {
    const std::string svg = drawnOver(layoutOf(quad(false)).svg, 2);
    const std::string rewritten[] = {
        // the custom attribute dropped, the layer unlocked and renamed
        replaced(replaced(svg, "data-sherd-guide=\"true\"", ""), "sodipodi:insensitive=\"true\"",
                 "style=\"display:inline\""),
        replaced(svg, "inkscape:label=\"sherd guide\"", "inkscape:label=\"Ebene 1\""),
        // the layer dissolved: its paths stand alone with their ids
        replaced(replaced(svg, "id=\"sherd-guide\" data-sherd-guide=\"true\"", "id=\"g17\""),
                 "inkscape:label=\"sherd guide\"", ""),
        // ids renumbered, everything inside kept
        replaced(replaced(svg, "id=\"sherd-guide\"", "id=\"g17\""), "data-sherd-guide=\"true\"",
                 ""),
    };
    for (const std::string& text : rewritten) {
        const Result<FractureMap> map = readSvgMap(text, "l.svg", {});
        REQUIRE(map);
        REQUIRE(map->lines.size() == 1);
        CHECK(map->lines[0].level == 2);
        CHECK(map->warnings.empty());
    }
}

TEST_CASE("a line drawn in the guide layer by mistake is reported") {
    std::string svg = drawnOver(layoutOf(quad(false)).svg, 1);
    const size_t guide = svg.find("  </g>");
    svg.insert(guide, "<path d='M0 0L9 9'/>");
    const Result<FractureMap> map = readSvgMap(svg, "l.svg", {});
    REQUIRE(map);
    CHECK(map->lines.size() == 1);
    REQUIRE(map->warnings.size() == 1);
    CHECK(map->warnings[0].find("guide layer") != std::string::npos);
}

TEST_CASE("a texture becomes part of the guide, whatever its text holds") {
    LayoutOptions options;
    options.texture = "data:image/png;base64,\"/><path d='M0 0L9 9'/>";
    const Result<FractureMap> map =
        readSvgMap(drawnOver(layoutOf(quad(false), options).svg, 1), "l.svg", {});
    REQUIRE(map);
    CHECK(map->lines.size() == 1);
    CHECK(map->warnings.empty());
}

TEST_CASE("the base-colour texture is taken from the document") {
    std::vector<std::string> warnings;
    const SurfaceMesh mesh = quad(false);
    CHECK(baseColorTexture(documentWith(R"({"bufferView": 0, "mimeType": "image/png"})"), mesh,
                           warnings) == "data:image/png;base64,aGVsbG8=");
    CHECK(baseColorTexture(documentWith(R"({"uri": "data:image/jpeg;base64,AA=="})"), mesh,
                           warnings) == "data:image/jpeg;base64,AA==");
    CHECK(warnings.empty());
}

TEST_CASE("textures that are not there, not known or for another UV set are left out") {
    const SurfaceMesh mesh = quad(false);
    const GltfDocument documents[] = {
        documentWith(R"({"bufferView": 7, "mimeType": "image/png"})"),
        documentWith(R"({"bufferView": 0, "mimeType": "image/ktx2"})"),
        documentWith(R"({"uri": "file.png"})"),
        documentWith(R"({"bufferView": 0, "mimeType": "image/png"})", 1),
    };
    for (const GltfDocument& document : documents) {
        std::vector<std::string> warnings;
        CHECK(baseColorTexture(document, mesh, warnings).empty());
        CHECK(warnings.size() == 1);
    }
    std::vector<std::string> warnings;
    GltfDocument truncated = documentWith(R"({"bufferView": 0, "mimeType": "image/png"})");
    truncated.bin.resize(3);
    CHECK(baseColorTexture(truncated, mesh, warnings).empty());
    CHECK(baseColorTexture({"not json", {}}, mesh, warnings).empty());
    CHECK(baseColorTexture({"{}", {}}, mesh, warnings).empty());
}
