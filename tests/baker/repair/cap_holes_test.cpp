// SPDX-License-Identifier: MIT
// Holes of every kind, capped; judged by the closed-mesh proofs and by the file check.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "geometry/closed_mesh.h"
#include "repair/boundary_loops.h"
#include "repair/cap_holes.h"
#include "repair/least_area_filling.h"
#include "repair/planar_filling.h"
#include "sherd/baker/bake.h"
#include "support/baked_file.h"
#include "support/baked_set.h"
#include "support/models.h"
#include "support/plans.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

MeshTopology topologyOf(const SurfaceMesh& mesh) {
    return buildTopology(mesh.positions, mesh.triangles);
}

std::vector<HoleCap> capped(SurfaceMesh& mesh, const CapOptions& options = {}) {
    return capHoles(topologyOf(mesh), mesh, options);
}

bool isClosed(const SurfaceMesh& mesh) {
    return proveByIds(mesh.triangles).manifold() &&
           proveByPositions(mesh.positions, mesh.triangles).closed();
}

double volumeOf(const SurfaceMesh& mesh) {
    return signedVolume(mesh.positions, mesh.triangles, glm::dvec3(mesh.positions[0]));
}

/// Leaves out the triangles for which `gone(centroid)`.
SurfaceMesh without(const SurfaceMesh& whole, const std::function<bool(const glm::vec3&)>& gone) {
    SurfaceMesh mesh = whole;
    mesh.triangles.clear();
    mesh.corners.clear();
    mesh.triangleMaterials.clear();
    for (size_t t = 0; t < whole.triangles.size(); ++t) {
        const auto& v = whole.triangles[t];
        if (gone((whole.positions[v[0]] + whole.positions[v[1]] + whole.positions[v[2]]) / 3.0F))
            continue;
        mesh.triangles.push_back(v);
        mesh.corners.push_back(whole.corners[t]);
        mesh.triangleMaterials.push_back(whole.triangleMaterials[t]);
    }
    return mesh;
}

SurfaceMesh boxWithoutLid(int cells = 4) {
    return without(chartedCube(1, cells), [](const glm::vec3& c) { return c.z > 0.999F; });
}

/// A tube along z without ends; `height(angle)` of its upper rim.
SurfaceMesh tube(int around, const std::function<double(double)>& height) {
    MeshMaker maker;
    const auto corner = [&](int i, bool top) {
        const double angle = 2 * M_PI * (i % around) / around;
        const glm::vec3 p(std::cos(angle), std::sin(angle), top ? height(angle) : 0);
        return MeshMaker::Corner{p, {static_cast<float>(i) / around, top ? 0.0F : 1.0F}};
    };
    for (int i = 0; i < around; ++i)
        maker.quad(corner(i, false), corner(i + 1, false), corner(i + 1, true), corner(i, true));
    return maker.mesh();
}

FracturePlan cells(const char* pattern) {
    FracturePlan plan;
    plan.patterns.push_back({parsePattern(pattern).value()});
    return plan;
}

Recipe capping() {
    Recipe recipe;
    recipe.capHoles = true;
    return recipe;
}

}  // namespace

TEST_CASE("a closed mesh has no holes and stays as it is") {
    SurfaceMesh mesh = chartedCube(1, 2);
    const size_t before = mesh.triangles.size();
    CHECK(capped(mesh).empty());
    CHECK(mesh.triangles.size() == before);
    CHECK(mesh.capTriangles == 0);
}

TEST_CASE("a box without its lid gets it back") {
    SurfaceMesh mesh = boxWithoutLid();
    const std::vector<HoleCap> caps = capped(mesh);
    REQUIRE(caps.size() == 1);
    CHECK(caps[0].refusal.empty());
    CHECK(caps[0].flat);
    CHECK(caps[0].corners == 16);
    CHECK(caps[0].length == doctest::Approx(4));
    CHECK(caps[0].area == doctest::Approx(1));
    CHECK(caps[0].place.z == doctest::Approx(1));
    CHECK(mesh.capTriangles == 14);
    CHECK(isClosed(mesh));
    CHECK(volumeOf(mesh) == doctest::Approx(1));
    CHECK(mesh.corners.size() == mesh.triangles.size());
    CHECK(mesh.triangleMaterials.size() == mesh.triangles.size());
    for (const Attribute& attribute : mesh.attributes)
        CHECK(attribute.values.size() / attribute.components ==
              mesh.attributes[0].values.size() / mesh.attributes[0].components);
}

