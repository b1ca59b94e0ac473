// SPDX-License-Identifier: MIT
// Rough broken faces: the field, the refinement, and what is written.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <set>

#include "appearance/face_refinement.h"
#include "appearance/rough_field.h"
#include "support/baked_set.h"
#include "support/hidden_looks.h"
#include "support/models.h"
#include "support/pattern_plans.h"
#include "support/property.h"
#include "support/random_solids.h"
#include "support/solid_meshes.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

Recipe rough(double amplitude, double size = 0.15, uint32_t seed = 1) {
    Recipe recipe;
    recipe.interior.roughness = {amplitude, size, seed};
    return recipe;
}

using Corner = std::array<float, 3>;
using Corners = std::array<Corner, 3>;

Corners turned(Corners c) {
    while (c[0] > c[1] || c[0] > c[2]) c = {c[1], c[2], c[0]};
    return c;
}

/// Wall triangles of leaves that no other leaf shows the other way round, bit by bit; those with
/// two equal corners have no way round.
size_t wallsWithoutTwin(const FractureSet& set) {
    std::map<Corners, std::set<uint32_t>> shownBy;
    const size_t primitives = set.geometry.primitives.size();
    std::vector<std::pair<Corners, uint32_t>> walls;
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        if (set.fragments[f].children.count > 0) continue;
        for (size_t p = 0; p < primitives; ++p) {
            if (set.geometry.primitives[p].exposedFrom == 0 || set.geometry.primitives[p].sheet)
                continue;
            const Range range = set.fragmentRanges[f * primitives + p];
            for (uint32_t i = range.first; i < range.first + range.count; i += 3) {
                Corners c;
                for (uint32_t k = 0; k < 3; ++k) {
                    const glm::vec3& q = set.geometry.positions[set.geometry.indices[i + k]];
                    c[k] = {q.x, q.y, q.z};
                }
                if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
                walls.emplace_back(c, f);
                shownBy[turned(c)].insert(f);
            }
        }
    }
    size_t alone = 0;
    for (const auto& [c, f] : walls) {
        const auto twin = shownBy.find(turned({c[0], c[2], c[1]}));
        const bool other =
            twin != shownBy.end() && (twin->second.size() > 1 || !twin->second.contains(f));
        alone += other ? 0 : 1;
    }
    return alone;
}

std::vector<Corner> outerCorners(const FractureSet& set) {
    std::vector<Corner> corners;
    for (const Primitive& p : set.geometry.primitives) {
        if (p.exposedFrom > 0) continue;
        for (uint32_t i = p.indices.first; i < p.indices.first + p.indices.count; ++i) {
            const glm::vec3& q = set.geometry.positions[set.geometry.indices[i]];
            corners.push_back({q.x, q.y, q.z});
        }
    }
    return corners;
}

glm::dvec3 somewhere(Random& random, double reach) {
    const double x = random.in(-reach, reach);
    const double y = random.in(-reach, reach);
    return {x, y, random.in(-reach, reach)};
}

double areaOf(const HiddenMesh& mesh) {
    double area = 0;
    for (const double a : faceShapes(mesh).areas) area += a;
    return area;
}

}  // namespace

TEST_CASE("the rough field is never longer than 1 nor steeper than it says, and nearly so") {
    for (const uint32_t seed : propertySeeds(1, 20)) {
        CAPTURE(seed);
        const RoughField field(0.3, seed);
        Random random(seed);
        double longest = 0, steepest = 0, worstSlope = 0;
        for (int i = 0; i < 5000; ++i) {
            const glm::dvec3 p = somewhere(random, 5);
            const double apart = std::pow(10, random.in(-6, 0));
            const glm::dvec3 q = p + glm::normalize(somewhere(random, 1)) * apart;
            const RoughField::Value a = field.at(p);
            const RoughField::Value b = field.at(q);
            longest = std::max(longest, glm::length(a.vector));
            steepest = std::max(steepest, glm::distance(a.vector, b.vector) / glm::distance(p, q));
            // Between creases the slope says where the field goes.
            if (apart > 1e-5 || a.slope != b.slope) continue;
            const double off = glm::distance(b.vector, a.vector + a.slope * (q - p));
            worstSlope = std::max(worstSlope, off / apart);
        }
        CHECK(longest <= 1);
        CHECK(longest > 0.5);
        CHECK(steepest <= field.steepest() * (1 + 1e-6));
        CHECK(steepest > 0.7 * field.steepest());
        CHECK(worstSlope < 1e-4 * field.steepest());
    }
}

