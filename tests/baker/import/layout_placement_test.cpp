// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "layout/drawn_triangle.h"
#include "layout/uv_wireframe.h"
#include "sherd/baker/layout.h"

using namespace sherd;

namespace {

using Corners = std::array<glm::vec2, 3>;

const Corners kTriangle = {{{0.25F, 0.25F}, {0.5F, 0.25F}, {0.25F, 0.75F}}};

Corners moved(Corners corners, glm::vec2 by) {
    for (glm::vec2& p : corners) p += by;
    return corners;
}

/// Two triangles of one chart, moved by `by`; material 0.
SurfaceMesh quad(glm::vec2 by) {
    SurfaceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.corners = mesh.triangles;
    mesh.triangleMaterials = {0, 0};
    mesh.materials = {0};
    mesh.uvSemantic = "TEXCOORD_0";
    mesh.attributes = {{"TEXCOORD_0", 2, {0, 0, 1, 0, 1, 1, 0, 1}}};
    for (size_t i = 0; i < 8; ++i) mesh.attributes[0].values[i] += by[static_cast<int>(i % 2)];
    return mesh;
}

}  // namespace

TEST_CASE("a triangle on the picture stays where it is, whatever the wrap") {
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        const DrawnTriangle drawn = drawnTriangle(kTriangle, {glm::dmat3(1.0), wrap, wrap});
        CHECK(drawn.points == kTriangle);
        CHECK(drawn.where == DrawnWhere::inPlace);
    }
    // A corner off the page does not count, the centre does; its border is on the page.
    const Corners over = {{{0.5F, 0.5F}, {1.25F, 0.5F}, {0.5F, 0.75F}}};
    CHECK(drawnTriangle(over, {}).points == over);
    const Corners border = {{{1, 0}, {1, 0.5F}, {1, 1}}};
    CHECK(drawnTriangle(border, {}).points == border);
}

TEST_CASE("a triangle in another tile is drawn in the one tile, mirrored where the texture is") {
    for (const glm::vec2 tile : {glm::vec2(1, 0), glm::vec2(-1, 2), glm::vec2(4, -3)}) {
        const Corners far = moved(kTriangle, tile);
        const DrawnTriangle repeated = drawnTriangle(far, {});
        CHECK(repeated.points == kTriangle);
        CHECK(repeated.where == DrawnWhere::anotherTile);
        const DrawnTriangle mirrored =
            drawnTriangle(far, {glm::dmat3(1.0), Wrap::mirror, Wrap::mirror});
        Corners want = kTriangle;
        for (glm::vec2& p : want) {
            for (int axis = 0; axis < 2; ++axis) {
                if (std::fmod(tile[axis], 2.0F) != 0) p[axis] = 1 - p[axis];
            }
        }
        CHECK(mirrored.points == want);
        const DrawnTriangle clamped =
            drawnTriangle(far, {glm::dmat3(1.0), Wrap::clamp, Wrap::clamp});
        CHECK(clamped.points == far);
        CHECK(clamped.where == DrawnWhere::beyondEdge);
    }
}

TEST_CASE("wraps count per axis") {
    const DrawnTriangle drawn =
        drawnTriangle(moved(kTriangle, {2, 2}), {glm::dmat3(1.0), Wrap::clamp, Wrap::repeat});
    CHECK(drawn.points == moved(kTriangle, {2, 0}));
    CHECK(drawn.where == DrawnWhere::beyondEdge);
}

TEST_CASE("a triangle is drawn where its texture's transform takes it") {
    TexturePlacement placement;
    placement.transform = glm::dmat3(2, 0, 0, 0, 2, 0, 0.25, 1, 1);
    const DrawnTriangle drawn = drawnTriangle(kTriangle, placement);
    // (0.25, 0.25) goes to (0.75, 1.5), (0.25, 0.75) to (0.75, 2.5): the centre is in tile (0, 1).
    CHECK(drawn.points == Corners{{{0.75F, 0.5F}, {1.25F, 0.5F}, {0.75F, 1.5F}}});
}

TEST_CASE("numbers that are none, or far too large, are no reason to fail") {
    Corners bad = kTriangle;
    bad[1].x = NAN;
    CHECK(std::isnan(drawnTriangle(bad, {}).points[1].x));
    bad[1].x = 3e38F;
    for (const glm::vec2 p : drawnTriangle(bad, {}).points) CHECK_FALSE(std::isnan(p.x));
}

TEST_CASE("a chart in another tile keeps its inner edges, and is reported") {
    const SurfaceMesh home = quad({0, 0});
    const SurfaceMesh far = quad({3, -2});
    const auto layout = makeLayoutSvg({&far, 1}, {});
    const auto plain = makeLayoutSvg({&home, 1}, {});
    REQUIRE(layout);
    REQUIRE(plain);
    CHECK(layout->svg == plain->svg);
    CHECK(layout->innerEdges == 1);
    CHECK(plain->warnings.empty());
    REQUIRE(layout->warnings.size() == 1);
    CHECK(layout->warnings[0].find("2 triangles lie in other tiles") != std::string::npos);
}

TEST_CASE("clamped charts beyond the edge are drawn where they lie, and reported") {
    SurfaceMesh mesh = quad({2, 0});
    mesh.placements = {{glm::dmat3(1.0), Wrap::clamp, Wrap::clamp}};
    const auto layout = makeLayoutSvg({&mesh, 1}, {});
    REQUIRE(layout);
    REQUIRE(layout->warnings.size() == 1);
    CHECK(layout->warnings[0].find("2 triangles lie beyond the edge") != std::string::npos);
    const UvWireframe wireframe = uvWireframe({&mesh, 1});
    CHECK(std::all_of(wireframe.points.begin(), wireframe.points.end(),
                      [](glm::vec2 p) { return p.x >= 2; }));
}

TEST_CASE("each material's triangles are drawn over its own picture") {
    SurfaceMesh mesh = quad({0, 0});
    mesh.materials = {0, 1};
    mesh.triangleMaterials = {0, 1};
    mesh.placements.resize(2);
    mesh.placements[1].transform = glm::dmat3(0.5, 0, 0, 0, 0.5, 0, 0, 0, 1);
    const UvWireframe wireframe = uvWireframe({&mesh, 1});
    CHECK(wireframe.inner.empty());
    CHECK(wireframe.borders.size() == 6);
}

TEST_CASE("a texture whose extension names another UV set is not shown") {
    GltfDocument document;
    document.json = R"({"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
        "extensions": {"KHR_texture_transform": {"texCoord": 1}}}}}], "textures": [{"source": 0}],
        "images": [{"uri": "data:image/png;base64,AA=="}]})";
    SurfaceMesh mesh = quad({0, 0});
    std::vector<std::string> warnings;
    CHECK(baseColorTexture(document, mesh, warnings).empty());
    CHECK(warnings.size() == 1);
    mesh.uvSemantic = "TEXCOORD_1";
    CHECK_FALSE(baseColorTexture(document, mesh, warnings).empty());
}