TEST_CASE("both ends of a tube are closed") {
    SurfaceMesh mesh = tube(24, [](double) { return 3; });
    const std::vector<HoleCap> caps = capped(mesh);
    REQUIRE(caps.size() == 2);
    CHECK(isClosed(mesh));
    const double ring = 12 * std::sin(2 * M_PI / 24);  // area of the polygon
    CHECK(volumeOf(mesh) == doctest::Approx(3 * ring));
    CHECK(caps[0].area == doctest::Approx(ring));
    CHECK(caps[1].area == doctest::Approx(ring));
}

TEST_CASE("a rim that goes up and down is closed by triangles, flat seen from above or not") {
    SurfaceMesh waves = tube(24, [](double a) { return 3 + 0.3 * std::sin(3 * a); });
    CHECK(capped(waves).size() == 2);
    CHECK(isClosed(waves));
    // A hole around half of a tube bends too far to be seen whole from anywhere.
    SurfaceMesh bent = without(torus(24, 12), [](const glm::vec3& c) {
        return c.x > 0 && c.z > 0 && std::abs(c.y) < 0.9F;
    });
    const std::vector<HoleCap> caps = capped(bent);
    REQUIRE(caps.size() == 1);
    if (caps[0].refusal.empty())
        CHECK(isClosed(bent));
    else
        CHECK(bent.capTriangles == 0);
}

TEST_CASE("a concave hole is filled inside its border only") {
    // An L out of the lid's 4 x 4 cells.
    SurfaceMesh mesh = without(chartedCube(1, 4), [](const glm::vec3& c) {
        return c.z > 0.999F && c.x < 0.75F && c.y < 0.75F && (c.x < 0.25F || c.y < 0.25F);
    });
    const std::vector<HoleCap> caps = capped(mesh);
    REQUIRE(caps.size() == 1);
    CHECK(caps[0].area == doctest::Approx(5.0 / 16));
    CHECK(isClosed(mesh));
    CHECK(volumeOf(mesh) == doctest::Approx(1));
}

TEST_CASE("holes that touch in a vertex, and a figure of eight, are closed loop by loop") {
    // Two cells of the lid, corner to corner: one walk along the border runs through both.
    SurfaceMesh mesh = without(chartedCube(1, 4), [](const glm::vec3& c) {
        const bool first = c.x < 0.5F && c.y < 0.5F && c.x > 0.25F && c.y > 0.25F;
        const bool second = c.x > 0.5F && c.y > 0.5F && c.x < 0.75F && c.y < 0.75F;
        return c.z > 0.999F && (first || second);
    });
    const std::vector<HoleCap> caps = capped(mesh);
    REQUIRE(caps.size() == 2);
    for (const HoleCap& cap : caps) {
        CHECK(cap.corners == 4);
        CHECK(cap.area == doctest::Approx(1.0 / 16));
    }
    CHECK(isClosed(mesh));
    CHECK(volumeOf(mesh) == doctest::Approx(1));
}

TEST_CASE("two bowls that touch at their rims are closed each by itself") {
    SurfaceMesh mesh = boxWithoutLid(2);
    const auto offset = static_cast<uint32_t>(mesh.positions.size());
    SurfaceMesh other = boxWithoutLid(2);
    // The corner (1, 1, 1) of the one is the corner (0, 0, 1) of the other.
    std::vector<uint32_t> id;
    for (const glm::vec3& p : other.positions) {
        const glm::vec3 moved = p + glm::vec3(1, 1, 0);
        const auto known =
            std::find(mesh.positions.begin(), mesh.positions.begin() + offset, moved);
        id.push_back(static_cast<uint32_t>(known - mesh.positions.begin()));
        if (known == mesh.positions.begin() + offset) {
            id.back() = static_cast<uint32_t>(mesh.positions.size());
            mesh.positions.push_back(moved);
        }
    }
    for (size_t t = 0; t < other.triangles.size(); ++t) {
        const auto& v = other.triangles[t];
        mesh.triangles.push_back({id[v[0]], id[v[1]], id[v[2]]});
        mesh.corners.push_back(other.corners[t]);
        mesh.triangleMaterials.push_back(0);
    }
    const std::vector<HoleCap> caps = capped(mesh);
    REQUIRE(caps.size() == 2);
    CHECK(caps[0].area == doctest::Approx(1));
    CHECK(caps[1].area == doctest::Approx(1));
    CHECK(proveByPositions(mesh.positions, mesh.triangles).closed());
    CHECK(volumeOf(mesh) == doctest::Approx(2));
}