TEST_CASE("the rough field scales with its bumps and differs from seed to seed") {
    const RoughField one(1, 7);
    const RoughField twice(2, 7);
    const RoughField other(1, 8);
    const glm::dvec3 p(0.3, -4.7, 11.1);
    CHECK(one.at(p).vector == twice.at(2.0 * p).vector);
    CHECK(one.steepest() == 2 * twice.steepest());
    CHECK(glm::distance(one.at(p).vector, other.at(p).vector) > 1e-3);
    for (const double far : {1e9, 1e18, 1e30})
        CHECK(glm::length(one.at(glm::dvec3(far)).vector) <= 1.0 + 1e-6 * far);
}

TEST_CASE("refined faces keep their area, their direction, their skin and their reverses") {
    for (const uint32_t seed : propertySeeds(1, 200)) {
        CAPTURE(seed);
        Random random(seed);
        // A fan around a vertex, every face also the other way round, some edges on the skin.
        const uint32_t spokes = 3 + random.below(5);
        HiddenMesh mesh;
        SplitSurface surface;
        mesh.skinVertices = spokes + 1;
        for (uint32_t i = 0; i <= spokes; ++i)
            mesh.positions.emplace_back(somewhere(random, random.oneIn(3) ? 0.1 : 1));
        const double flatness = random.oneIn(2) ? 0 : 1;
        for (uint32_t i = 1; i <= spokes; ++i) {
            const double angle = 2 * M_PI * i / spokes;
            mesh.positions[i] =
                glm::vec3(std::cos(angle), std::sin(angle), mesh.positions[i].z * flatness);
            const uint32_t next = i % spokes + 1;
            mesh.faces.push_back({{0, i, next}, 0, 1, 0, 0, true});
            mesh.faces.push_back({{next, i, 0}, 1, 1, 1, 0, true});
            if (random.oneIn(2)) surface.triangles.push_back({{i, next, next}, 0, {}});
        }
        const HiddenMesh before = mesh;
        // Now and then an edge is a whole number of parts long, and rounding decides.
        const double longest = random.oneIn(2)
                                   ? random.in(0.03, 0.5)
                                   : glm::distance(mesh.positions[0], mesh.positions[1]) / 8.0;
        CHECK(refineFaces(surface, longest, 1'000'000, mesh) == longest);
        CHECK(areaOf(mesh) == doctest::Approx(areaOf(before)).epsilon(1e-5));
        std::set<std::pair<uint32_t, uint32_t>> skin;
        for (const SplitTriangle& t : surface.triangles) {
            skin.insert({t.v[0], t.v[1]});
            skin.insert({t.v[1], t.v[0]});
        }
        std::map<std::array<uint32_t, 3>, int> sides;
        size_t tooLong = 0, skinSeen = 0;
        for (const HiddenMesh::Face& face : mesh.faces) {
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t a = face.v[k], b = face.v[(k + 1) % 3];
                REQUIRE(a != b);
                if (skin.contains({a, b}))
                    ++skinSeen;
                else
                    tooLong += glm::distance(mesh.positions[a], mesh.positions[b]) > 2 * longest;
            }
            auto v = face.v;
            if (face.leaf == 1) std::swap(v[0], v[2]);
            while (v[0] > v[1] || v[0] > v[2]) v = {v[1], v[2], v[0]};
            sides[v] += face.leaf == 0 ? 1 : -1;
        }
        for (const auto& [v, balance] : sides) REQUIRE(balance == 0);
        // An edge is divided in all faces alike: what is no edge of the fan's rim has two sides.
        std::map<std::pair<uint32_t, uint32_t>, int> uses;
        for (const HiddenMesh::Face& face : mesh.faces) {
            if (face.leaf != 0) continue;
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t a = face.v[k], b = face.v[(k + 1) % 3];
                uses[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
            }
        }
        size_t onRim = 0;
        double rim = 0, rimBefore = 0;
        for (const auto& [edge, balance] : uses) {
            if (balance == 0) continue;
            ++onRim;
            rim += glm::distance(mesh.positions[edge.first], mesh.positions[edge.second]);
        }
        for (uint32_t i = 1; i <= spokes; ++i)
            rimBefore += glm::distance(before.positions[i], before.positions[i % spokes + 1]);
        CHECK(onRim >= spokes);
        CHECK(rim == doctest::Approx(rimBefore).epsilon(1e-5));
        CHECK(skinSeen == 2 * surface.triangles.size());
        // Only diagonals beside sides that stay whole may be longer.
        if (skin.empty()) CHECK(tooLong == 0);
    }
}

