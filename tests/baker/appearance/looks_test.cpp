// SPDX-License-Identifier: MIT
// Normals, texture coordinates and tangents of hidden faces, judged from the written file.
#include <doctest/doctest.h>

#include <cstring>

#include "appearance/hidden_edges.h"
#include "support/baked_set.h"
#include "support/hidden_looks.h"
#include "support/models.h"
#include "support/pattern_plans.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// A long box whose sides are no squares, and pieces cut at all angles.
SurfaceMesh plank() {
    SurfaceMesh mesh = chartedCube(1, 5);
    for (glm::vec3& p : mesh.positions) p *= glm::vec3(2.0F, 0.3F, 0.7F);
    return mesh;
}

FractureSet bakedPlank(const Recipe& recipe = {}) {
    return writtenSet(modelAround(withTangents(plank())),
                      patterns({"voronoi:6:3", "voronoi:15:4", "voronoi:30:5"}), recipe);
}

Attribute& attribute(FractureSet& set, const std::string& semantic) {
    for (Attribute& a : set.geometry.attributes)
        if (a.semantic == semantic) return a;
    FAIL("no " << semantic);
    return set.geometry.attributes[0];
}

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / M_PI;
}

/// Corners of hidden faces whose normal is farther from the face's own than that, walls or sheets.
size_t leaningNormals(const FractureSet& set, bool sheets, double degrees) {
    const Attribute* normals = attributeOf(set, "NORMAL");
    size_t count = 0;
    for (const SeenFace& face : hiddenFacesOf(set)) {
        if (face.primitive->sheet != sheets || !(glm::length(face.normal) > 1e-9)) continue;
        for (const uint32_t v : face.v)
            count += degreesBetween(vec3Of(*normals, v), face.normal) > degrees ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST_CASE("boxes cut at all angles have even texels inside") {
    for (const SurfaceMesh& mesh : {chartedCube(1, 1), chartedCube(3, 6), plank()}) {
        for (const char* pattern : {"voronoi:5:2", "voronoi:13:1", "voronoi:40:9"}) {
            CAPTURE(mesh.positions.size());
            CAPTURE(pattern);
            Recipe recipe;
            recipe.interior.uvMetresPerTile = 0.25;
            const FractureSet set = writtenSet(modelAround(mesh), patterns({pattern}), recipe);
            const TexelDensity density = texelDensity(set, 1e-10);
            CHECK(density.faces > 30);
            CHECK(density.byArea < 1.5);
            CHECK(density.byFace < 1.5);
            CHECK(density.stretch < 1.31);
            CHECK(density.mean == doctest::Approx(16).epsilon(0.01));
            CHECK(density.mirrored < 1e-6);  // slivers, by rounding
        }
    }
}

TEST_CASE("the skull has even texels inside") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    const Result<Model> model = importModel(sharedDir() / "models/dev/skull_41k_atlas.glb", {});
    REQUIRE(model.has_value());
    for (const char* pattern : {"voronoi:13:1", "voronoi:58:1"}) {
        const TexelDensity density = texelDensity(writtenSet(*model, patterns({pattern})), 1e-12);
        MESSAGE(pattern << ": p95/p5 " << density.byArea << " by area, " << density.byFace
                        << " by face, stretch " << density.stretch);
        CHECK(density.byArea < 2);
        CHECK(density.byFace < 2);
        CHECK(density.mirrored < 1e-6);  // slivers, by rounding
    }
}

TEST_CASE("the measure of texels sees uneven, stretched and mirrored ones") {
    FractureSet set = bakedPlank();
    const TexelDensity good = texelDensity(set, 1e-10);
    // Seen along y alone, faces that y lies in have no texels.
    Attribute& uv = attribute(set, "TEXCOORD_0");
    std::vector<float> kept = uv.values;
    for (size_t v = 0; v < set.geometry.positions.size(); ++v) {
        uv.values[2 * v] = set.geometry.positions[v].x;
        uv.values[2 * v + 1] = set.geometry.positions[v].z;
    }
    CHECK(texelDensity(set, 1e-10).byArea > 3);
    for (size_t v = 0; v < set.geometry.positions.size(); ++v) {
        uv.values[2 * v] = -2 * kept[2 * v];
        uv.values[2 * v + 1] = kept[2 * v + 1];
    }
    CHECK(texelDensity(set, 1e-10).stretch > 1.6);
    CHECK(texelDensity(set, 1e-10).mirrored == doctest::Approx(1));
    CHECK(good.mirrored < 1e-6);  // slivers, by rounding
}

TEST_CASE("tangents follow the texture and stand across the normals") {
    const FractureSet smooth = bakedPlank();
    const TangentFaults faults = tangentFaults(smooth, 45);
    CHECK(faults.corners > 1000);
    CHECK(faults.sum() == 0);
    Recipe flat;
    flat.interior.normals = InteriorNormals::flat;
    CHECK(tangentFaults(bakedPlank(flat), 3).sum() == 0);
}

TEST_CASE("the judge of tangents sees turned, mirrored, leaning and short ones") {
    const FractureSet good = bakedPlank();
    FractureSet bad = good;
    std::vector<float>& t = attribute(bad, "TANGENT").values;
    const std::vector<float> kept = t;
    for (size_t i = 3; i < t.size(); i += 4) t[i] = -1;
    CHECK(tangentFaults(bad, 45).wrongHandedness == tangentFaults(bad, 45).corners);
    t = kept;
    for (size_t i = 0; i < t.size(); i += 4)
        for (size_t c = 0; c < 3; ++c) t[i + c] = -t[i + c];
    CHECK(tangentFaults(bad, 45).offU == tangentFaults(bad, 45).corners);
    t = kept;
    for (size_t i = 0; i < t.size(); i += 4) t[i] += 0.1F;
    CHECK(tangentFaults(bad, 45).notAcross > 100);
    CHECK(tangentFaults(bad, 45).notUnit > 100);
}

TEST_CASE("walls are flat, sheets are smooth up to the crease angle, and all is flat if asked") {
    Recipe recipe;
    recipe.interior.creaseAngle = 40;
    const FractureSet smooth = bakedPlank(recipe);
    CHECK(leaningNormals(smooth, false, 1.5) == 0);
    CHECK(leaningNormals(smooth, true, 3) > 100);
    CHECK(leaningNormals(smooth, true, 80) == 0);
    recipe.interior.creaseAngle = 0;
    CHECK(leaningNormals(bakedPlank(recipe), true, 1.5) == 0);
    recipe.interior.creaseAngle = 60;
    recipe.interior.normals = InteriorNormals::flat;
    const FractureSet flat = bakedPlank(recipe);
    CHECK(leaningNormals(flat, true, 1.5) == 0);
    CHECK(leaningNormals(flat, false, 1.5) == 0);
}

TEST_CASE("a hidden face looks the same, bit by bit, at every level that shows it") {
    const FractureSet set = bakedPlank();
    REQUIRE(set.levels.size() == 4);
    size_t shown = 0;
    for (uint32_t f = 0; f < set.fragments.size(); ++f)
        if (set.fragments[f].children.count > 0) shown += shownHidden(set, f).size();
    CHECK(shown > 1000);
    CHECK(facesThatChange(set) == 0);
}

TEST_CASE("the judge of levels sees a face whose normal changes by a bit") {
    FractureSet set = bakedPlank();
    // The last leaf gets copies of its triangles, in one of which a normal differs.
    const auto leaf = static_cast<uint32_t>(set.fragments.size() - 1);
    const size_t primitives = set.geometry.primitives.size();
    size_t p = 0;
    while (set.geometry.primitives[p].exposedFrom != 1 ||
           set.fragmentRanges[leaf * primitives + p].count == 0)
        ++p;
    Range& range = set.fragmentRanges[leaf * primitives + p];
    std::vector<uint32_t>& indices = set.geometry.indices;
    const auto first = static_cast<uint32_t>(indices.size());
    for (uint32_t i = 0; i < range.count; ++i) indices.push_back(indices[range.first + i]);
    range.first = first;
    CHECK(facesThatChange(set) == 0);
    const uint32_t v = indices[first];
    indices[first] = static_cast<uint32_t>(set.geometry.positions.size());
    set.geometry.positions.push_back(set.geometry.positions[v]);
    for (Attribute& a : set.geometry.attributes)
        for (uint32_t c = 0; c < a.components; ++c)
            a.values.push_back(a.values[a.components * v + c]);
    float& normal = attribute(set, "NORMAL").values.back();
    normal = std::nextafter(normal, 2.0F);
    CHECK(facesThatChange(set) > 0);
}

TEST_CASE("a tile too small for its coordinates to have digits is enlarged and reported") {
    Recipe recipe;
    recipe.interior.uvMetresPerTile = 1e-300;
    const Result<BakedFile> baked =
        bakeModel(modelAround(plank()), patterns({"voronoi:5:2"}), recipe);
    if (!baked) FAIL(baked.error().message);
    const auto& findings = baked->report.objects[0].findings;
    CHECK(std::any_of(findings.begin(), findings.end(),
                      [](const BakeFinding& f) { return f.code == "tile-size"; }));
}

TEST_CASE("hidden faces with an edge of no length are left out, their neighbours grown together") {
    const SurfaceMesh mesh = chartedCube(1, 1);
    const SplitSurface surface = uncutSurface(mesh);
    const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
    std::vector<glm::vec3> points(surface.positions);
    for (glm::vec3& p : points) p = 0.5F * p + 0.25F;
    HiddenSheet sheet = plainSheet(surface, topology, points);
    const Components components{1, 1, std::vector<uint32_t>(12, 0), 1, {{0}}, {1}};
    std::vector<HiddenFace> faces;
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        HiddenFace face;
        for (uint32_t k = 0; k < 3; ++k) face.corners[k] = {3 * t + 2 - k, 1};
        faces.push_back(face);
    }
    const auto built = [&] { return hiddenMesh(mesh, surface, components, sheet, faces); };
    CHECK(built().faces.size() == faces.size());

    const auto& v = surface.triangles[0].v;
    sheet.points[v[0]] = sheet.points[v[1]];
    const HiddenMesh melted = built();
    CHECK(melted.faces.size() == faces.size() - 2);
    for (const uint32_t o : hiddenOpposites(melted)) CHECK(o != kNone);
}