TEST_CASE("a hole whose cap would cross the surface stays open and says why") {
    SurfaceMesh mesh = boxWithoutLid();
    // A closed spike through where the lid would be.
    const auto base = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::vec3& p :
         {glm::vec3(0.4F, 0.4F, 0.5F), {0.6F, 0.4F, 0.5F}, {0.5F, 0.6F, 0.5F}, {0.5F, 0.5F, 2}})
        mesh.positions.push_back(p);
    for (const auto& t : {std::array{0U, 2U, 1U}, {0U, 1U, 3U}, {1U, 2U, 3U}, {2U, 0U, 3U}}) {
        mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
        mesh.corners.push_back(mesh.corners[0]);
        mesh.triangleMaterials.push_back(0);
    }
    const size_t before = mesh.triangles.size();
    const std::vector<HoleCap> caps = capped(mesh);
    REQUIRE(caps.size() == 1);
    CHECK(caps[0].refusal.find("crosses") != std::string::npos);
    CHECK(mesh.triangles.size() == before);
    CHECK(mesh.capTriangles == 0);
}

TEST_CASE("of a mesh with more holes than the limit none is capped") {
    SurfaceMesh mesh = without(chartedCube(1, 9), [](const glm::vec3& c) {
        const auto odd = [](float x) { return static_cast<int>(x * 9) % 2 == 1; };
        return (c.z > 0.999F || c.z < 0.001F) && odd(c.x) && odd(c.y);
    });
    SurfaceMesh again = mesh;
    const std::vector<HoleCap> none = capped(mesh, {.mostHoles = 31});
    REQUIRE(none.size() == 1);
    CHECK(none[0].refusal.find("32 holes") != std::string::npos);
    CHECK(mesh.capTriangles == 0);
    CHECK(capped(again, {.mostHoles = 32}).size() == 32);
    CHECK(isClosed(again));
}

TEST_CASE("fillings refuse what is no polygon") {
    CHECK(fillInPlane({}).empty());
    const std::vector<glm::vec3> two = {{0, 0, 0}, {1, 0, 0}};
    const std::vector<glm::vec3> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    const std::vector<glm::vec3> one(5, glm::vec3(1));
    const std::vector<glm::vec3> bow = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2.5F, 0}};
    for (const auto& polygon : {two, line, one}) {
        CHECK(fillInPlane(polygon).empty());
        CHECK(fillWithLeastArea(polygon).empty());
    }
    CHECK(fillInPlane(bow).empty());
    CHECK(fillWithLeastArea(bow).size() == 2);
    const auto all = [](uint32_t, uint32_t) { return true; };
    CHECK(fillWithLeastArea(bow, all).empty());
    CHECK(fillWithLeastArea(std::vector<glm::vec3>(kMostCornersOfLeastArea + 1)).empty());
}

TEST_CASE("a capped box breaks into closed pieces that fill it, and looks as it did") {
    SurfaceMesh mesh = boxWithoutLid();
    const Result<BakedObject> refused = bakeObject(mesh, cells("voronoi:6"), {}, 0);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == ErrorCode::openMesh);
    CHECK(refused.error().message.find("--cap-holes") != std::string::npos);
    Recipe recipe = capping();
    recipe.measure = true;
    const Result<BakedObject> baked = bakeObject(mesh, cells("voronoi:6"), recipe, 0);
    if (!baked) FAIL(baked.error().message);
    const BakedObjectReport& report = baked->report;
    CHECK(report.levels[0].closed == 0);
    CHECK(report.levels[1].closed == report.levels[1].fragments);
    CHECK(report.levels[1].volumeShare == doctest::Approx(1).epsilon(0.03));
    CHECK(report.levels[1].coverageNone.value() < 0.03);
    CHECK_FALSE(report.levels[0].coverageNone.has_value());
    REQUIRE(report.caps.size() == 1);
    CHECK(report.caps[0].area == doctest::Approx(1));
    CHECK(std::any_of(report.findings.begin(), report.findings.end(), [](const BakeFinding& f) {
        return f.code == "capped" && f.count == 1 && f.places.size() == 1;
    }));
    // The object shows five faces; its pieces six.
    const FractureSet& set = baked->set;
    const auto lidArea = [&set](uint32_t f) {
        double area = 0;
        for (const auto& t : fragmentTriangles(set, f)) {
            const glm::dvec3 a(set.geometry.positions[t[0]]), b(set.geometry.positions[t[1]]),
                c(set.geometry.positions[t[2]]);
            if (a.z == 1 && b.z == 1 && c.z == 1)
                area += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        }
        return area;
    };
    CHECK(lidArea(0) == 0);
    double lids = 0;
    for (const uint32_t f : fragmentsAtLevel(set, 1)) lids += lidArea(f);
    CHECK(lids == doctest::Approx(1));
}