TEST_CASE("refinement stops short of more faces than are sensible") {
    HiddenMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.faces.push_back({{0, 1, 2}, 0, 1, 0, 0, true});
    const double reached = refineFaces({}, 1e-7, 1000, mesh);
    CHECK(reached > 0.01);
    CHECK(mesh.faces.size() > 200);
    CHECK(mesh.faces.size() < 2000);
}

TEST_CASE("rough pieces are closed, inside, and meet their neighbours bit by bit") {
    struct Case {
        SurfaceMesh mesh;
        InteriorType type;
    };
    for (const Case& c : {Case{chartedCube(1, 1), InteriorType::medial},
                          Case{chartedCube(1, 5), InteriorType::medial},
                          Case{chartedCube(1, 2), InteriorType::solid},
                          // Not convex, so chords may leave it.
                          Case{torus(24, 12), InteriorType::medial}}) {
        CAPTURE(c.mesh.positions.size());
        Recipe recipe = rough(0.01);
        recipe.interior.type = c.type;
        const FracturePlan plan = patterns({"voronoi:5:2", "voronoi:14:3"});
        const FractureSet set = writtenSet(modelAround(c.mesh), plan, recipe);
        CHECK(wallsWithoutTwin(set) == 0);
        CHECK(facesThatChange(set) == 0);
        recipe.interior.roughness.amplitude = 0;
        const FractureSet smooth = writtenSet(modelAround(c.mesh), plan, recipe);
        CHECK(outerCorners(set) == outerCorners(smooth));
        CHECK(set.fragments.size() == smooth.fragments.size());
        for (size_t f = 0; f < set.fragments.size(); ++f)
            CHECK(set.fragments[f].volume ==
                  doctest::Approx(smooth.fragments[f].volume).epsilon(0.15));
    }
}

TEST_CASE("the judge of neighbours sees a corner that has moved by a bit on one side") {
    FractureSet set =
        writtenSet(modelAround(chartedCube(1, 1)), patterns({"voronoi:5:2"}), rough(0.01));
    REQUIRE(wallsWithoutTwin(set) == 0);
    for (const Primitive& p : set.geometry.primitives) {
        if (p.exposedFrom == 0 || p.sheet) continue;
        float& x = set.geometry.positions[set.geometry.indices[p.indices.first]].x;
        x = std::nextafter(x, 10.0F);
    }
    CHECK(wallsWithoutTwin(set) > 0);
}

TEST_CASE("walls become rough by up to the amplitude, and smooth towards the skin") {
    // One plane through the cube: smooth walls lie in z = 0.5.
    FractureMap ring;
    for (int face : {0, 1})
        ring.lines.push_back({{cubeUv(face, -0.01, 0.5), cubeUv(face, 1.01, 0.5)}, 1, "ring"});
    for (int face : {2, 3})
        ring.lines.push_back({{cubeUv(face, 0.5, -0.01), cubeUv(face, 0.5, 1.01)}, 1, "ring"});
    FracturePlan plan;
    plan.drawings.push_back({ring, {}});
    Recipe recipe = rough(0.02, 0.2);
    recipe.wrap = PageWrap::none;
    recipe.interior.type = InteriorType::solid;
    const FractureSet set = writtenSet(modelAround(chartedCube(1, 2)), plan, recipe);
    double most = 0, mostNearSkin = 0, sum = 0, count = 0;
    for (const SeenFace& face : hiddenFacesOf(set)) {
        if (face.primitive->sheet) continue;
        for (const glm::dvec3& p : face.p) {
            const double depth = std::min({p.x, p.y, 1 - p.x, 1 - p.y});
            const double off = std::abs(p.z - 0.5);
            most = std::max(most, off);
            if (depth < 0.02) mostNearSkin = std::max(mostNearSkin, off);
            if (depth < 0.12) continue;
            sum += off * off;
            ++count;
        }
    }
    CHECK(count > 100);
    CHECK(most > 0.01);
    CHECK(most <= 0.02 + 1e-6);
    CHECK(std::sqrt(sum / count) > 0.02 / 6);
    CHECK(mostNearSkin < 0.02 * M_PI / 12);
}