TEST_CASE("the file of a capped object passes the check") {
    for (const SurfaceMesh& mesh : {boxWithoutLid(), tube(24, [](double) { return 3; })}) {
        const CheckReport report = checkBaked(mesh, cells("voronoi:6:2"), capping());
        CHECK(std::none_of(report.findings.begin(), report.findings.end(), [](const Finding& f) {
            return f.severity == Severity::failure && f.code != "stale";
        }));
        CHECK(report.objects[0].levels[1].closed == report.objects[0].levels[1].fragments);
    }
}

TEST_CASE("a drawn line goes on over the cap of a hole within one chart") {
    // A hole in the middle of the lid; the line runs over the lid, and rings the box.
    SurfaceMesh mesh = without(chartedCube(1, 4), [](const glm::vec3& c) {
        return c.z > 0.999F && c.x > 0.25F && c.x < 0.75F && c.y > 0.25F && c.y < 0.75F;
    });
    FractureMap map;
    // x = 0.4 on the faces +y, -y (u along z, v along x) and +z, -z (u along x, v along y).
    for (const int face : {2, 3})
        map.lines.push_back({{cubeUv(face, -0.01, 0.4), cubeUv(face, 1.01, 0.4)}, 1, "ring"});
    for (const int face : {4, 5})
        map.lines.push_back({{cubeUv(face, 0.4, -0.01), cubeUv(face, 0.4, 1.01)}, 1, "ring"});
    const Result<BakedObject> baked = bakeObject(mesh, planOf(map), capping(), 0);
    if (!baked) FAIL(baked.error().message);
    CHECK(baked->report.levels[1].fragments == 2);
    CHECK(baked->report.levels[1].closed == 2);
}

TEST_CASE("what cannot be capped is refused, or stays open where that is allowed") {
    SurfaceMesh mesh = flatSquare(4);  // its border's cap would lie on it
    Recipe recipe = capping();
    const Result<BakedObject> refused = bakeObject(mesh, cells("voronoi:4"), recipe, 0);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == ErrorCode::openMesh);
    CHECK(refused.error().where.find("around (") != std::string::npos);
    recipe.allowOpen = true;
    const Result<BakedObject> baked = bakeObject(mesh, cells("voronoi:4"), recipe, 0);
    if (!baked) FAIL(baked.error().message);
    CHECK(baked->report.caps.empty());
    CHECK(baked->report.levels[1].closed == baked->report.levels[1].fragments);
}

TEST_CASE("open real models are capped as far as they go, and bake") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    for (const char* name : {"Avocado", "WaterBottle", "Lantern", "kaykit_pillar_decorated"}) {
        CAPTURE(name);
        const Result<Model> model =
            importModel(sharedDir() / "models/dev" / (std::string(name) + ".glb"), {});
        REQUIRE(model.has_value());
        Recipe recipe = capping();
        recipe.allowOpen = true;
        const Result<BakedFile> baked = bakeModel(*model, cells("voronoi:8"), recipe);
        if (!baked) {
            FAIL_CHECK(baked.error().message << " " << baked.error().where);
            continue;
        }
        size_t caps = 0;
        for (const BakedObjectReport& object : baked->report.objects) {
            caps += object.caps.size();
            for (size_t k = 1; k < object.levels.size(); ++k)
                CHECK(object.levels[k].closed == object.levels[k].fragments);
        }
        MESSAGE(name << ": " << caps << " holes capped");
    }
}