TEST_CASE("rough faces have even texels, and tangents across their normals") {
    Recipe recipe = rough(0.02);
    const FractureSet set =
        writtenSet(modelAround(withTangents(chartedCube(1, 4))), patterns({"voronoi:8:2"}), recipe);
    const TexelDensity density = texelDensity(set, 1e-10);
    CHECK(density.byArea < 1.5);
    CHECK(density.byFace < 1.5);
    const TangentFaults faults = tangentFaults(set, 75);
    CHECK(faults.corners > 10000);
    CHECK(faults.notUnit == 0);
    CHECK(faults.notAcross == 0);
    CHECK(faults.offU + faults.wrongHandedness < faults.corners / 200);
}

TEST_CASE("bumps that would fold are made less deep, and the report says so") {
    const auto findings = [](const Recipe& recipe) {
        const Result<BakedFile> baked =
            bakeModel(modelAround(chartedCube(1, 2)), patterns({"voronoi:5:2"}), recipe);
        if (!baked) FAIL(baked.error().message);
        const Result<CheckReport> check = checkFractureSets(baked->glb, {});
        REQUIRE(check.has_value());
        CHECK(check->objects[0].verticesOutside == 0);
        std::set<std::string> codes;
        for (const BakeFinding& f : baked->report.objects[0].findings) codes.insert(f.code);
        return codes;
    };
    CHECK_FALSE(findings(rough(0.01, 0.2)).contains("roughness-lowered"));
    CHECK(findings(rough(10, 0.2)).contains("roughness-lowered"));
    CHECK(findings(rough(0.01, 1e-9)).contains("roughness-coarse"));
    CHECK(findings(rough(1e6, 1e6)).contains("roughness-lowered"));
    CHECK(findings(rough(1e-30, 0)).size() <= 1);
}

TEST_CASE("looks do not depend on the number of threads") {
    Recipe one = rough(0.01);
    one.threads = 1;
    one.interior.depthColor = "COLOR_0";
    Recipe four = one;
    four.threads = 4;
    const Model model = modelAround(withTangents(chartedCube(1, 4)));
    const Result<BakedFile> a = bakeModel(model, patterns({"voronoi:6", "voronoi:20"}), one);
    const Result<BakedFile> b = bakeModel(model, patterns({"voronoi:6", "voronoi:20"}), four);
    REQUIRE((a.has_value() && b.has_value()));
    CHECK(a->glb == b->glb);
    Recipe seed = one;
    seed.interior.roughness.seed = 2;
    CHECK(bakeModel(model, patterns({"voronoi:6", "voronoi:20"}), seed)->glb != a->glb);
}

TEST_CASE("the skull gets rough inside") {
    if (!haveSharedModels() || propertyCases(100) < 100) {
        MESSAGE("skipped: no real models beside the checkout, or an instrumented build");
        return;
    }
    const Result<Model> model = importModel(sharedDir() / "models/dev/skull_41k_atlas.glb", {});
    REQUIRE(model.has_value());
    const FractureSet set = writtenSet(*model, patterns({"voronoi:13:1"}), rough(0.1, 0));
    CHECK(wallsWithoutTwin(set) == 0);
    CHECK(texelDensity(set, 1e-10).byArea < 2);
}

// One side of a piece's edge may have other vertices than the other where solids cross or touch:
// edges divided by their vertices were divided on one side only, and the skin stayed where walls
// moved by the rounding of what lay in the same place.
TEST_CASE("rough pieces of solids that touch and cross each other are closed") {
    for (const uint32_t seed : propertySeeds(1, 40)) {
        CAPTURE(seed);
        Random random(seed);
        const SurfaceMesh mesh = meshOf(randomSolid(random));
        FracturePlan plan;
        plan.cuts.push_back(parseVolumeCut("voronoi:8").value());
        plan.cuts.push_back(parseVolumeCut("voronoi:3").value());
        const Result<BakedObject> baked =
            bakeObject(mesh, plan, rough(random.in(0, 0.1), 0.4), InteriorMaterials(0));
        CAPTURE(baked ? std::string() : baked.error().message);
        CHECK(baked.has_value());
    }
}
